// Layers on the panel: blending by hand-computed colours, and where they stand.
#include "tests/gpu/panel_fixture.h"

namespace arift
{
namespace
{

using namespace by_hand;

Linear mixed(const Linear &light, double weight, double behind, double kept)
{
	return {light[0] * weight + behind * kept, light[1] * weight + behind * kept, light[2] * weight + behind * kept};
}

struct BlendCase {
	const char *name;
	XrEnvironmentBlendMode mode;
	XrCompositionLayerFlags flags;
	Linear expected;
};
void PrintTo(const BlendCase &blend, std::ostream *out) { *out << blend.name; }
class PanelBlendTest : public PanelTest, public testing::WithParamInterface<BlendCase>
{
};

TEST_P(PanelBlendTest, hasTheColourComputedByHand)
{
	seeGrey(cameraValue);
	addUniformLayer(colour, GetParam().flags);
	inputs.blendMode = GetParam().mode;
	render();
	expectNear(at(centreX, centreY), GetParam().expected);
	expectNear(at(1280 - centreX, centreY), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
	ModesAndFlags, PanelBlendTest,
	testing::Values(BlendCase{"opaque", opaque, 0, c}, BlendCase{"opaquePremultiplied", opaque, sourceAlpha, c},
					BlendCase{"opaqueUnpremultiplied", opaque, unpremultiplied, mixed(c, a, 0, 0)}, BlendCase{"alpha", alphaBlend, 0, c},
					BlendCase{"alphaUnpremultipliedBitAlone", alphaBlend, XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT, c},
					BlendCase{"alphaPremultiplied", alphaBlend, sourceAlpha, mixed(c, 1, camera, 1 - a)},
					BlendCase{"alphaUnpremultiplied", alphaBlend, unpremultiplied, mixed(c, a, camera, 1 - a)},
					BlendCase{"additive", additive, 0, mixed(c, 1, camera, 1)},
					BlendCase{"additivePremultiplied", additive, sourceAlpha, mixed(c, 1, camera, 1)},
					BlendCase{"additiveUnpremultiplied", additive, unpremultiplied, mixed(c, a, camera, 1)}),
	[](const auto &test) { return test.param.name; });

TEST_F(PanelTest, layersLieOverEachOtherBottomFirst)
{
	seeGrey(cameraValue);
	addUniformLayer({255, 0, 0, 255}, sourceAlpha);
	addUniformLayer({0, 51, 0, 102}, sourceAlpha); // 0.2 green, alpha 0.4
	addUniformLayer({0, 0, 255, 128}, unpremultiplied);
	render();
	const double b = 128 / 255.0;
	expectNear(at(centreX, centreY), {0.6 * (1 - b), 0.2 * (1 - b), b}, 2);
}

TEST_F(PanelTest, additiveLightIsAddedToTheFinishedPictureOfTheLayers)
{
	seeGrey(cameraValue);
	addUniformLayer({102, 0, 0, 255}, 0);
	addUniformLayer({0, 51, 0, 102}, sourceAlpha);
	inputs.blendMode = additive;
	render();
	expectNear(at(centreX, centreY), {0.4 * 0.6 + camera, 0.2 + camera, camera}, 2);
}

TEST_F(PanelTest, anOpaqueLayerHidesWhatIsBelow)
{
	seeGrey(255);
	addUniformLayer({255, 255, 255, 255}, 0);
	addUniformLayer({51, 51, 51, 0}, 0);
	render();
	expectNear(at(centreX, centreY), {0.2, 0.2, 0.2});
}

TEST_F(PanelTest, encodedImagesAreDecodedByTheSampler)
{
	const uint64_t key = addImage(
		8, 8,
		[](auto...) {
			return std::array<uint8_t, 4>{100, 150, 200, 255};
		},
		VK_FORMAT_R8G8B8A8_SRGB);
	addQuad(key, {identityOrientation, {0, 0, -1}}, {2, 2}, {{0, 0}, {8, 8}});
	render();
	const auto found = at(centreX, centreY);
	EXPECT_NEAR(found[0], 100, 1);
	EXPECT_NEAR(found[1], 150, 1);
	EXPECT_NEAR(found[2], 200, 1);
}

TEST_F(PanelTest, aQuadStandsWhereItIs)
{
	const uint64_t key = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	inputs.blendMode = opaque;
	addQuad(key, {identityOrientation, {0.1f, -0.2f, -1}}, {0.3f, 0.2f}, {{0, 0}, {8, 8}});
	render();
	for (const Eye eye : {Eye::left, Eye::right}) {
		const auto middle = pixelOf(eye, {0.1f, -0.2f, -1});
		const auto left = pixelOf(eye, {0.1f - 0.15f, -0.2f, -1}), right = pixelOf(eye, {0.1f + 0.15f, -0.2f, -1});
		const auto above = pixelOf(eye, {0.1f, -0.1f, -1}), below = pixelOf(eye, {0.1f, -0.3f, -1});
		EXPECT_EQ(at(int(middle.x), int(middle.y)), (std::array{255, 255, 255}));
		for (const auto &[edge, outward] : {std::pair{left, glm::dvec2(-1, 0)}, {right, {1, 0}}, {above, {0, -1}}, {below, {0, 1}}}) {
			const auto inside = edge - outward * 1.5, outside = edge + outward * 1.5;
			EXPECT_EQ(at(int(inside.x), int(inside.y))[1], 255);
			EXPECT_EQ(at(int(outside.x), int(outside.y))[1], 0);
		}
	}
}

TEST_F(PanelTest, aQuadIsSeenFromItsFrontAlone)
{
	const uint64_t key = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	inputs.blendMode = opaque;
	addQuad(key, {rotationAbout({0, 1, 0}, M_PI), {0, 0, -1}}, {2, 2}, {{0, 0}, {8, 8}});
	addQuad(key, {identityOrientation, {0, 0, 1}}, {2, 2}, {{0, 0}, {8, 8}}); // behind the head
	render();
	EXPECT_EQ(at(centreX, centreY), (std::array{0, 0, 0}));
}

TEST_F(PanelTest, aHeadLockedQuadMovesWithTheHeadAndAWorldQuadStays)
{
	const uint64_t red = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 0, 0, 255}; });
	const uint64_t green = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{0, 255, 0, 255}; });
	inputs.blendMode = opaque;
	const XrPosef head{rotationAbout({0, 1, 0}, 0.3), {0, 0, 0}};
	for (size_t e = 0; e < 2; ++e) inputs.top[e] = inputs.bottom[e] = {head * rig.eyeInHead[e], head};
	addQuad(red, {identityOrientation, {0, 0.2f, -1}}, {0.1f, 0.1f}, {{0, 0}, {8, 8}}).headLocked = true;
	addQuad(green, {identityOrientation, {0, 0, -1}}, {0.1f, 0.1f}, {{0, 0}, {8, 8}});
	render();
	const auto locked = pixelOf(Eye::left, head * XrVector3f{0, 0.2f, -1}), still = pixelOf(Eye::left, {0, 0, -1});
	EXPECT_EQ(at(int(locked.x), int(locked.y)), (std::array{255, 0, 0}));
	EXPECT_EQ(at(int(still.x), int(still.y)), (std::array{0, 255, 0}));
	EXPECT_GT(still.x, locked.x + 50) << "the head turned left, so the world moves right";
}

