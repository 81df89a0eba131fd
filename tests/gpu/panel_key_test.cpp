// Layers of which a colour stands for the world, by colours computed a second time here.
#include "tests/gpu/panel_fixture.h"
#include <cmath>
#include <fmt/core.h>

namespace arift
{
namespace
{

using by_hand::sourceAlpha;
constexpr Linear camera = by_hand::cameraColour;

/// How much of an encoded colour a key leaves: ChromaKey, computed again.
double keptOf(const std::array<double, 3> &code, const ChromaKey &key)
{
	double d[3], luma = 0;
	const double weights[3] = {0.2126, 0.7152, 0.0722};
	for (int i = 0; i < 3; ++i) {
		d[i] = code[size_t(i)] / 255 - double(key.colour[size_t(i)]);
		luma += weights[i] * d[i];
	}
	const double distance = std::hypot(luma / 4, (d[2] - luma) / 1.8556, (d[0] - luma) / 1.5748);
	const double t = std::clamp((distance - double(key.tolerance)) / double(key.softness), 0.0, 1.0);
	return t * t * (3 - 2 * t);
}

class PanelKeyTest : public PanelTest
{
protected:
	PanelKeyTest()
	{
		inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		seeColour();
	}
	/// One encoded colour over all of both views, keyed out.
	void show(const std::array<uint8_t, 4> &code, const KeyedOut &keyed, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB)
	{
		inputs.layers.clear();
		const uint64_t key = addImage(
			16, 16, [&](auto...) { return code; }, format);
		PanelLayer &layer = inputs.layers.emplace_back();
		const float wide = 1.2f;
		for (size_t e = 0; e < 2; ++e)
			layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-wide, wide, wide, -wide}, {key, 0, {{0, 0}, {16, 16}}}};
		layer.key = keyed;
		render();
	}
	static Linear expected(const std::array<uint8_t, 4> &code, const KeyedOut &keyed)
	{
		const double kept = keptOf({double(code[0]), double(code[1]), double(code[2])}, keyed.key), opacity = double(keyed.opacity);
		Linear light{};
		for (size_t i = 0; i < 3; ++i) {
			const double own = std::clamp(linearOf(code[i]) - (1 - kept) * linearOf(255 * double(keyed.key.colour[i])), 0.0, kept);
			light[i] = own * opacity + camera[i] * (1 - kept * opacity);
		}
		return light;
	}
};

TEST_F(PanelKeyTest, TheKeysColourIsTheWorldAndOthersStay)
{
	const KeyedOut green{{{0, 1, 0}, 0.15f, 0.1f}, 1};
	show({0, 255, 0, 255}, green);
	expectNear(at(centreX, centreY), camera, 2);
	show({20, 235, 15, 0}, green); // a shade of it; its alpha says nothing
	expectNear(at(centreX, centreY), camera, 1.5);
	for (const std::array<uint8_t, 4> &other :
		 {std::array<uint8_t, 4>{255, 0, 0, 255}, {255, 255, 255, 0}, {90, 90, 90, 255}, {0, 0, 0, 0}}) {
		show(other, green);
		expectNear(at(centreX, centreY), {linearOf(other[0]), linearOf(other[1]), linearOf(other[2])}, 1.5);
	}
	const KeyedOut black{{{0, 0, 0}, 0.05f, 0.05f}, 1};
	show({0, 0, 0, 255}, black);
	expectNear(at(centreX, centreY), camera, 1.5);
	show({128, 128, 128, 255}, black);
	expectNear(at(centreX, centreY), {linearOf(128), linearOf(128), linearOf(128)}, 1.5);
}

TEST_F(PanelKeyTest, BetweenBothItIsSoftAndLosesTheKeysLight)
{
	const KeyedOut keyed{{{0, 1, 0}, 0.1f, 0.4f}, 1};
	double worst = 0;
	int partly = 0;
	for (int step = 0; step <= 10; ++step) {
		const auto red = uint8_t(25 * step);
		const std::array<uint8_t, 4> code{red, 255, red, 255};
		show(code, keyed);
		const Linear wanted = expected(code, keyed);
		const double kept = keptOf({double(red), 255, double(red)}, keyed.key);
		partly += kept > 0.05 && kept < 0.95;
		expectNear(at(centreX, centreY), wanted, 2);
		for (size_t channel = 0; channel < 3; ++channel)
			worst = std::max(worst, std::abs(at(centreX, centreY)[channel] - encoded(wanted[channel])));
	}
	EXPECT_GE(partly, 3) << "colours inside the soft edge";
	fmt::print("[ FIGURE   ] chroma key: at most {:.2f} of 255 from the same in double precision, {} colours in its soft edge\n", worst,
			   partly);
}

TEST_F(PanelKeyTest, StoredValuesThatAreLinearAreComparedEncoded)
{
	// Linear 0.2158 is 128 encoded.
	const KeyedOut keyed{{{128 / 255.0f, 128 / 255.0f, 128 / 255.0f}, 0.02f, 0.02f}, 1};
	show({55, 55, 55, 255}, keyed, VK_FORMAT_R8G8B8A8_UNORM);
	expectNear(at(centreX, centreY), camera, 1.5);
	show({128, 128, 128, 255}, keyed, VK_FORMAT_R8G8B8A8_UNORM);
	expectNear(at(centreX, centreY), {128 / 255.0, 128 / 255.0, 128 / 255.0}, 1.5);
}

