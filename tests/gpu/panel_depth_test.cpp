// Projection layers whose depth is known, seen from elsewhere than they were drawn for: in every format, from parts of images, and where
// the depth makes no sense. How well everything lies where it must is for reference/panel_depth_test.cpp to say.
#include "runtime/gpu/swapchain_formats.h"
#include "tests/gpu/panel_fixture.h"
#include <cmath>
#include <cstring>
#include <limits>

namespace arift
{
namespace
{

constexpr XrCompositionLayerFlags sourceAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
/// Depth 1 is this far away, metres, depth 0 infinitely far.
constexpr float nearZ = 0.1f;
constexpr float moved = 0.03f;

/// One texel of a depth image as it is copied: Vulkan 1.3, "Copying Data Between Buffers and Images", depth aspect.
void append(std::vector<std::byte> &bytes, VkFormat format, float depth)
{
	const auto add = [&](auto value) {
		const auto *first = reinterpret_cast<const std::byte *>(&value);
		bytes.insert(bytes.end(), first, first + sizeof value);
	};
	switch (format) {
	case VK_FORMAT_D16_UNORM: return add(uint16_t(std::lround(depth * 0xffff)));
	case VK_FORMAT_D24_UNORM_S8_UINT: return add(uint32_t(std::lround(depth * 0xffffff)));
	default: return add(depth);
	}
}

class PanelDepth : public PanelTest
{
protected:
	using PanelTest::PanelTest;

	/// An image whose array layers are filled by `depth` (x, y, layer).
	uint64_t addDepth(uint32_t width, uint32_t height, const std::function<float(uint32_t, uint32_t, uint32_t)> &depth,
					  VkFormat format = VK_FORMAT_D32_SFLOAT, uint32_t arrayLayers = 1)
	{
		const gpu::ImageSpec spec{.format = format,
								  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, // an application that never samples it
								  .width = width,
								  .height = height,
								  .arrayLayers = arrayLayers};
		gpu::SharedImage &image = depths_.emplace_back(device, spec);
		for (uint32_t layer = 0; layer < arrayLayers; ++layer) {
			std::vector<std::byte> bytes;
			for (uint32_t y = 0; y < height; ++y)
				for (uint32_t x = 0; x < width; ++x) append(bytes, format, depth(x, y, layer));
			image.write(layer, bytes);
		}
		const uint64_t key = 1000 + depths_.size();
		renderer.addImage(key, image.image(), spec);
		return key;
	}
	/// As far away as this, everywhere.
	uint64_t addUniformDepth(double distance)
	{
		return addDepth(8, 8, [=](auto...) { return float(nearZ / distance); });
	}
	/// A green dot straight ahead of where the eyes were, on nothing.
	PanelLayer &addDot()
	{
		const uint64_t key = addImage(64, 64, [](uint32_t x, uint32_t y, auto) {
			const bool dot = (x == 31 || x == 32) && (y == 31 || y == 32);
			return std::array<uint8_t, 4>{0, uint8_t(dot ? 255 : 0), 0, uint8_t(dot ? 255 : 0)};
		});
		PanelLayer &layer = inputs.layers.emplace_back(PanelLayer{.flags = sourceAlpha});
		for (size_t e = 0; e < 2; ++e)
			layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-0.8f, 0.8f, 0.8f, -0.8f}, {key, 0, {{0, 0}, {64, 64}}}};
		return layer;
	}
	static void setDepth(PanelLayer &layer, uint64_t image, XrRect2Di rect = {{0, 0}, {8, 8}}, uint32_t arrayIndex = 0)
	{
		for (auto &view : layer.projection) view->depth = ViewDepth{{image, arrayIndex, rect}, 0, 1 / nearZ};
	}
	/// Both eyes, to the right.
	void move(float metres)
	{
		for (size_t e = 0; e < 2; ++e) {
			inputs.top[e].viewInOrigin.position.x += metres;
			inputs.bottom[e].viewInOrigin.position.x += metres;
		}
	}
	/// The middle of what is green in an eye's half of the panel.
	glm::dvec2 dotOf(Eye eye) const
	{
		glm::dvec2 sum(0);
		double weight = 0;
		for (int y = 0; y < 800; ++y)
			for (int x = 0; x < 640; ++x) {
				const int column = x + (eye == Eye::right ? 640 : 0), green = at(column, y)[1];
				sum += double(green) * glm::dvec2(column + 0.5, y + 0.5);
				weight += green;
			}
		return sum / weight;
	}
	/// Where a dot so far away is seen by eyes that have moved; 0: infinitely far.
	glm::dvec2 expected(Eye eye, double distance) const
	{
		const double away = distance > 0 ? distance : 1e6;
		return pixelOf(eye, {rig.eyeInHead[size_t(eye)].position.x, 0, float(-away)});
	}
	void expectDotAt(double distance)
	{
		for (const Eye eye : {Eye::left, Eye::right}) {
			const glm::dvec2 found = dotOf(eye), wanted = expected(eye, distance);
			EXPECT_NEAR(found.x, wanted.x, 0.5);
			EXPECT_NEAR(found.y, wanted.y, 0.5);
		}
	}

