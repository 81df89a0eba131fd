// A camera's image as the shader samples it, against its definition.
#include "runtime/compositor/camera_sites.h"
#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr uint32_t width = 26, height = 14;

uint32_t valueAt(uint32_t x, uint32_t y) { return (x * 37 + y * 101) % 251; }

CameraFrame frameOf(PixelFormat format, uint32_t padding)
{
	const uint32_t pixel = bytesPerPixel(format);
	CameraFrame frame{.format = format, .width = width, .height = height, .stride = width * pixel + padding};
	frame.buffer = makeHostFrameBuffer(size_t(frame.stride) * height);
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 0; x < width; ++x) {
			const uint32_t value = pixel == 2 ? valueAt(x, y) * 257 : valueAt(x, y);
			std::memcpy(frame.buffer->bytes().data() + size_t(y) * frame.stride + size_t(x) * pixel, &value, pixel);
		}
	return frame;
}

/// Value of a plane's lattice.
uint32_t latticeAt(const CameraFrame &frame, uint32_t plane, uint32_t x, uint32_t y)
{
	if (!isBayer(frame.format)) return valueAt(x, y) * (frame.format == PixelFormat::grey16 ? 257 : 1);
	const auto [redX, redY] = redOf(frame.format);
	if (plane == 0) return valueAt(2 * x + redX, 2 * y + redY);
	if (plane == 2) return valueAt(2 * x + 1 - redX, 2 * y + 1 - redY);
	return (valueAt(2 * x + 1 - redX, 2 * y + redY) + valueAt(2 * x + redX, 2 * y + 1 - redY) + 1) / 2;
}

class CameraSites : public testing::TestWithParam<PixelFormat>
{
};

TEST_P(CameraSites, holdTheirFourNeighbours)
{
	for (const uint32_t padding : {0u, 6u}) {
		const CameraFrame frame = frameOf(GetParam(), padding);
		const SiteImage image = siteImageOf(frame);
		std::vector<std::byte> sites(image.bytes());
		packSites(frame, sites);
		const uint32_t bytes = image.bytesPerSite / 4;
		for (uint32_t plane = 0; plane < image.planes; ++plane)
			for (uint32_t y = 0; y < image.height; ++y)
				for (uint32_t x = 0; x < image.width; ++x)
					for (uint32_t corner = 0; corner < 4; ++corner) {
						uint32_t found = 0;
						const size_t site = (size_t(plane) * image.height + y) * image.width + x;
						std::memcpy(&found, sites.data() + site * image.bytesPerSite + corner * bytes, bytes);
						const uint32_t right = std::min(x + corner % 2, image.width - 1),
									   below = std::min(y + corner / 2, image.height - 1);
						ASSERT_EQ(found, latticeAt(frame, plane, right, below)) << plane << ' ' << x << ' ' << y << ' ' << corner;
					}
	}
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, CameraSites,
						 testing::Values(PixelFormat::grey8, PixelFormat::grey16, PixelFormat::bayerRggb8, PixelFormat::bayerGrbg8,
										 PixelFormat::bayerGbrg8, PixelFormat::bayerBggr8),
						 [](const auto &test) { return "format" + std::to_string(int(test.param)); });

TEST(CameraSites, areHalfAsManyForEachColourOfABayerImage)
{
	EXPECT_EQ(siteImageOf(frameOf(PixelFormat::bayerRggb8, 0)), (SiteImage{width / 2, height / 2, 3, 4}));
	EXPECT_EQ(siteImageOf(frameOf(PixelFormat::grey8, 0)), (SiteImage{width, height, 1, 4}));
	EXPECT_EQ(siteImageOf(frameOf(PixelFormat::grey16, 0)), (SiteImage{width, height, 1, 8}));
}

} // namespace
} // namespace arift
