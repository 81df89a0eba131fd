// What becomes of submissions: passthrough layers in their order, and what a user forces upon an application.
#include "runtime/service/layers.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr XrCompositionLayerFlags sourceAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
constexpr auto opaque = XR_ENVIRONMENT_BLEND_MODE_OPAQUE, alphaBlend = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
			   additive = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;

/// Layers by letter: q a quad, digits passthrough layers.
ipc::Submission submissionOf(const std::string &layers, XrEnvironmentBlendMode mode = opaque, uint32_t flags = 0)
{
	ipc::Submission submission;
	submission.frame = 3;
	submission.blendMode = mode;
	for (const char letter : layers) {
		ipc::Layer &layer = submission.layers.at(submission.layerCount++);
		layer.type = letter == 'q' ? ipc::LayerType::quad : ipc::LayerType::passthrough;
		layer.passthrough = letter == 'q' ? 0 : uint32_t(letter - '0');
		layer.flags = flags;
		layer.width = layer.height = 1;
	}
	return submission;
}

/// The feature runs; layer 0 is plain, layer 1 faded, layer 2 paused, layer 3 invisible.
Presentation running()
{
	Presentation presentation{.passthroughRuns = true};
	for (const uint32_t shown : {0, 1, 3}) presentation.passthrough[shown].shown = true;
	presentation.passthrough[1].style.opacity = 0.5f;
	presentation.passthrough[3].style.opacity = 0;
	return presentation;
}

/// The layers as letters again, and 'w' before where they are blended over the world.
std::string shown(const ipc::Submission &submission, const Presentation &presentation)
{
	const auto content = contentOf(submission, 1, presentation);
	if (!content) return "nothing";
	EXPECT_EQ(content->frame, 3u);
	std::string letters = content->blendMode == opaque ? "" : content->blendMode == alphaBlend ? "w" : "+";
	for (const PanelLayer &layer : content->layers) letters += layer.passthrough ? 'p' : 'q';
	return letters;
}

TEST(Presentation, APlainPassthroughLayerIsTheWorldAndHidesWhatIsBelow)
{
	EXPECT_EQ(shown(submissionOf("0q"), running()), "wq");
	EXPECT_EQ(shown(submissionOf("q0q"), running()), "wq");
	EXPECT_EQ(shown(submissionOf("q10qq"), running()), "wqq");
	EXPECT_EQ(shown(submissionOf("q0"), running()), "w");
	EXPECT_EQ(shown(submissionOf("0q", alphaBlend), running()), "wq") << "one background, not two";
}

TEST(Presentation, OthersStandWhereTheyAreSubmitted)
{
	EXPECT_EQ(shown(submissionOf("1q"), running()), "pq");
	EXPECT_EQ(shown(submissionOf("q1q"), running()), "qpq");
	EXPECT_EQ(shown(submissionOf("01q"), running()), "wpq");
	EXPECT_EQ(contentOf(submissionOf("1"), 1, running())->layers[0].passthrough->opacity, 0.5f);
}

TEST(Presentation, WhatIsPausedOrInvisibleIsNoLayer)
{
	EXPECT_EQ(shown(submissionOf("2q"), running()), "q");
	EXPECT_EQ(shown(submissionOf("3q"), running()), "q");
	EXPECT_EQ(shown(submissionOf("2"), running()), "nothing") << "as without layers";
	Presentation paused = running();
	paused.passthroughRuns = false;
	EXPECT_EQ(shown(submissionOf("01q"), paused), "q");
	Presentation edges = running();
	edges.passthrough[3].style.edge.a = 0.1f;
	EXPECT_EQ(shown(submissionOf("3q"), edges), "pq");
}

TEST(Presentation, WhereLightIsAddedTheWorldIsSeenAnyway)
{
	EXPECT_EQ(shown(submissionOf("0q", additive), running()), "+q");
	EXPECT_EQ(shown(submissionOf("q1", additive), running()), "+q");
}

TEST(Presentation, EveryStyleButThePlainOneIsALayer)
{
	const auto with = [](auto change) {
		Presentation presentation = running();
		change(presentation.passthrough[0].style);
		return shown(submissionOf("q0"), presentation);
	};
	EXPECT_EQ(with([](PassthroughStyle &) {}), "w");
	EXPECT_EQ(with([](PassthroughStyle &style) { style.opacity = 0.99f; }), "qp");
	EXPECT_EQ(with([](PassthroughStyle &style) { style.edge.a = 0.5f; }), "wp") << "as opaque as the plain one";
	EXPECT_EQ(with([](PassthroughStyle &style) { style.brightness = 1; }), "wp");
	EXPECT_EQ(with([](PassthroughStyle &style) { style.contrast = 2; }), "wp");
	EXPECT_EQ(with([](PassthroughStyle &style) { style.saturation = 0; }), "wp");
	EXPECT_EQ(with([](PassthroughStyle &style) { style.map = LayerTexture{}; }), "qp") << "a map may let through what is below";
}

TEST(Presentation, WhatHidesItsOwnLayersHidesThoseOfOthers)
{
	const auto hides = [](const std::string &layers) { return contentOf(submissionOf(layers), 1, running())->hidesOthers; };
	EXPECT_TRUE(hides("0q"));
	EXPECT_FALSE(hides("1q"));
	EXPECT_FALSE(hides("q"));
}

