// Where an image has content, and what follows for what is drawn: without a GPU.
#include "runtime/compositor/drawing.h"
#include "runtime/optics/rig.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr uint32_t width = 100, height = 70, pitch = 480;

struct Memory {
	std::vector<std::byte> bytes = std::vector<std::byte>(size_t(pitch) * height);
	Occupancy occupancy{
		{.first = bytes.data(), .rowPitch = pitch, .bytesPerTexel = 4, .alphaLast = true, .width = width, .height = height}};
	std::byte &at(uint32_t x, uint32_t y, uint32_t channel) { return bytes[size_t(y) * pitch + size_t(x) * 4 + channel]; }
};

TEST(Occupancy, findsEverySingleTexelInItsBlockAlone)
{
	Memory memory;
	constexpr int block = Occupancy::block;
	for (const auto &[x, y] : {std::pair{0, 0}, {31, 31}, {32, 0}, {99, 69}, {64, 40}, {99, 0}})
		for (uint32_t channel = 0; channel < 4; ++channel) {
			memory.at(uint32_t(x), uint32_t(y), channel) = std::byte{1};
			memory.occupancy.forget();
			for (int column = 0; column * block < int(width); ++column)
				for (int row = 0; row * block < int(height); ++row) {
					const TexelRect inside{column * block, row * block, (column + 1) * block, (row + 1) * block};
					const bool here = column == x / block && row == y / block;
					EXPECT_EQ(memory.occupancy.contentOf(inside), here ? Content::some : Content::none) << x << ' ' << y;
				}
			memory.at(uint32_t(x), uint32_t(y), channel) = std::byte{0};
		}
}

TEST(Occupancy, doesNotLookBesideTheImage)
{
	Memory memory;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 4 * width; x < pitch; ++x) memory.bytes[size_t(y) * pitch + x] = std::byte{255};
	EXPECT_EQ(memory.occupancy.contentOf({-50, -50, 500, 500}), Content::none);
	EXPECT_EQ(memory.occupancy.contentOf({100, 0, 120, 10}), Content::none);
	EXPECT_EQ(memory.occupancy.contentOf({-20, 0, 0, 10}), Content::none);
}

TEST(Occupancy, looksAtABlockOnceUntilItIsToldToForget)
{
	Memory memory;
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, 32, 32}), Content::none);
	memory.at(5, 5, 3) = std::byte{9};
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, 32, 32}), Content::none);
	EXPECT_EQ(memory.occupancy.examined(), 1u);
	memory.occupancy.forget();
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, 32, 32}), Content::some);
}

TEST(Occupancy, isOpaqueWhereEveryTexelIs)
{
	Memory memory;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 0; x < width; ++x) memory.at(x, y, 3) = std::byte{255};
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, int(width), int(height)}), Content::opaque);
	for (const auto &[x, y] : {std::pair{31u, 31u}, {32u, 0u}, {99u, 69u}, {67u, 45u}, {98u, 0u}}) {
		memory.at(x, y, 3) = std::byte{254};
		memory.occupancy.forget();
		EXPECT_EQ(memory.occupancy.contentOf({0, 0, int(width), int(height)}), Content::some) << x << ' ' << y;
		EXPECT_EQ(memory.occupancy.contentOf({int(x), int(y), int(x) + 1, int(y) + 1}), Content::some) << x << ' ' << y;
		const uint32_t other = x < 32 ? 64 : 0;
		EXPECT_EQ(memory.occupancy.contentOf({int(other), 0, int(other) + 1, 1}), Content::opaque) << x << ' ' << y;
		memory.at(x, y, 3) = std::byte{255};
	}
}

TEST(Occupancy, emptyAndOpaqueTogetherAreNeither)
{
	Memory memory;
	for (uint32_t y = 0; y < 32; ++y)
		for (uint32_t x = 0; x < 32; ++x) memory.at(x, y, 3) = std::byte{255};
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, 32, 32}), Content::opaque);
	EXPECT_EQ(memory.occupancy.contentOf({32, 0, 64, 32}), Content::none);
	EXPECT_EQ(memory.occupancy.contentOf({0, 0, 64, 32}), Content::some);
}

TEST(Occupancy, withoutAnAlphaByteNothingIsKnownToBeOpaque)
{
	const std::vector<std::byte> bytes(size_t(8) * 64 * 64, std::byte{255});
	Occupancy occupancy({.first = bytes.data(), .rowPitch = 8 * 64, .bytesPerTexel = 8, .width = 64, .height = 64});
	EXPECT_EQ(occupancy.contentOf({0, 0, 64, 64}), Content::some);
}

// ---- what is drawn

/// The shipped Rig, both cameras, one projection layer over everything whose image is 1000 x 1000 texels.
class DrawnWork : public testing::Test
{
protected:
	static constexpr uint32_t size = 1000;

