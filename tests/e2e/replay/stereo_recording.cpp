#include "tests/e2e/replay/stereo_recording.h"
#include "tests/common/euroc_folder.h"
#include "tests/unit/drivers/recordings.h"
#include <fmt/core.h>

namespace arift::e2e
{
namespace
{

namespace fs = std::filesystem;

constexpr uint32_t width = 376, height = 240;

std::vector<uint8_t> chequers(uint8_t dark, uint8_t light)
{
	constexpr uint32_t cell = 24;
	std::vector<uint8_t> pixels;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 0; x < width; ++x) pixels.push_back((x / cell + y / cell) % 2 ? light : dark);
	return pixels;
}

void writeCamera(const fs::path &folder, double left, uint8_t dark, uint8_t light)
{
	// Camera axes in the body: right is -y, down is -x, forward is -z.
	const std::vector<uint8_t> pixels = chequers(dark, light);
	test::writeEurocCamera(folder,
						   {.inBody = fmt::format("0.0, -1.0, 0.0, 0.0, -1.0, 0.0, 0.0, {}, 0.0, 0.0, -1.0, 0.0", left),
							.width = width,
							.height = height,
							.focalLength = 170},
						   [&](const fs::path &file, int) { test::writeGreyPng(file, width, height, pixels); });
}

} // namespace

void writeStereoRecording(const fs::path &folder, double yawRate)
{
	writeCamera(folder / "mav0/cam0", 0.032, 20, 110);
	writeCamera(folder / "mav0/cam1", -0.032, 110, 220);
	test::writeEurocImu(folder / "mav0/imu0", {yawRate, 0, 0}, {9.81, 0, 0});
}

} // namespace arift::e2e
