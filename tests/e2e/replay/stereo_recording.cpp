#include "tests/e2e/replay/stereo_recording.h"
#include "tests/unit/drivers/recordings.h"
#include <fmt/core.h>
#include <fstream>

namespace arift::e2e
{
namespace
{

namespace fs = std::filesystem;

constexpr uint32_t width = 376, height = 240;
constexpr int64_t begin = 1'403'715'273'262'142'976; // nanoseconds since 1970

std::vector<uint8_t> chequers(uint8_t dark, uint8_t light)
{
	constexpr uint32_t cell = 24;
	std::vector<uint8_t> pixels;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 0; x < width; ++x) pixels.push_back((x / cell + y / cell) % 2 ? light : dark);
	return pixels;
}

/// `rows`: the sensor in the body frame, three rows of four.
void writeSensor(const fs::path &folder, const std::string &kind, const std::string &rows, const std::string &more)
{
	fs::create_directories(folder);
	std::ofstream(folder / "sensor.yaml") << "%YAML:1.0\nsensor_type: " << kind << "\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" << rows
										  << ", 0.0, 0.0, 0.0, 1.0]\n"
										  << more;
}

void writeCamera(const fs::path &folder, double left, uint8_t dark, uint8_t light)
{
	// Camera axes in the body: right is -y, down is -x, forward is -z.
	writeSensor(folder, "camera", fmt::format("0.0, -1.0, 0.0, 0.0, -1.0, 0.0, 0.0, {}, 0.0, 0.0, -1.0, 0.0", left),
				fmt::format("rate_hz: 20\nresolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [170.0, 170.0, 187.5, 119.5]\n"
							"distortion_model: radial-tangential\ndistortion_coefficients: [-0.01, 0.001, 0.0, 0.0]\n",
							width, height));
	const std::vector<uint8_t> pixels = chequers(dark, light);
	std::ofstream csv(folder / "data.csv");
	csv << "#timestamp [ns],filename\n";
	for (int i = 0; i < 20; ++i) {
		const int64_t time = begin + i * 50'000'000;
		csv << fmt::format("{0},{0}.png\n", time);
		test::writeGreyPng(folder / "data" / fmt::format("{}.png", time), width, height, pixels);
	}
}

} // namespace

void writeStereoRecording(const fs::path &folder, double yawRate)
{
	writeCamera(folder / "mav0/cam0", 0.032, 20, 110);
	writeCamera(folder / "mav0/cam1", -0.032, 110, 220);
	const fs::path imu = folder / "mav0/imu0";
	writeSensor(imu, "imu", "1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0", "rate_hz: 200\n");
	std::ofstream csv(imu / "data.csv");
	csv << "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
	for (int i = 0; i < 400; ++i) csv << fmt::format("{},{},0,0,9.81,0,0\n", begin - 500'000'000 + i * 5'000'000, yawRate);
}

} // namespace arift::e2e