TEST_F(PanelTest, aProjectionLayerIsTurnedBackToThePoseItWasDrawnFor)
{
	// Drawn at rest, a white column straight ahead; shown when the head has turned.
	const uint64_t key = addImage(201, 3, [](uint32_t x, auto, auto) {
		return std::array<uint8_t, 4>{0, uint8_t(x == 100 ? 255 : 0), 0, 255};
	});
	inputs.blendMode = opaque;
	PanelLayer &layer = inputs.layers.emplace_back();
	for (size_t e = 0; e < 2; ++e)
		layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-0.8f, 0.8f, 0.8f, -0.8f}, {key, 0, {{0, 0}, {201, 3}}}};
	const XrPosef head{rotationAbout({0, 1, 0}, 0.2), {0, 0, 0}};
	for (size_t e = 0; e < 2; ++e) inputs.top[e] = inputs.bottom[e] = {head * rig.eyeInHead[e], head};
	render();
	const XrVector3f ahead{rig.eyeInHead[0].position.x, 0, float(-inputs.passthroughDistance)};
	const auto expected = pixelOf(Eye::left, ahead);
	double weight = 0, sum = 0;
	for (int x = 0; x < 640; ++x) {
		const int value = at(x, int(expected.y))[1];
		weight += value;
		sum += value * (x + 0.5);
	}
	ASSERT_GT(weight, 0);
	EXPECT_NEAR(sum / weight, expected.x, 0.5);
}

