#include "tests/bench/frames/ring_recording.h"
#include <array>
#include <cstdint>
#include <fmt/core.h>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>
#include <zlib.h>

namespace arift::bench
{

namespace
{

namespace fs = std::filesystem;

constexpr uint32_t width = 752, height = 480, images = 30;
constexpr int64_t begin = 1'403'715'273'262'142'976, step = 1'000'000'000 / images; // nanoseconds since 1970

void appendBigEndian(std::string &to, uint32_t value)
{
	for (int shift = 24; shift >= 0; shift -= 8) to += char(value >> shift);
}

void appendChunk(std::string &png, const std::string &type, const std::string &data)
{
	appendBigEndian(png, uint32_t(data.size()));
	const std::string body = type + data;
	png += body;
	appendBigEndian(png, uint32_t(crc32(0, reinterpret_cast<const Bytef *>(body.data()), uInt(body.size()))));
}

/// 8-bit grey, stored: what it costs to read is what it costs to copy.
void writeStoredPng(const fs::path &file, const std::string &pixels)
{
	std::string rows;
	for (uint32_t y = 0; y < height; ++y) rows += '\0' + pixels.substr(size_t(y) * width, width);
	std::string packed(compressBound(uLong(rows.size())), '\0');
	auto size = uLongf(packed.size());
	if (compress2(reinterpret_cast<Bytef *>(packed.data()), &size, reinterpret_cast<const Bytef *>(rows.data()), uLong(rows.size()), 0) !=
		Z_OK)
		throw std::runtime_error("zlib cannot store an image");
	packed.resize(size);
	std::string header;
	appendBigEndian(header, width);
	appendBigEndian(header, height);
	header += std::string({8, 0, 0, 0, 0});
	std::string png = "\x89PNG\r\n\x1a\n";
	appendChunk(png, "IHDR", header);
	appendChunk(png, "IDAT", packed);
	appendChunk(png, "IEND", "");
	fs::create_directories(file.parent_path());
	std::ofstream(file, std::ios::binary) << png;
}

/// Chequers that wander.
std::string picture(uint32_t number)
{
	std::string pixels;
	for (uint32_t y = 0; y < height; ++y)
		for (uint32_t x = 0; x < width; ++x) pixels += char(((x + 4 * number) / 48 + y / 48) % 2 ? 150 : 40);
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

void writeCamera(const fs::path &folder, double right)
{
	writeSensor(folder, "camera", fmt::format("1.0, 0.0, 0.0, {}, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0", right),
				fmt::format("rate_hz: {}\nresolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [400.0, 400.0, 375.5, 239.5]\n"
							"distortion_model: radial-tangential\ndistortion_coefficients: [-0.01, 0.001, 0.0, 0.0]\n",
							images, width, height));
	std::ofstream csv(folder / "data.csv");
	csv << "#timestamp [ns],filename\n";
	for (uint32_t i = 0; i < images; ++i) {
		const int64_t time = begin + i * step;
		csv << fmt::format("{0},{0}.png\n", time);
		writeStoredPng(folder / "data" / fmt::format("{}.png", time), picture(i));
	}
}

} // namespace

void writeRing(const fs::path &folder)
{
	writeCamera(folder / "mav0/cam0", -0.032);
	writeCamera(folder / "mav0/cam1", 0.032);
	const fs::path imu = folder / "mav0/imu0";
	writeSensor(imu, "imu", "1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0", "rate_hz: 200\n");
	std::ofstream csv(imu / "data.csv");
	csv << "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
	for (int i = 0; i < 400; ++i) csv << fmt::format("{},0,0,0,0,9.81,0\n", begin - 500'000'000 + i * 5'000'000);
}

} // namespace arift::bench