TEST_F(PanelKeyTest, WhatStaysHasItsOpacity)
{
	const KeyedOut keyed{{{0, 1, 0}, 0.15f, 0.1f}, 0.25f};
	show({255, 0, 0, 255}, keyed);
	expectNear(at(centreX, centreY), expected({255, 0, 0, 255}, keyed), 1.5);
	show({0, 255, 0, 255}, keyed);
	expectNear(at(centreX, centreY), camera, 1.5);
}

/// What is half in the key's colour, as soft as can be.
constexpr KeyedOut soft{{{0, 1, 0}, 0.1f, 0.4f}, 0.75f};
constexpr std::array<uint8_t, 4> halfGreen{130, 255, 130, 255};

TEST_F(PanelKeyTest, EverySurfaceIsKeyedOut)
{
	const XrRect2Di whole{{0, 0}, {16, 16}};
	const uint64_t image = addImage(
		16, 16, [](auto...) { return halfGreen; }, VK_FORMAT_R8G8B8A8_SRGB);
	const auto expectKeyed = [&](const char *what, const auto &place) {
		SCOPED_TRACE(what);
		inputs.layers.clear();
		PanelLayer &layer = inputs.layers.emplace_back();
		layer.key = soft;
		place(layer);
		render();
		for (const int x : {centreX, 1280 - centreX}) expectNear(at(x, centreY), expected(halfGreen, soft), 2);
	};
	for (const Surface surface : {Surface::cylinder, Surface::sphere})
		expectKeyed(surface == Surface::sphere ? "sphere" : "cylinder", [&](PanelLayer &layer) {
			for (auto &view : layer.curved)
				view = CurvedView{.surface = surface,
								  .centreInFrame = identityPose,
								  .radius = 1,
								  .uvAhead = {0.5f, 0.5f},
								  .uvPerUnit = {0.5f, -0.5f},
								  .texture = {image, 0, whole}};
		});
	expectKeyed("cube", [&](PanelLayer &layer) {
		const uint64_t cube = addCube(
			4,
			[](auto...) {
				return std::array{uint8_t(std::lround(255 * linearOf(130))), uint8_t(255), uint8_t(std::lround(255 * linearOf(130))),
								  uint8_t(255)};
			},
			1);
		for (auto &view : layer.cube) view = CubeView{identityOrientation, {cube, 0, {{0, 0}, {4, 4}}}};
	});
	expectKeyed("with a scale", [&](PanelLayer &layer) {
		for (auto &view : layer.quad) view = QuadView{{identityOrientation, {0, 0, -1}}, {1, 1}, {image, 0, whole}};
		layer.colorScale = {1, 1, 1, 0.8f};
		layer.key->opacity = soft.opacity / 0.8f;
	});
}

/// As stored: linear light.
TEST_F(PanelKeyTest, WhatIsLeftHasTheImagesOwnAlpha)
{
	const std::array<double, 3> straight{linearOf(130), 1, linearOf(130)};
	const double own = 0.6, kept = keptOf({130, 255, 130}, soft.key), opacity = double(soft.opacity);
	for (const bool multiplied : {true, false}) {
		SCOPED_TRACE(multiplied);
		inputs.layers.clear();
		const uint64_t image = addImage(16, 16, [&](auto...) {
			std::array<uint8_t, 4> texel{0, 0, 0, uint8_t(own * 255)};
			for (size_t i = 0; i < 3; ++i) texel[i] = uint8_t(std::lround(255 * straight[i] * (multiplied ? own : 1)));
			return texel;
		});
		PanelLayer &layer = addQuad(image, {identityOrientation, {0, 0, -1}}, {1, 1}, {{0, 0}, {16, 16}});
		layer.flags = multiplied ? sourceAlpha : by_hand::unpremultiplied;
		layer.key = soft;
		render();
		Linear wanted{};
		for (size_t i = 0; i < 3; ++i) {
			const double keyLight = soft.key.colour[i] > 0 ? 1 : 0;
			const double light = std::clamp((straight[i] - (1 - kept) * keyLight) * own, 0.0, kept * own) * opacity;
			wanted[i] = light + camera[i] * (1 - kept * own * opacity);
		}
		expectNear(at(centreX, centreY), wanted, 2);
		// The same by factors that say so.
		layer.factors =
			BlendFactors{multiplied ? XR_BLEND_FACTOR_ONE_FB : XR_BLEND_FACTOR_SRC_ALPHA_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB,
						 XR_BLEND_FACTOR_ONE_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB};
		render();
		expectNear(at(centreX, centreY), wanted, 2);
	}
}

TEST_F(PanelKeyTest, WhereAnImageIsEmptyNothingOfItIsLeft)
{
	const uint64_t image = addImage(16, 16, [](auto...) { return std::array<uint8_t, 4>{}; });
	addQuad(image, {identityOrientation, {0, 0, -1}}, {1, 1}, {{0, 0}, {16, 16}}).key = soft;
	for (const auto &[flags, seen] :
		 {std::pair{sourceAlpha, camera}, {XrCompositionLayerFlags(0), Linear{camera[0] / 4, camera[1] / 4, camera[2] / 4}}}) {
		inputs.layers.front().flags = flags;
		render();
		expectNear(at(centreX, centreY), seen, 2);
	}
}

} // namespace
} // namespace arift