	DrawnWork()
	{
		for (uint32_t e = 0; e < 2; ++e) {
			const CameraModel &model = rig.cameras[e].model;
			CameraFrame frame{.format = PixelFormat::bayerRggb8, .width = model.width(), .height = model.height(), .stride = model.width()};
			frame.buffer = makeHostFrameBuffer(size_t(frame.stride) * frame.height);
			inputs.cameras[e] = CameraView{.frame = frame, .cameraInOrigin = rig.cameras[e].cameraInHead, .lens = e};
			inputs.top[e] = inputs.bottom[e] = {rig.eyeInHead[e], identityPose};
		}
		inputs.layers.push_back(projection(XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT));
	}
	PanelLayer projection(XrCompositionLayerFlags flags) const
	{
		PanelLayer layer{.flags = flags};
		for (size_t e = 0; e < 2; ++e) {
			const float wide = 1.2f;
			layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-wide, wide, wide, -wide}, {1, 0, {{0, 0}, {size, size}}, 0}};
		}
		return layer;
	}
	Drawing drawing()
	{
		occupancy.forget();
		const auto findImage = [this](const LayerTexture &) { return KnownImage{&spec, &occupancy}; };
		return makeDrawing(inputs, optics, geometry, grids, findImage, [](const PipelineKey &) { return true; });
	}
	/// Pixels drawn by pipelines of which `which` is true.
	template <typename Which> static int pixels(const Drawing &drawing, Which which)
	{
		int sum = 0;
		for (const DrawItem &item : drawing.items)
			for (uint32_t i = item.firstVertex; which(item.pipeline) && i < item.firstVertex + item.vertexCount; i += 6) {
				const auto &first = drawing.vertices[i], &last = drawing.vertices[i + 5];
				sum += (last[0] - first[0]) * (last[1] - first[1]);
			}
		return sum;
	}
	static bool withLayer(const PipelineKey &key) { return key.layer != Cover::none; }
	static bool withCamera(const PipelineKey &key) { return key.background == Background::camera; }
	static bool any(const PipelineKey &) { return true; }

	Rig rig = readRig(ARIFT_RIG);
	PanelOptics optics{rig};
	ViewGeometry geometry = panelGeometry(optics);
	std::array<TileGrid, 2> grids{makeGrid(optics, geometry, 0), makeGrid(optics, geometry, 1)};
	gpu::ImageSpec spec{.format = VK_FORMAT_R8G8B8A8_SRGB, .width = size, .height = size};
	std::vector<std::byte> texels = std::vector<std::byte>(size_t(size) * size * 4);
	Occupancy occupancy{
		{.first = texels.data(), .rowPitch = size_t(size) * 4, .bytesPerTexel = 4, .alphaLast = true, .width = size, .height = size}};
	PanelInputs inputs;
};

TEST_F(DrawnWork, aLayerIsNotAskedWhereItIsEmpty)
{
	EXPECT_EQ(pixels(drawing(), withLayer), 0);
	// One texel, seen straight ahead by both eyes.
	texels[(size_t(size) / 2 * size + size / 2) * 4 + 3] = std::byte{1};
	const Drawing one = drawing();
	EXPECT_GT(pixels(one, withLayer), 0);
	EXPECT_LT(pixels(one, withLayer), pixels(one, any) / 20);
	std::ranges::fill(texels, std::byte{1});
	const Drawing all = drawing();
	EXPECT_GT(pixels(all, withLayer), pixels(all, any) * 9 / 10);
}

TEST_F(DrawnWork, anEmptyOpaqueLayerIsBlack)
{
	inputs.layers = {projection(0)};
	const Drawing black = drawing();
	EXPECT_GT(pixels(black, withLayer), pixels(black, any) * 9 / 10);
}

TEST_F(DrawnWork, thePanelIsPassedOnce)
{
	std::ranges::fill(texels, std::byte{1});
	int circle = 0;
	for (const TileGrid &grid : grids)
		for (int row = 0; row < grid.rows(); ++row)
			for (int column = 0; column < grid.columns(); ++column) {
				const PixelRect tile = grid.tile(column, row);
				if (tile.width() > 0) circle += tile.width() * tile.height();
			}
	EXPECT_EQ(pixels(drawing(), any), circle);
	inputs.layers.clear();
	EXPECT_EQ(pixels(drawing(), any), circle);
}

TEST_F(DrawnWork, aCameraIsNotAskedWhereItSeesNothing)
{
	const int seen = pixels(drawing(), withCamera), all = pixels(drawing(), any);
	EXPECT_LT(seen, all * 2 / 3); // its lens covers about half of the view
	for (auto &camera : inputs.cameras) camera->cameraInOrigin.orientation = rotationAbout({0, 1, 0}, M_PI);
	EXPECT_EQ(pixels(drawing(), withCamera), 0);
}

TEST_F(DrawnWork, aCameraIsNotAskedBehindAnOpaqueLayer)
{
	inputs.layers = {projection(0)};
	const Drawing covered = drawing();
	EXPECT_LT(pixels(covered, withCamera), pixels(covered, any) / 10);
}

TEST_F(DrawnWork, aCameraIsNotAskedBehindTexelsThatAreOpaque)
{
	std::ranges::fill(texels, std::byte{255});
	const Drawing covered = drawing();
	EXPECT_LT(pixels(covered, withCamera), pixels(covered, any) / 10);
	// One texel straight ahead lets what is behind it through.
	texels[(size_t(size) / 2 * size + size / 2) * 4 + 3] = std::byte{254};
	const Drawing pierced = drawing();
	EXPECT_GT(pixels(pierced, withCamera), pixels(covered, withCamera));
	EXPECT_LT(pixels(pierced, withCamera), pixels(pierced, any) / 10);
	// Light is added to it all the same.
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
	EXPECT_GT(pixels(drawing(), withCamera), pixels(covered, any) / 3);
}

} // namespace
} // namespace arift
