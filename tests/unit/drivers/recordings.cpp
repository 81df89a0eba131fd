#include "tests/unit/drivers/recordings.h"
#include <cmath>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <png.h>

namespace arift::test
{

void writeGreyPng(const std::filesystem::path &file, uint32_t width, uint32_t height, std::span<const uint8_t> pixels)
{
	std::filesystem::create_directories(file.parent_path());
	png_image image{};
	image.version = PNG_IMAGE_VERSION;
	image.width = width;
	image.height = height;
	image.format = PNG_FORMAT_GRAY;
	png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr);
}

void writeGreyPng(const std::filesystem::path &file, uint32_t width, uint32_t height, uint8_t value)
{
	writeGreyPng(file, width, height, std::vector<uint8_t>(size_t(width) * height, value));
}

void writeEuroc(const std::filesystem::path &folder)
{
	constexpr int64_t begin = 1'403'715'273'262'142'976;
	for (int camera = 0; camera < 2; camera++) {
		const auto root = folder / "mav0" / fmt::format("cam{}", camera);
		std::filesystem::create_directories(root);
		std::ofstream csv(root / "data.csv");
		csv << "#timestamp [ns],filename\n";
		for (int i = 0; i < 5; i++) {
			const int64_t time = begin + i * 50'000'000;
			csv << fmt::format("{0},{0}.png\n", time);
			writeGreyPng(root / "data" / fmt::format("{}.png", time), 8, 6, uint8_t(10 * (i + 1) + camera));
		}
	}
	std::filesystem::create_directories(folder / "mav0" / "imu0");
	std::ofstream csv(folder / "mav0" / "imu0" / "data.csv");
	csv << "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
	for (int i = 0; i < 400; i++) csv << fmt::format("{},{},0,0,0,9.8,0.5\n", begin - 500'000'000 + i * 5'000'000, i * 0.001);
}

std::string brdFile(const std::vector<Record> &records)
{
	std::string bytes;
	const auto append = [&](const auto &value) { bytes.append(reinterpret_cast<const char *>(&value), sizeof value); };
	bytes += "BRD1";
	for (const uint32_t number : {64u, 72u, uint32_t(records.size())}) append(number);
	append(200.0);
	append(uint64_t{0});
	char name[32] = "made by a test";
	append(name);
	for (const Record &r : records) {
		append(r.seconds);
		append(r.angularVelocity);
		append(r.acceleration);
		append(std::array<float, 3>{});
		append(r.orientation);
		append(0.0f);
		append(r.position);
	}
	return bytes;
}

std::filesystem::path replayConfiguration(const TemporaryFolder &folder, const std::filesystem::path &recording, const std::string &more)
{
	return folder.write("config.toml", fmt::format("[replay]\nrecording = \"{}\"\n{}", recording.string(), more));
}

} // namespace arift::test
