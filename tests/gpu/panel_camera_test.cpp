// Camera images on the panel: every format, uploaded once, and what is shown where there is none.
#include "tests/gpu/panel_fixture.h"

namespace arift
{
namespace
{

/// sRGB bytes of the dimmest wall: what the fill must stay below.
constexpr int dim = 70;

TEST_F(PanelTest, withoutACameraIsCalmAndBlackOutsideTheLens)
{
	render();
	for (int x = 0; x < 1280; x += 13)
		for (int y = 0; y < 800; y += 11)
			for (const int value : at(x, y)) EXPECT_LE(value, dim) << x << ' ' << y;
	EXPECT_GT(at(centreX, centreY)[1], 10);
	EXPECT_EQ(at(0, 0), (std::array{0, 0, 0}));
	EXPECT_EQ(at(639, 0), (std::array{0, 0, 0}));
	EXPECT_EQ(at(1279, 799), (std::array{0, 0, 0}));
}

TEST_F(PanelTest, opaqueModeWithoutLayersIsBlackEvenWithACamera)
{
	seeGrey(200);
	inputs.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	render();
	for (const std::byte value : std::span(panel.pixels).first(4 * 1280 * 400))
		ASSERT_TRUE(value == std::byte{0} || value == std::byte{255}); // alpha
	EXPECT_EQ(at(centreX, centreY), (std::array{0, 0, 0}));
}

TEST_F(PanelTest, greyIsLinearLight)
{
	seeGrey(128);
	render();
	expectNear(at(centreX, centreY), {128 / 255.0, 128 / 255.0, 128 / 255.0});
	expectNear(at(1280 - centreX, centreY), {128 / 255.0, 128 / 255.0, 128 / 255.0});
}

TEST_F(PanelTest, encodedCamerasAreDecoded)
{
	seeGrey(100);
	for (auto &camera : inputs.cameras) camera->linear = false;
	render();
	for (const int value : at(centreX, centreY)) EXPECT_NEAR(value, 100, 1);
}

TEST_F(PanelTest, grey16HasSixteenBits)
{
	const auto value = [](uint32_t x, uint32_t) { return uint8_t(x % 2 ? 0x80 : 0x55); }; // little endian 0x8055
	inputs.cameras[0] = CameraView{.frame = frame(PixelFormat::grey16, value), .cameraInOrigin = rig.eyeInHead[0]};
	render();
	const double linear = 0x8055 / 65535.0;
	expectNear(at(centreX, centreY), {linear, linear, linear});
}

struct BayerCase {
	const char *name;
	PixelFormat format;
	uint32_t redX, redY;
};
void PrintTo(const BayerCase &bayer, std::ostream *out) { *out << bayer.name; }
class PanelBayerTest : public PanelTest, public testing::WithParamInterface<BayerCase>
{
};

TEST_P(PanelBayerTest, coloursComeFromTheirOwnLattices)
{
	const BayerCase bayer = GetParam();
	const auto value = [&](uint32_t x, uint32_t y) -> uint8_t {
		const bool redColumn = x % 2 == bayer.redX, redRow = y % 2 == bayer.redY;
		return redColumn && redRow ? 200 : !redColumn && !redRow ? 50 : 100;
	};
	inputs.cameras[0] = CameraView{.frame = frame(bayer.format, value), .cameraInOrigin = rig.eyeInHead[0]};
	render();
	for (const int offset : {-60, 0, 61}) expectNear(at(centreX + offset, centreY + offset), {200 / 255.0, 100 / 255.0, 50 / 255.0});
}
INSTANTIATE_TEST_SUITE_P(EveryOrder, PanelBayerTest,
						 testing::Values(BayerCase{"rggb", PixelFormat::bayerRggb8, 0, 0}, BayerCase{"grbg", PixelFormat::bayerGrbg8, 1, 0},
										 BayerCase{"gbrg", PixelFormat::bayerGbrg8, 0, 1},
										 BayerCase{"bggr", PixelFormat::bayerBggr8, 1, 1}),
						 [](const auto &test) { return test.param.name; });

TEST_F(PanelTest, blackLevelAndWhiteBalanceAreApplied)
{
	seeGrey(100);
	for (auto &camera : inputs.cameras) {
		camera->blackLevel = 20 / 255.0;
		camera->whiteBalance = {1.5f, 1, 0.5f};
	}
	render();
	const double light = 80 / 235.0;
	expectNear(at(centreX, centreY), {1.5 * light, light, 0.5 * light});
}

TEST_F(PanelTest, anEdgeLiesWhereTheModelPutsIt)
{
	// Right half bright: the edge between columns 159 and 160 is at column 159.5, on the camera's axis, seen straight ahead.
	inputs.cameras[0] = CameraView{.frame = frame(PixelFormat::grey8, [](uint32_t x, auto) { return uint8_t(x >= 160 ? 200 : 0); }),
								   .cameraInOrigin = rig.eyeInHead[0]};
	render();
	// One texel is 1 / 220 of a tangent, 1.65 panel pixels; half the light is reached at the axis.
	const double axis = rig.lens.centre(Eye::left).x;
	expectNear(at(int(axis - 3), centreY), {0, 0, 0}, 2);
	expectNear(at(int(axis + 3), centreY), {200 / 255.0, 200 / 255.0, 200 / 255.0}, 2);
	int crossing = 0;
	while (at(crossing, centreY)[1] < encoded(100 / 255.0)) ++crossing;
	EXPECT_NEAR(crossing + 0.5, axis, 1);
}

TEST_F(PanelTest, memoryOfOthersAndPaddedRowsAreShownToo)
{
	const auto value = [](uint32_t x, uint32_t y) { return uint8_t(x % 2 == 0 && y % 2 == 0 ? 200 : x % 2 && y % 2 ? 50 : 100); };
	for (const bool ours : {true, false})
		for (const uint32_t padding : {0u, 64u, 13u}) {
			inputs.cameras[0] =
				CameraView{.frame = frame(PixelFormat::bayerRggb8, value, ours, padding), .cameraInOrigin = rig.eyeInHead[0]};
			render();
			expectNear(at(centreX, centreY), {200 / 255.0, 100 / 255.0, 50 / 255.0});
		}
}

TEST_F(PanelTest, anImageIsUploadedOnce)
{
	seeGrey(128);
	render();
	// The same image again: bytes changed behind the renderer's back are not seen, a new image's are.
	for (std::byte &byte : inputs.cameras[0]->frame.buffer->bytes()) byte = std::byte{10};
	render();
	expectNear(at(centreX, centreY), {128 / 255.0, 128 / 255.0, 128 / 255.0});
	inputs.cameras[0]->frame.sequence += 10;
	render();
	expectNear(at(centreX, centreY), {10 / 255.0, 10 / 255.0, 10 / 255.0});
}

TEST_F(PanelTest, formatsMayChangeFromImageToImage)
{
	seeGrey(128);
	render();
	inputs.cameras[0]->frame = frame(PixelFormat::bayerBggr8, [](auto, auto) { return uint8_t(60); });
	render();
	expectNear(at(centreX, centreY), {60 / 255.0, 60 / 255.0, 60 / 255.0});
	seeGrey(20);
	render();
	expectNear(at(centreX, centreY), {20 / 255.0, 20 / 255.0, 20 / 255.0});
}

TEST_F(PanelTest, theCameraFadesSoftlyIntoTheFill)
{
	seeGrey(255);
	render();
	// From the middle outwards brightness never jumps: 4 degrees are about 25 pixels, and at most 1.5 / 25 of the light per pixel.
	double before = 1;
	int faded = 0;
	for (int x = centreX; x > 20; --x) {
		const double now = at(x, centreY)[1] / 255.0;
		EXPECT_LE(before - now, 0.25) << x;
		EXPECT_LE(now, before + 0.02) << x;
		faded += now < 0.98 && now > 0.3;
		before = now;
	}
	EXPECT_GE(faded, 10);
	EXPECT_LE(at(30, centreY)[1], dim);
	EXPECT_GT(at(60, centreY)[1], 5);
}

TEST_F(PanelTest, weightFadesAReplacementIn)
{
	seeGrey(255);
	inputs.cameras[0]->weight = 0;
	inputs.cameras[1]->weight = 0.5f;
	render();
	EXPECT_LE(at(centreX, centreY)[1], dim);
	EXPECT_NEAR(at(1280 - centreX, centreY)[1], encoded(0.5), 5);
}

TEST_F(PanelTest, aStaleImageSaysSo)
{
	seeGrey(128);
	render();
	const int fresh = at(centreX, centreY)[1];
	inputs.displayTime += 300 * millisecond;
	render();
	EXPECT_LT(at(centreX, centreY)[1], fresh - 10);
	EXPECT_GT(at(60, centreY)[0], at(60, centreY)[2] + 40) << "the frame around it is amber";
}

TEST_F(PanelTest, aFrameOfAnotherSizeIsNoImage)
{
	seeGrey(200);
	inputs.cameras[0]->frame.width = cameraWidth / 2;
	render();
	EXPECT_LE(at(centreX, centreY)[1], dim);
	inputs.cameras[0]->frame.width = cameraWidth;
	inputs.cameras[0]->frame.stride = 10 * cameraWidth; // more than its buffer holds
	render();
	EXPECT_LE(at(centreX, centreY)[1], dim);
}

TEST_F(PanelTest, oneEyeMayShowTheOthersCamera)
{
	seeGrey(90);
	inputs.cameras[0] = inputs.cameras[1];
	render();
	expectNear(at(centreX, centreY), {90 / 255.0, 90 / 255.0, 90 / 255.0});
}

} // namespace
} // namespace arift
