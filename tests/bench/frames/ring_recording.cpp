#include "tests/bench/frames/ring_recording.h"
#include "tests/common/euroc_folder.h"
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

constexpr uint32_t width = 752, height = 480;
constexpr int images = 30;

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

/// As bright as its number says.
std::string picture(uint32_t number) { return std::string(size_t(width) * height, char(60 + 5 * number)); }

void writeCamera(const fs::path &folder, double right)
{
	test::writeEurocCamera(folder,
						   {.inBody = fmt::format("1.0, 0.0, 0.0, {}, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0", right),
							.width = width,
							.height = height,
							.focalLength = 400,
							.rate = images,
							.images = images},
						   [](const fs::path &file, int number) { writeStoredPng(file, picture(uint32_t(number))); });
}

} // namespace

void writeRing(const fs::path &folder)
{
	writeCamera(folder / "mav0/cam0", -0.032);
	writeCamera(folder / "mav0/cam1", 0.032);
	test::writeEurocImu(folder / "mav0/imu0", {0, 0, 0}, {0, 9.81, 0});
}

} // namespace arift::bench