TEST(Presentation, OnePassthroughLayerOverAnotherIsDrawnOnceWhereItLooksTheSame)
{
	const std::string often(64, '1');
	const auto content = contentOf(submissionOf("11q"), 1, running());
	ASSERT_EQ(content->layers.size(), 2u);
	EXPECT_EQ(content->layers[0].passthrough->opacity, 0.75f);
	EXPECT_EQ(shown(submissionOf(often), running()), "p");
	EXPECT_EQ(shown(submissionOf("1q1"), running()), "pqp") << "something lies between";
	Presentation others = running();
	others.passthrough[0].style = {.opacity = 0.5f, .brightness = 10};
	EXPECT_EQ(shown(submissionOf("01"), others), "pp") << "another picture";
	Presentation edges = running();
	edges.passthrough[1].style.edge.a = 0.5f;
	EXPECT_EQ(contentOf(submissionOf(often), 1, edges)->layers.size(), ipc::maxPassthroughLayers)
		<< "edges are more opaque than what is between them";
}

Presentation forcing(ipc::Forced mode, float opacity = 1) { return {.forced = {mode, {{1, 0, 1}, 0.2f, 0.1f}, opacity}}; }

TEST(Presentation, ForcedAlphaCountsWhateverTheApplicationSays)
{
	const auto content = contentOf(submissionOf("qq"), 1, forcing(ipc::Forced::alpha));
	EXPECT_EQ(content->blendMode, alphaBlend);
	for (const PanelLayer &layer : content->layers) EXPECT_EQ(layer.flags, sourceAlpha);
	EXPECT_EQ(shown(submissionOf("q"), forcing(ipc::Forced::off)), "q");
	EXPECT_EQ(shown(submissionOf("q", additive), forcing(ipc::Forced::alpha)), "wq");
	const auto faded = contentOf(submissionOf("q"), 1, forcing(ipc::Forced::alpha, 0.5f));
	EXPECT_EQ(faded->layers[0].colorScale.a, 0.5f);
	EXPECT_EQ(faded->layers[0].colorBias.a, 0);
	EXPECT_EQ(faded->layers[0].flags, sourceAlpha);
}

TEST(Presentation, AnUnderlayShowsWhereLayersAreNot)
{
	const auto content = contentOf(submissionOf("q"), 1, forcing(ipc::Forced::underlay));
	EXPECT_EQ(content->blendMode, alphaBlend);
	EXPECT_EQ(content->layers[0].flags, 0u) << "the layer is as opaque as it was";
	const auto faded = contentOf(submissionOf("q"), 1, forcing(ipc::Forced::underlay, 0.25f));
	EXPECT_EQ(faded->layers[0].flags, sourceAlpha | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT);
	EXPECT_EQ(faded->layers[0].colorScale.a, 0) << "whatever the image's alpha is";
	EXPECT_EQ(faded->layers[0].colorBias.a, 0.25f);
	EXPECT_EQ(faded->layers[0].colorScale.r, 1);
}

TEST(Presentation, AKeyIsTheLayersOwn)
{
	const auto content = contentOf(submissionOf("q1q"), 1, [] {
		Presentation presentation = running();
		presentation.forced = forcing(ipc::Forced::chroma, 0.75f).forced;
		return presentation;
	}());
	EXPECT_EQ(content->blendMode, alphaBlend);
	ASSERT_EQ(content->layers.size(), 3u);
	for (const size_t quad : {0, 2}) {
		ASSERT_TRUE(content->layers[quad].key);
		EXPECT_EQ(content->layers[quad].key->key.colour[2], 1);
		EXPECT_EQ(content->layers[quad].key->key.tolerance, 0.2f);
		EXPECT_EQ(content->layers[quad].key->opacity, 0.75f);
	}
	EXPECT_FALSE(content->layers[1].key);
}

TEST(Presentation, AnOpacityIsOfAnAlphaThatCountsByItsBlendFactors)
{
	ipc::Submission submission = submissionOf("q");
	submission.layers[0].blend.given = 1;
	const auto faded = contentOf(submission, 1, forcing(ipc::Forced::underlay, 0.25f));
	EXPECT_EQ(faded->layers[0].colorScale.a, 0.25f);
	EXPECT_EQ(faded->layers[0].colorBias.a, 0) << "where the image is empty it stays so";
}

TEST(Presentation, WithAKeyTheLowestLayersAlphaCountsOnlyWhereItDid)
{
	constexpr XrCompositionLayerFlags straight = sourceAlpha | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	const auto flagsOf = [](XrEnvironmentBlendMode mode, XrCompositionLayerFlags flags, size_t layer) {
		return contentOf(submissionOf("qq", mode, uint32_t(flags)), 1, forcing(ipc::Forced::chroma))->layers[layer].flags;
	};
	EXPECT_EQ(flagsOf(opaque, sourceAlpha, 0), 0u) << "black was below it";
	EXPECT_EQ(flagsOf(opaque, sourceAlpha, 1), sourceAlpha);
	EXPECT_EQ(flagsOf(opaque, straight, 0), straight);
	EXPECT_EQ(flagsOf(alphaBlend, sourceAlpha, 0), sourceAlpha);
	Presentation overlay = forcing(ipc::Forced::chroma);
	overlay.overlay = true;
	EXPECT_EQ(contentOf(submissionOf("q", opaque, sourceAlpha), 1, overlay)->layers[0].flags, sourceAlpha) << "others are below it";
}

} // namespace
} // namespace arift
