// Layers that are tested for how far away they are: which of two is seen, by all comparisons, on every surface, and where both meet.
#include "tests/gpu/panel_fixture.h"
#include <cmath>

namespace arift
{
namespace
{

using namespace by_hand;

constexpr std::array<int, 3> black{0, 0, 0}, red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255};
constexpr DepthTest lessAndWrites{VK_COMPARE_OP_LESS, true};

class PanelTestedLayers : public PanelTest
{
protected:
	PanelTestedLayers() { inputs.blendMode = opaque; }

	uint64_t addPlainImage(std::array<int, 3> shown)
	{
		return addImage(4, 4, [&](auto...) { return std::array{uint8_t(shown[0]), uint8_t(shown[1]), uint8_t(shown[2]), uint8_t(255)}; });
	}
	static constexpr XrRect2Di whole{{0, 0}, {4, 4}};
	/// A quad straight ahead that fills the middle of the view, turned about y.
	void addWall(std::array<int, 3> shown, double distance, std::optional<DepthTest> test, double turned = 0)
	{
		PanelLayer &layer = addQuad(addPlainImage(shown), {rotationAbout({0, 1, 0}, turned), {0, 0, float(-distance)}},
									{float(distance), float(distance)}, whole);
		layer.depthTest = test;
	}
	/// As far away as this, everywhere.
	void addView(std::array<int, 3> shown, double distance, DepthTest test)
	{
		PanelLayer &layer = addUniformLayer({uint8_t(shown[0]), uint8_t(shown[1]), uint8_t(shown[2]), 255}, sourceAlpha);
		const uint64_t depth = addDepth(4, [&](auto) { return float(nearZ / distance); });
		for (auto &view : layer.projection) view->depth = ViewDepth{{depth, 0, whole}, 0, 1 / nearZ};
		layer.depthTest = test;
	}
	void expectInTheMiddle(std::array<int, 3> shown)
	{
		render();
		for (const int x : {centreX, 1280 - centreX}) EXPECT_EQ(at(x, centreY), shown) << x;
	}
	/// The only layer's views are tested in this range alone.
	static void setRange(PanelLayer &layer, float from, float to)
	{
		for (auto &view : layer.projection) {
			view->depth->testedFrom = from;
			view->depth->testedTo = to;
		}
	}

