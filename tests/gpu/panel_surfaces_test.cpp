// Layers that are not plain: scaled colours and blend factors by hand-computed colours, cylinders, spheres and cubes by what is seen of
// them.
#include "tests/gpu/panel_fixture.h"

namespace arift
{
namespace
{

using namespace by_hand;

constexpr auto zero = XR_BLEND_FACTOR_ZERO_FB, one = XR_BLEND_FACTOR_ONE_FB, alpha = XR_BLEND_FACTOR_SRC_ALPHA_FB,
			   rest = XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB;

class PanelSurfaces : public PanelTest
{
protected:
	/// Per colour: alone + world * how much of the world is seen.
	void expectOverCamera(const Linear &light, double world)
	{
		for (const int x : {centreX, 1280 - centreX})
			expectNear(at(x, centreY), {light[0] + camera * world, light[1] + camera * world, light[2] + camera * world}, 1.6);
	}
};

TEST_F(PanelSurfaces, StraightColourAndAlphaAreScaledAndOffset)
{
	seeGrey(cameraValue);
	const struct {
		XrCompositionLayerFlags flags;
		Linear straight;
		double alpha;
	} cases[] = {{sourceAlpha, {0.4 / a, 0.2 / a, 0.6 / a}, a},
				 {unpremultiplied, {0.4, 0.2, 0.6}, a},
				 {0, {0.4, 0.2, 0.6}, 1},
				 {XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT, {0.4, 0.2, 0.6}, 1}};
	for (const auto &[flags, straight, before] : cases) {
		inputs.layers.clear();
		PanelLayer &layer = addUniformLayer(colour, flags);
		layer.colorScale = {0.5f, 1, 0.5f, 0.8f};
		layer.colorBias = {0.1f, 0, -0.2f, 0.1f};
		render();
		const double after = before * 0.8 + 0.1;
		expectOverCamera({(straight[0] * 0.5 + 0.1) * after, straight[1] * after, (straight[2] * 0.5 - 0.2) * after}, 1 - after);
	}
}

TEST_F(PanelSurfaces, ABiasIsSeenWhereTheImageIsEmpty)
{
	seeGrey(cameraValue);
	PanelLayer &layer = addUniformLayer({0, 0, 0, 0}, sourceAlpha);
	layer.colorBias = {0.5f, 0, 0, 0.4f};
	render();
	expectOverCamera({0.2, 0, 0}, 0.6);
}

struct FactorCase {
	const char *name;
	BlendFactors factors;
	bool overGreen; ///< an opaque layer of linear 0.4 green is below
	Linear light;
	double world; ///< how much of the world is seen in front of which the layers are blended
};
constexpr FactorCase factorCases[] = {{"premultiplied", {one, rest, one, rest}, false, {0.4, 0.2, 0.6}, 1 - a},
									  {"straight", {alpha, rest, one, rest}, true, {0.4 * a, 0.2 * a + 0.4 * (1 - a), 0.6 * a}, 0},
									  {"addedLight", {one, one, zero, one}, false, {0.4, 0.2, 0.6}, 1},
									  {"addedLightAndAlpha", {one, one, one, one}, false, {0.4, 0.2, 0.6}, 1 - a},
									  {"aHole", {zero, rest, zero, rest}, true, {0, 0.4 * (1 - a), 0}, a},
									  {"instead", {one, zero, one, zero}, true, {0.4, 0.2, 0.6}, 1 - a},
									  {"insteadWithoutAlpha", {one, zero, zero, zero}, true, {0.4, 0.2, 0.6}, 1},
									  {"maskedByAlpha", {zero, alpha, zero, alpha}, true, {0, 0.4 * a, 0}, 1 - a}};

TEST_F(PanelSurfaces, FactorsMakeTheColoursComputedByHand)
{
	seeGrey(cameraValue);
	for (const FactorCase &factor : factorCases) {
		inputs.layers.clear();
		if (factor.overGreen) addUniformLayer({0, 102, 0, 255}, 0);
		addUniformLayer(colour, sourceAlpha).factors = factor.factors;
		for (const auto mode : {alphaBlend, opaque, additive}) {
			SCOPED_TRACE(std::string(factor.name) + " in mode " + std::to_string(mode));
			inputs.blendMode = mode;
			render();
			expectOverCamera(factor.light, mode == alphaBlend ? factor.world : mode == opaque ? 0 : 1);
		}
	}
}

constexpr auto alphaBelow = XR_BLEND_FACTOR_DST_ALPHA_FB, restBelow = XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB;

/// An opaque layer of linear 0.4 green, over one of colour c and alpha a.
constexpr FactorCase alphaBelowCases[] = {
	{"insideWhatIsBelow", {alphaBelow, rest, alphaBelow, rest}, true, {0, 0.4 * a, 0}, 1 - a},
	{"behindWhatIsBelow", {restBelow, one, restBelow, one}, true, {0.4, 0.2 + 0.4 * (1 - a), 0.6}, 0},
	{"keptByAlpha", {zero, alphaBelow, zero, alphaBelow}, true, {0.4 * a, 0.2 * a, 0.6 * a}, 1 - a *a},
	{"keptByTheRest", {zero, restBelow, zero, restBelow}, true, {0.4 * (1 - a), 0.2 * (1 - a), 0.6 * (1 - a)}, 1 - a *(1 - a)},
	{"alphaAlone", {one, zero, zero, alphaBelow}, true, {0, 0.4, 0}, 1 - a *a}};

TEST_F(PanelSurfaces, TheAlphaOfTheLayersBelowIsAFactorInEveryMode)
{
	seeGrey(cameraValue);
	for (const FactorCase &factor : alphaBelowCases) {
		inputs.layers.clear();
		addUniformLayer(colour, sourceAlpha);
		addUniformLayer({0, 102, 0, 255}, 0).factors = factor.factors;
		for (const auto mode : {alphaBlend, opaque, additive}) {
			SCOPED_TRACE(std::string(factor.name) + " in mode " + std::to_string(mode));
			inputs.blendMode = mode;
			render();
			expectOverCamera(factor.light, mode == alphaBlend ? factor.world : mode == opaque ? 0 : 1);
		}
	}
}

TEST_F(PanelSurfaces, WhatIsBelowIsKeptByItsAlphaWhereTheLayerIsAndNowhereElse)
{
	inputs.blendMode = opaque;
	addUniformLayer(colour, sourceAlpha);
	addQuad(addImage(4, 4,
					 [](auto...) {
						 return std::array<uint8_t, 4>{0, 0, 0, 255};
					 }),
			{identityOrientation, {0, 0, -1}}, {0.4f, 0.4f}, {{0, 0}, {4, 4}})
		.factors = BlendFactors{zero, alphaBelow, zero, alphaBelow};
	render();
	const glm::dvec2 edge = pixelOf(Eye::left, {0.2f, 0, -1});
	expectNear(at(int(edge.x) - 3, int(edge.y)), {0.4 * a, 0.2 * a, 0.6 * a}, 1.6);
	expectNear(at(int(edge.x) + 3, int(edge.y)), c, 1.6);
}

TEST_F(PanelSurfaces, AFaceOfACubeIsSeenWhereItIs)
{
	constexpr std::array<std::array<uint8_t, 4>, 6> faces{
		{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 0, 255}, {255, 0, 255, 255}, {0, 255, 255, 255}}};
	const uint64_t key = addCube(
		8, [&](auto, auto, uint32_t layer) { return layer < 6 ? std::array<uint8_t, 4>{} : faces[layer - 6]; }, 2);
	inputs.blendMode = opaque;
	// What turns -z to where the face is, turned back.
	const XrQuaternionf turns[6] = {rotationAbout({0, 1, 0}, M_PI / 2),  rotationAbout({0, 1, 0}, -M_PI / 2),
									rotationAbout({1, 0, 0}, -M_PI / 2), rotationAbout({1, 0, 0}, M_PI / 2),
									rotationAbout({0, 1, 0}, M_PI),      identityOrientation};
	for (size_t face = 0; face < 6; ++face) {
		inputs.layers.clear();
		for (auto &cube : inputs.layers.emplace_back().cube) cube = CubeView{turns[face], {key, 1, {{0, 0}, {8, 8}}}};
		render();
		EXPECT_EQ(at(centreX, centreY), (std::array{int(faces[face][0]), int(faces[face][1]), int(faces[face][2])})) << "face " << face;
	}
}

TEST_F(PanelSurfaces, ADotOnASphereIsSeenWhereItIsAndNothingElse)
{
	// Of 64 x 32 texels that go all round, those around 22.5 degrees to the right and 11.25 up.
	const uint64_t key = addImage(64, 32, [](uint32_t x, uint32_t y, auto) {
		const bool dot = (x == 35 || x == 36) && (y == 13 || y == 14);
		return std::array<uint8_t, 4>{0, uint8_t(dot ? 255 : 0), 0, uint8_t(dot ? 255 : 0)};
	});
	inputs.blendMode = opaque;
	PanelLayer &layer = inputs.layers.emplace_back(PanelLayer{.flags = sourceAlpha});
	for (auto &view : layer.curved)
		view = CurvedView{.surface = Surface::sphere,
						  .centreInFrame = identityPose,
						  .uvAhead = {0.5f, 0.5f},
						  .uvPerUnit = {float(0.5 / M_PI), float(-1 / M_PI)},
						  .texture = {key, 0, {{0, 0}, {64, 32}}}};
	render();
	const double right = M_PI / 8, up = M_PI / 16;
	const glm::dvec2 tangents(std::tan(right), std::tan(up) / std::cos(right));
	for (const Eye eye : {Eye::left, Eye::right}) {
		const auto place = rig.lens.pixel(eye, Channel::green, tangents).value();
		EXPECT_EQ(at(int(place.x), int(place.y))[1], 255);
		EXPECT_EQ(at(int(place.x), int(place.y) - 90)[1], 0);
		EXPECT_EQ(at(int(place.x) - 90, int(place.y))[1], 0);
	}
}

TEST_F(PanelSurfaces, NothingBleedsInFromOutsideASubImage)
{
	const uint64_t key = addGreenAmongMagenta();
	inputs.blendMode = opaque;
	for (auto &view : inputs.layers.emplace_back().curved)
		view = CurvedView{.surface = Surface::cylinder,
						  .centreInFrame = identityPose,
						  .radius = 1,
						  .uvAhead = {0.5f, 0.5f},
						  .uvPerUnit = {1, -1.5f},
						  .texture = {key, 0, greenOnes}};
	render();
	EXPECT_GT(greenPixels(), 50'000);
}

TEST_F(PanelSurfaces, AFlatImageIsNoCubeAndACubeNoFlatImageAndWhatIsGoneIsNeither)
{
	const uint64_t flat = addImage(8, 8, [](auto...) { return std::array<uint8_t, 4>{255, 255, 255, 255}; });
	const uint64_t cubes = addCube(
		8,
		[](auto...) {
			return std::array<uint8_t, 4>{255, 255, 255, 255};
		},
		1);
	inputs.blendMode = opaque;
	for (auto &cube : inputs.layers.emplace_back().cube) cube = CubeView{identityOrientation, {flat, 0, {{0, 0}, {8, 8}}}};
	for (auto &cube : inputs.layers.emplace_back().cube) cube = CubeView{identityOrientation, {cubes, 1, {{0, 0}, {8, 8}}}};
	addQuad(cubes, {identityOrientation, {0, 0, -1}}, {2, 2}, {{0, 0}, {8, 8}});
	constexpr uint64_t nobodys = 100; // a key of no image
	for (auto &cube : inputs.layers.emplace_back().cube) cube = CubeView{identityOrientation, {nobodys, 0, {{0, 0}, {8, 8}}}};
	for (auto &view : inputs.layers.emplace_back().curved)
		view = CurvedView{.centreInFrame = identityPose, .uvPerUnit = {1, -1}, .texture = {nobodys, 0, {{0, 0}, {8, 8}}}};
	render();
	EXPECT_EQ(at(centreX, centreY), (std::array{0, 0, 0}));
}

} // namespace
} // namespace arift