TEST_F(PanelTest, linesAreShownAtTheirOwnPose)
{
	// The head turns by 3 degrees while the panel is drawn: a vertical bar of the world leans.
	const uint64_t key = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	inputs.blendMode = opaque;
	addQuad(key, {identityOrientation, {0, 0, -1}}, {0.02f, 1.6f}, {{0, 0}, {8, 8}});
	const double turn = 3 * M_PI / 180;
	for (size_t e = 0; e < 2; ++e) {
		const XrPosef first{rotationAbout({0, 1, 0}, -turn / 2), {0, 0, 0}}, last{rotationAbout({0, 1, 0}, turn / 2), {0, 0, 0}};
		inputs.top[e] = {first * rig.eyeInHead[e], first};
		inputs.bottom[e] = {last * rig.eyeInHead[e], last};
	}
	render();
	const auto barAt = [&](int y) {
		double weight = 0, sum = 0;
		for (int x = 0; x < 640; ++x) {
			weight += at(x, y)[1];
			sum += at(x, y)[1] * (x + 0.5);
		}
		return sum / weight;
	};
	// Between lines 250 and 550 it turns by 300 / 799 of it, near the axis where a tangent is 363 pixels.
	EXPECT_NEAR(barAt(550) - barAt(250), turn * 300 / 799 * 363.25, 1.0);
	EXPECT_GT(barAt(550), barAt(250));
}

TEST_F(PanelTest, arrayLayersAreTakenByTheirIndex)
{
	const auto byLayer = [](auto, auto, uint32_t layer) {
		return layer == 0 ? std::array<uint8_t, 4>{255, 0, 0, 255} : std::array<uint8_t, 4>{0, 0, 255, 255};
	};
	const uint64_t key = addImage(8, 8, byLayer, VK_FORMAT_R8G8B8A8_UNORM, 2);
	addQuad(key, {identityOrientation, {0, 0, -1}}, {2, 2}, {{0, 0}, {8, 8}}, 0);
	render();
	EXPECT_EQ(at(centreX, centreY), (std::array{255, 0, 0}));
	for (auto &quad : inputs.layers[0].quad) quad->texture.arrayIndex = 1;
	render();
	EXPECT_EQ(at(centreX, centreY), (std::array{0, 0, 255}));
}

TEST_F(PanelTest, nothingBleedsInFromOutsideASubImage)
{
	const uint64_t key = addGreenAmongMagenta();
	inputs.blendMode = opaque;
	addQuad(key, {identityOrientation, {0, 0, -1}}, {0.8f, 0.6f}, greenOnes);
	render();
	EXPECT_GT(greenPixels(), 50'000);
}

TEST_F(PanelTest, layersThatCannotBeSampledAreLeftOut)
{
	const uint64_t key = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	inputs.blendMode = opaque;
	const XrPosef place{identityOrientation, {0, 0, -1}};
	addQuad(key, place, {2, 2}, {{4, 0}, {8, 8}});       // beyond the image
	addQuad(key, place, {2, 2}, {{0, 0}, {8, 8}}, 1);    // no such array layer
	addQuad(key + 100, place, {2, 2}, {{0, 0}, {8, 8}}); // no such image
	addQuad(key, place, {0, 0}, {{0, 0}, {8, 8}});       // no size
	gpu::SharedImage depth(device,
						   {.format = VK_FORMAT_D32_SFLOAT, .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, .width = 8, .height = 8});
	renderer.addImage(77, depth.image(), depth.spec());
	addQuad(77, place, {2, 2}, {{0, 0}, {8, 8}});
	render();
	EXPECT_EQ(at(centreX, centreY), (std::array{0, 0, 0}));
	renderer.removeImage(77);
	renderer.removeImage(key);
	render();
}

TEST_F(PanelTest, eyesAreShownBeforeTheLensCorrection)
{
	const uint64_t key = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	seeGrey(cameraValue);
	addQuad(key, {identityOrientation, {0.3f, 0.4f, -1}}, {0.1f, 0.1f}, {{0, 0}, {8, 8}});
	render();
	panel = renderer.renderEyes(inputs);
	ASSERT_EQ(panel.width, 1280u);
	EXPECT_NEAR(panel.height, 886, 1);
	for (const Eye eye : {Eye::left, Eye::right}) {
		const auto fov = rig.lens.fov(eye, rig.interpupillaryDistance);
		const double perPixel = (fov.left + fov.right) / 640, e = eye == Eye::left ? 0 : 1;
		const double x = e * 640 + (fov.left + 0.3 - (e * 2 - 1) * 0.032) / perPixel, y = (fov.up - 0.4) / perPixel;
		EXPECT_EQ(at(int(x), int(y)), (std::array{255, 255, 255}));
		expectNear(at(int(x) - 40, int(y)), {camera, camera, camera});
	}
}

} // namespace
} // namespace arift