	static constexpr float nearZ = 0.05f; ///< the distance of depth 1, metres; depth 0 is infinitely far away
	/// A square whose columns hold `depth`.
	uint64_t addDepth(uint32_t size, const std::function<float(uint32_t)> &depth, VkImageCreateFlags flags = 0)
	{
		const gpu::ImageSpec spec{.format = VK_FORMAT_D32_SFLOAT,
								  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
								  .createFlags = flags,
								  .width = size,
								  .height = size,
								  .arrayLayers = flags ? 6u : 1u};
		gpu::SharedImage &image = depths_.emplace_back(device, spec);
		std::vector<float> values;
		for (uint32_t i = 0; i < size * size; ++i) values.push_back(depth(i % size));
		image.write(0, std::as_bytes(std::span(values)));
		const uint64_t key = 1000 + depths_.size();
		renderer.addImage(key, image.image(), spec);
		return key;
	}

private:
	std::vector<gpu::SharedImage> depths_;
};

TEST_F(PanelTestedLayers, WhatIsNearerHidesWhatIsDrawnLater)
{
	addWall(red, 1, lessAndWrites);
	addWall(green, 2, lessAndWrites);
	expectInTheMiddle(red);
	for (PanelLayer &layer : inputs.layers) layer.depthTest.reset();
	expectInTheMiddle(green);
}

TEST_F(PanelTestedLayers, EveryComparisonLetsThroughWhatItSays)
{
	const struct {
		VkCompareOp compare;
		bool nearer, equal, farther; ///< than what is there, is seen
	} cases[] = {{VK_COMPARE_OP_NEVER, false, false, false},          {VK_COMPARE_OP_LESS, true, false, false},
				 {VK_COMPARE_OP_EQUAL, false, true, false},           {VK_COMPARE_OP_LESS_OR_EQUAL, true, true, false},
				 {VK_COMPARE_OP_GREATER, false, false, true},         {VK_COMPARE_OP_NOT_EQUAL, true, false, true},
				 {VK_COMPARE_OP_GREATER_OR_EQUAL, false, true, true}, {VK_COMPARE_OP_ALWAYS, true, true, true}};
	for (const auto &[compare, nearer, equal, farther] : cases) {
		SCOPED_TRACE(compare);
		for (const auto &[distance, isSeen] : {std::pair{0.99, nearer}, {1.0, equal}, {1.01, farther}}) {
			SCOPED_TRACE(distance);
			inputs.layers.clear();
			addWall(red, 1, lessAndWrites);
			addWall(green, distance, DepthTest{compare, false});
			expectInTheMiddle(isSeen ? green : red);
		}
	}
}

TEST_F(PanelTestedLayers, NothingIsFartherThanWhatIsThereAtFirst)
{
	addWall(green, 1000, DepthTest{VK_COMPARE_OP_GREATER_OR_EQUAL, true});
	expectInTheMiddle(black);
	inputs.layers.front().depthTest->compare = VK_COMPARE_OP_LESS;
	expectInTheMiddle(green);
}

TEST_F(PanelTestedLayers, WhatDoesNotWriteHidesNothing)
{
	addWall(red, 1, DepthTest{VK_COMPARE_OP_LESS, false});
	addWall(green, 2, lessAndWrites);
	expectInTheMiddle(green);
}

TEST_F(PanelTestedLayers, WhatIsHiddenByAnOpaqueLayerHidesWhatIsAboveIt)
{
	addWall(red, 1, lessAndWrites);
	addWall(blue, 3, {}); // over red, and without a depth of its own
	addWall(green, 2, lessAndWrites);
	expectInTheMiddle(blue);
}

TEST_F(PanelTestedLayers, TwoWallsMeetWhereTheyAreEquallyFar)
{
	addWall(red, 1, lessAndWrites, M_PI / 6);
	addWall(green, 1, lessAndWrites, -M_PI / 6);
	render();
	for (const Eye eye : {Eye::left, Eye::right}) {
		// What is turned to the left comes nearer on its left.
		const glm::dvec2 axis = pixelOf(eye, {0, 0, -1});
		const int x = int(std::floor(axis.x)), y = int(axis.y);
		EXPECT_EQ(at(x - 2, y), red);
		EXPECT_EQ(at(x + 2, y), green);
	}
}

TEST_F(PanelTestedLayers, ACylinderAndASphereAreAsFarAsTheirRadius)
{
	for (const Surface surface : {Surface::cylinder, Surface::sphere})
		for (const auto &[distance, shown] : {std::pair{1.45, red}, {1.55, green}}) {
			inputs.layers.clear();
			addWall(red, distance, lessAndWrites);
			PanelLayer &layer = inputs.layers.emplace_back();
			for (auto &view : layer.curved)
				view = CurvedView{.surface = surface,
								  .centreInFrame = identityPose,
								  .radius = 1.5f,
								  .uvAhead = {0.5f, 0.5f},
								  .uvPerUnit = {0.5f, -0.5f},
								  .texture = {addPlainImage(green), 0, whole}};
			layer.depthTest = lessAndWrites;
			expectInTheMiddle(shown);
		}
}

TEST_F(PanelTestedLayers, WhatIsInfinitelyFarIsBehindEverything)
{
	addWall(red, 1000, lessAndWrites);
	const uint64_t key = addCube(
		4,
		[](auto...) {
			return std::array<uint8_t, 4>{0, 255, 0, 255};
		},
		1);
	PanelLayer &layer = inputs.layers.emplace_back();
	for (auto &cube : layer.cube) cube = CubeView{identityOrientation, {key, 0, whole}};
	layer.depthTest = DepthTest{VK_COMPARE_OP_LESS_OR_EQUAL, true};
	expectInTheMiddle(red);
	EXPECT_EQ(at(centreX, centreY - 300), green) << "beside the wall";
}

TEST_F(PanelTestedLayers, AViewIsAsFarAsItsDepthSays)
{
	for (const auto &[distance, shown] : {std::pair{1.9, green}, {2.1, red}}) {
		inputs.layers.clear();
		addWall(red, 2, lessAndWrites);
		addView(green, distance, lessAndWrites);
		expectInTheMiddle(shown);
	}
	for (const auto &[distance, shown] : {std::pair{1.9, red}, {2.1, green}}) {
		inputs.layers.clear();
		addView(green, 2, lessAndWrites);
		addWall(red, distance, lessAndWrites);
		expectInTheMiddle(shown);
	}
}

TEST_F(PanelTestedLayers, WhatIsNearerThanIsMovedIsTestedAllTheSame)
{
	for (const auto &[distance, shown] : {std::pair{0.12, green}, {0.18, red}}) {
		inputs.layers.clear();
		addWall(red, 0.15, lessAndWrites);
		addView(green, distance, lessAndWrites);
		expectInTheMiddle(shown);
	}
}

/// A view of a near thing before a far wall, and between both another layer: beside the near thing, where the view saw nothing of what is
/// behind it, the wall's colour is drawn out; it is as far away as the wall there, too.
TEST_F(PanelTestedLayers, WhatIsDrawnOutOverAHoleIsAsFarAsWhatItShows)
{
	addWall(red, 1, lessAndWrites);
	constexpr uint32_t size = 512;
	const auto isNear = [](uint32_t column) { return column < size / 2; };
	const uint64_t picture = addImage(size, size, [&](uint32_t x, auto, auto) {
		return isNear(x) ? std::array<uint8_t, 4>{0, 0, 255, 255} : std::array<uint8_t, 4>{0, 255, 0, 255};
	});
	const uint64_t depth = addDepth(size, [&](uint32_t x) { return float(nearZ / (isNear(x) ? 0.4 : 3.0)); });
	PanelLayer &layer = inputs.layers.emplace_back();
	for (size_t e = 0; e < 2; ++e) {
		layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-0.8f, 0.8f, 0.8f, -0.8f}, {picture, 0, {{0, 0}, {size, size}}}};
		layer.projection[e]->depth = ViewDepth{{depth, 0, {{0, 0}, {size, size}}}, 0, 1 / nearZ};
		inputs.top[e].viewInOrigin.position.x += 0.03f;
		inputs.bottom[e].viewInOrigin.position.x += 0.03f;
	}
	layer.depthTest = lessAndWrites;
	render();
	int reds = 0, blues = 0, greens = 0;
	for (const Eye eye : {Eye::left, Eye::right}) {
		// Across the edge of the near thing, within the wall at 1 m.
		const glm::dvec2 from = pixelOf(eye, {-0.3f, 0, -1}), to = pixelOf(eye, {0.4f, 0, -1});
		for (int x = int(from.x); x < int(to.x); ++x) {
			const auto seen = at(x, int(from.y));
			reds += seen == red;
			blues += seen == blue;
			greens += seen[1] > 100;
		}
	}
	EXPECT_GT(reds, 100);
	EXPECT_GT(blues, 100);
	EXPECT_LE(greens, 12) << "the wall behind: where colours of both are mixed in the picture, and nowhere else";
}

