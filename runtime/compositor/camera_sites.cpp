#include "runtime/compositor/camera_sites.h"
#include "runtime/base/vector_versions.h"
#include <algorithm>
#include <cstring>
#include <vector>

namespace arift
{

namespace
{

/// Two rows of a lattice, each with its last value repeated once more.
template <typename Value> struct RowPair {
	explicit RowPair(uint32_t width) : upper(width + 1), lower(width + 1) {}
	std::vector<Value> upper, lower;
};

ARIFT_VECTOR_VERSIONS void interleave8(const uint8_t *__restrict upper, const uint8_t *__restrict lower, uint32_t *__restrict sites,
									   uint32_t width)
{
	for (uint32_t i = 0; i < width; ++i)
		sites[i] = uint32_t(upper[i]) | uint32_t(upper[i + 1]) << 8 | uint32_t(lower[i]) << 16 | uint32_t(lower[i + 1]) << 24;
}

ARIFT_VECTOR_VERSIONS void everySecond(const uint8_t *__restrict pixels, uint8_t *__restrict row, uint32_t width)
{
	for (uint32_t i = 0; i < width; ++i) row[i] = pixels[2 * i];
}

ARIFT_VECTOR_VERSIONS void meanOfSeconds(const uint8_t *__restrict first, const uint8_t *__restrict second, uint8_t *__restrict row,
										 uint32_t width)
{
	for (uint32_t i = 0; i < width; ++i) row[i] = uint8_t((first[2 * i] + second[2 * i] + 1) / 2);
}

void writeSites(const RowPair<uint8_t> &rows, std::byte *sites, uint32_t width)
{
	interleave8(rows.upper.data(), rows.lower.data(), reinterpret_cast<uint32_t *>(sites), width);
}

void writeSites(const RowPair<uint16_t> &rows, std::byte *sites, uint32_t width)
{
	auto *values = reinterpret_cast<uint16_t *>(sites);
	for (uint32_t i = 0; i < width; ++i) {
		values[4 * i] = rows.upper[i];
		values[4 * i + 1] = rows.upper[i + 1];
		values[4 * i + 2] = rows.lower[i];
		values[4 * i + 3] = rows.lower[i + 1];
	}
}

/// One plane; `read(row number, row)` fills a row of its lattice.
template <typename Value, typename Read> void packPlane(const SiteImage &image, std::byte *sites, const Read &read)
{
	RowPair<Value> rows(image.width);
	const auto next = [&](uint32_t y) {
		read(y, rows.lower.data());
		rows.lower.back() = rows.lower[image.width - 1];
	};
	next(0);
	for (uint32_t y = 0; y < image.height; ++y) {
		rows.upper.swap(rows.lower);
		if (y + 1 < image.height)
			next(y + 1);
		else
			rows.lower = rows.upper;
		writeSites(rows, sites + size_t(y) * image.width * image.bytesPerSite, image.width);
	}
}

template <typename Value> void packGrey(const CameraFrame &frame, const SiteImage &image, std::byte *sites)
{
	const std::byte *pixels = frame.buffer->bytes().data();
	packPlane<Value>(image, sites, [&](uint32_t y, Value *row) {
		std::memcpy(row, pixels + size_t(y) * frame.stride, size_t(image.width) * sizeof(Value));
	});
}

void packBayer(const CameraFrame &frame, const SiteImage &image, std::byte *sites)
{
	const std::array<uint32_t, 2> red = redOf(frame.format);
	const uint32_t redX = red[0], redY = red[1];
	const auto *pixels = reinterpret_cast<const uint8_t *>(frame.buffer->bytes().data());
	const auto at = [&](uint32_t cellRow, uint32_t x, uint32_t y) { return pixels + size_t(2 * cellRow + y) * frame.stride + x; };
	const size_t plane = size_t(image.width) * image.height * image.bytesPerSite;
	packPlane<uint8_t>(image, sites, [&](uint32_t y, uint8_t *row) { everySecond(at(y, redX, redY), row, image.width); });
	packPlane<uint8_t>(image, sites + plane,
					   [&](uint32_t y, uint8_t *row) { meanOfSeconds(at(y, 1 - redX, redY), at(y, redX, 1 - redY), row, image.width); });
	packPlane<uint8_t>(image, sites + 2 * plane,
					   [&](uint32_t y, uint8_t *row) { everySecond(at(y, 1 - redX, 1 - redY), row, image.width); });
}

} // namespace

std::array<uint32_t, 2> redOf(PixelFormat format)
{
	switch (format) {
	case PixelFormat::bayerGrbg8: return {1, 0};
	case PixelFormat::bayerGbrg8: return {0, 1};
	case PixelFormat::bayerBggr8: return {1, 1};
	default: return {0, 0};
	}
}

SiteImage siteImageOf(const CameraFrame &frame)
{
	if (isBayer(frame.format)) return {frame.width / 2, frame.height / 2, 3, 4};
	return {frame.width, frame.height, 1, 4 * bytesPerPixel(frame.format)};
}

void packSites(const CameraFrame &frame, std::span<std::byte> sites)
{
	const SiteImage image = siteImageOf(frame);
	if (isBayer(frame.format))
		packBayer(frame, image, sites.data());
	else if (frame.format == PixelFormat::grey16)
		packGrey<uint16_t>(frame, image, sites.data());
	else
		packGrey<uint8_t>(frame, image, sites.data());
}

} // namespace arift