	std::vector<std::byte> shown()
	{
		render();
		return panel.pixels;
	}

private:
	std::vector<gpu::SharedImage> depths_;
};

TEST_F(PanelDepth, WhatIsNearMovesAndWhatIsFarDoesNot)
{
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	PanelLayer &layer = addDot();
	move(moved);
	for (const double distance : {0.3, 0.5, 1.0, 4.0, 0.0}) {
		SCOPED_TRACE(distance);
		setDepth(layer, distance > 0 ? addUniformDepth(distance) : addDepth(8, 8, [](auto...) { return 0.0f; }));
		render();
		expectDotAt(distance);
	}
	EXPECT_GT(glm::distance(expected(Eye::left, 0.3), expected(Eye::left, 2)), 20) << "two metres are where it is without depth";
}

TEST_F(PanelDepth, EveryFormatSaysHowFarAwayItIs)
{
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	PanelLayer &layer = addDot();
	move(moved);
	int formats = 0;
	for (const int64_t format : gpu::swapchainFormats(device)) {
		if (!gpu::isDepth(VkFormat(format))) continue;
		SCOPED_TRACE(format);
		const auto half = [](auto...) { return float(nearZ / 0.5); };
		setDepth(layer, addDepth(8, 8, half, VkFormat(format)));
		render();
		expectDotAt(0.5);
		++formats;
	}
	EXPECT_GE(formats, 2);
}

/// The rectangle alone counts, and that array layer: all else says that it is nearer than anything can be.
TEST_F(PanelDepth, ItsPartOfAnImageIsNotThatOfTheColours)
{
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	PanelLayer &layer = addDot();
	move(moved);
	const auto depth = [](uint32_t x, uint32_t y, uint32_t arrayLayer) {
		if (arrayLayer != 1 || x < 3 || x >= 43 || y < 5 || y >= 35) return 1.0f;
		// In its upper left quarter and in the rest: seen at the same places as the picture's.
		return float(x < 23 && y < 20 ? nearZ / 4 : nearZ / 0.5);
	};
	setDepth(layer, addDepth(50, 41, depth, VK_FORMAT_D32_SFLOAT, 3), {{3, 5}, {40, 30}}, 1);
	for (auto &view : layer.projection) view->texture.rect = {{20, 20}, {44, 44}}; // the dot is in its upper left quarter
	render();
	for (const Eye eye : {Eye::left, Eye::right}) {
		// The middle of the dot, (12, 12) of 44, in tangents of the view.
		const double tangent = (12.0 / 44 * 2 - 1) * std::tan(0.8);
		const auto place = rig.lens.pixel(eye, Channel::green, {tangent - moved / 4, -tangent}).value();
		EXPECT_NEAR(dotOf(eye).x, place.x, 0.5);
		EXPECT_NEAR(dotOf(eye).y, place.y, 0.5);
	}
}

TEST_F(PanelDepth, WhatIsNoDistanceIsInfinitelyFarOrNearest)
{
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	PanelLayer &layer = addDot();
	move(moved);
	constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
	constexpr double nearestMoved = 0.2; // the compositor's own
	const std::pair<float, double> cases[] = {{nan, 0}, {-nan, 0}, {-infinity, 0}, {-3, 0}, {infinity, nearestMoved}, {1, nearestMoved}};
	for (const auto &[value, distance] : cases) {
		SCOPED_TRACE(value);
		setDepth(layer, addDepth(8, 8, [number = value](auto...) { return number; }));
		render();
		expectDotAt(distance);
	}
}