TEST_F(PanelTestedLayers, AViewWithoutDepthIsNotTested)
{
	addWall(red, 1, lessAndWrites);
	addView(green, 2, lessAndWrites);
	expectInTheMiddle(red);
	for (auto &view : inputs.layers.back().projection) view->depth.reset();
	expectInTheMiddle(green);
}

TEST_F(PanelTestedLayers, ACubeOfDepthsIsNoDepth)
{
	addWall(red, 1, lessAndWrites);
	addView(green, 2, lessAndWrites);
	const uint64_t cube = addDepth(
		4, [](auto) { return 0.0f; }, VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT);
	for (auto &view : inputs.layers.back().projection) view->depth->texture.image = cube;
	expectInTheMiddle(green);
}

TEST_F(PanelTestedLayers, WhatAKeyLeavesIsTested)
{
	addWall(red, 1, lessAndWrites);
	addView(green, 2, lessAndWrites);
	inputs.layers.back().key = KeyedOut{.key = {.colour = {0, 0, 1}}};
	expectInTheMiddle(red);
	inputs.layers.back().depthTest->compare = VK_COMPARE_OP_GREATER;
	expectInTheMiddle(green);
	inputs.layers.back().key->key.colour = {0, 1, 0};
	expectInTheMiddle(red);
}

TEST_F(PanelTestedLayers, OutsideItsRangeAViewIsSeenWithoutATest)
{
	addWall(red, 1, lessAndWrites);
	addView(green, 2, DepthTest{VK_COMPARE_OP_LESS_OR_EQUAL, true});
	PanelLayer &view = inputs.layers.back();
	for (const auto &[from, to, shown] :
		 {std::tuple{0.0f, 0.0f, red}, {1.9f, 2.1f, red}, {0.0f, 2.1f, red}, {1.9f, 0.0f, red}, {2.1f, 0.0f, green}, {0.0f, 1.9f, green}}) {
		SCOPED_TRACE(testing::Message() << from << " to " << to);
		setRange(view, from, to);
		expectInTheMiddle(shown);
	}
	// What is seen without a test is not there for others.
	addWall(blue, 1.5, lessAndWrites);
	setRange(inputs.layers[1], 0, 1.9f);
	expectInTheMiddle(green);
	inputs.layers.erase(inputs.layers.begin());
	expectInTheMiddle(blue);
}

TEST_F(PanelTestedLayers, WhereALayerShowsNothingItHidesNothing)
{
	addWall(green, 2, lessAndWrites);
	PanelLayer small = inputs.layers.front();
	for (auto &quad : small.quad) {
		quad->size = {0.01f, 0.01f};
		quad->quadInFrame.position.z = -1;
		quad->texture.image = addPlainImage(red);
	}
	inputs.layers.insert(inputs.layers.begin(), small);
	render();
	const glm::dvec2 place = pixelOf(Eye::left, {0, 0, -1});
	EXPECT_EQ(at(int(place.x), int(place.y)), red);
	EXPECT_EQ(at(int(place.x) + 8, int(place.y)), green);
	EXPECT_EQ(at(int(place.x) - 8, int(place.y)), green);
}

TEST_F(PanelTestedLayers, LayersOverTheWorldAreTestedToo)
{
	seeGrey(cameraValue);
	inputs.blendMode = alphaBlend;
	addWall(red, 1, lessAndWrites);
	addWall(green, 2, lessAndWrites);
	expectInTheMiddle(red);
	render();
	const glm::dvec2 beside = pixelOf(Eye::left, {-0.62f, 0, -1});
	expectNear(at(int(beside.x), int(beside.y)), {camera, camera, camera}, 1.6);
}

} // namespace
} // namespace arift
