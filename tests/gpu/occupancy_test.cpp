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
	Occupancy occupancy{bytes.data(), pitch, 4, width, height};
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
					EXPECT_EQ(memory.occupancy.mayHaveContent(inside), column == x / block && row == y / block) << x << ' ' << y;
				}
			memory.at(uint32_t(x), uint32_t(y), channel) = std::byte{0};
		}
}

TEST(Occupancy, doesNotLookBesideTheImage)
{
	Memory memory;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 4 * width; x < pitch; ++x) memory.bytes[size_t(y) * pitch + x] = std::byte{255};
	EXPECT_FALSE(memory.occupancy.mayHaveContent({-50, -50, 500, 500}));
	EXPECT_FALSE(memory.occupancy.mayHaveContent({100, 0, 120, 10}));
	EXPECT_FALSE(memory.occupancy.mayHaveContent({-20, 0, 0, 10}));
}

TEST(Occupancy, looksAtABlockOnceUntilItIsToldToForget)
{
	Memory memory;
	EXPECT_FALSE(memory.occupancy.mayHaveContent({0, 0, 32, 32}));
	memory.at(5, 5, 3) = std::byte{9};
	EXPECT_FALSE(memory.occupancy.mayHaveContent({0, 0, 32, 32}));
	EXPECT_EQ(memory.occupancy.examined(), 1u);
	memory.occupancy.forget();
	EXPECT_TRUE(memory.occupancy.mayHaveContent({0, 0, 32, 32}));
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
		return makeDrawing(inputs, optics, geometry, grids, [this](const LayerTexture &) { return KnownImage{&spec, &occupancy}; });
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
	static bool withLayer(const PipelineKey &key) { return key.layer; }
	static bool withCamera(const PipelineKey &key) { return key.background == Background::camera; }
	static bool any(const PipelineKey &) { return true; }

	Rig rig = readRig(ARIFT_RIG);
	PanelOptics optics{rig};
	ViewGeometry geometry = panelGeometry(optics);
	std::array<TileGrid, 2> grids{makeGrid(optics, geometry, 0), makeGrid(optics, geometry, 1)};
	gpu::ImageSpec spec{.format = VK_FORMAT_R8G8B8A8_SRGB, .width = size, .height = size};
	std::vector<std::byte> texels = std::vector<std::byte>(size_t(size) * size * 4);
	Occupancy occupancy{texels.data(), size_t(size) * 4, 4, size, size};
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

} // namespace
} // namespace arift
