#include "tests/common/euroc_folder.h"
#include <fmt/core.h>
#include <fstream>

namespace arift::test
{
namespace
{

namespace fs = std::filesystem;

void writeSensor(const fs::path &folder, const std::string &kind, const std::string &rows, const std::string &more)
{
	fs::create_directories(folder);
	std::ofstream(folder / "sensor.yaml") << "%YAML:1.0\nsensor_type: " << kind << "\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" << rows
										  << ", 0.0, 0.0, 0.0, 1.0]\n"
										  << more;
}

} // namespace

void writeEurocCamera(const fs::path &folder, const EurocCamera &camera, const std::function<void(const fs::path &, int)> &write)
{
	writeSensor(folder, "camera", camera.inBody,
				fmt::format("rate_hz: {}\nresolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [{:.1f}, {:.1f}, {:.1f}, {:.1f}]\n"
							"distortion_model: radial-tangential\ndistortion_coefficients: [-0.01, 0.001, 0.0, 0.0]\n",
							camera.rate, camera.width, camera.height, camera.focalLength, camera.focalLength, (camera.width - 1) / 2.0,
							(camera.height - 1) / 2.0));
	std::ofstream csv(folder / "data.csv");
	csv << "#timestamp [ns],filename\n";
	for (int i = 0; i < camera.images; ++i) {
		const int64_t time = eurocBegin + i * int64_t(1'000'000'000 / camera.rate);
		csv << fmt::format("{0},{0}.png\n", time);
		write(folder / "data" / fmt::format("{}.png", time), i);
	}
}

void writeEurocImu(const fs::path &folder, const std::array<double, 3> &angularVelocity, const std::array<double, 3> &acceleration)
{
	writeSensor(folder, "imu", "1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0", "rate_hz: 200\n");
	std::ofstream csv(folder / "data.csv");
	csv << "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
	for (int i = 0; i < 400; ++i)
		csv << fmt::format("{},{},{},{},{},{},{}\n", eurocBegin - 500'000'000 + i * 5'000'000, angularVelocity[0], angularVelocity[1],
						   angularVelocity[2], acceleration[0], acceleration[1], acceleration[2]);
}

} // namespace arift::test