TEST_F(PanelDepth, WithoutAMoveOrWithoutAnImageThePictureIsThatOfALayerWithoutDepth)
{
	seeGrey(51);
	PanelLayer &layer = addDot();
	const std::vector<std::byte> atRest = shown();
	setDepth(layer, addUniformDepth(0.4));
	EXPECT_EQ(shown(), atRest);
	move(0.0001f);
	for (auto &view : layer.projection) view->depth.reset();
	const std::vector<std::byte> nearlyAtRest = shown();
	setDepth(layer, addUniformDepth(0.4));
	EXPECT_EQ(shown(), nearlyAtRest);

	move(moved);
	for (auto &view : layer.projection) view->depth.reset();
	const std::vector<std::byte> flat = shown();
	const uint64_t depth = addUniformDepth(0.4);
	setDepth(layer, depth);
	EXPECT_NE(shown(), flat);
	setDepth(layer, depth, {{1, 0}, {8, 8}});
	EXPECT_EQ(shown(), flat) << "a rectangle that is not in the image";
	setDepth(layer, depth, {{0, 0}, {8, 8}}, 1);
	EXPECT_EQ(shown(), flat) << "an array layer that is not in the image";
	setDepth(layer, layer.projection[0]->texture.image);
	EXPECT_EQ(shown(), flat) << "an image of colours";
	setDepth(layer, depth);
	renderer.removeImage(depth);
	EXPECT_EQ(shown(), flat) << "an image that is gone";
}

struct UnreadyDepth : PanelDepth {
	UnreadyDepth() : PanelDepth(Unready::leftOut) {}
};

TEST_F(UnreadyDepth, ALayerIsShownWithoutItsDepthUntilItsPipelineIsMade)
{
	seeGrey(51);
	// What is drawn without depth must be there by now.
	PanelLayer &layer = addDot();
	move(moved);
	const std::vector<std::byte> world = [&] {
		PanelLayer kept = layer;
		inputs.layers.clear();
		std::vector<std::byte> pixels = shown();
		inputs.layers.push_back(kept);
		return pixels;
	}();
	std::vector<std::byte> flat;
	for (const XrTime end = realTime() + 60 * second; (flat = shown()) == world && realTime() < end;) continue;
	ASSERT_NE(flat, world);
	setDepth(inputs.layers.front(), addUniformDepth(0.3));
	EXPECT_EQ(shown(), flat) << "what is first asked for cannot be there";
	std::vector<std::byte> deep = flat;
	for (const XrTime end = realTime() + 60 * second; deep == flat && realTime() < end;) {
		deep = shown();
		EXPECT_NE(deep, world) << "it is never left out";
	}
	EXPECT_NE(deep, flat);
}

TEST_F(UnreadyDepth, ALayerIsNotTestedInItsRangeUntilTheRestOfItCanBeDrawn)
{
	seeGrey(51);
	PanelLayer layer = addDot();
	inputs.layers.clear();
	move(moved);
	const std::vector<std::byte> world = shown();
	setDepth(layer, addUniformDepth(0.3));
	layer.depthTest = DepthTest{VK_COMPARE_OP_LESS_OR_EQUAL, true};
	for (auto &view : layer.projection) view->depth->testedFrom = 1; // nothing of it is tested
	inputs.layers.push_back(layer);
	std::vector<std::byte> flat;
	for (const XrTime end = realTime() + 60 * second; (flat = shown()) == world && realTime() < end;) continue;
	ASSERT_NE(flat, world);
	std::vector<std::byte> deep = flat;
	for (const XrTime end = realTime() + 60 * second; deep == flat && realTime() < end;) {
		deep = shown();
		EXPECT_EQ(renderer.cost().leftOut, 0u) << "nothing of it is ever left out";
	}
	EXPECT_NE(deep, world);
	EXPECT_NE(deep, flat);
}

} // namespace
} // namespace arift
