#include "runtime/compositor/occupancy.h"
#include <algorithm>
#include <cstring>

namespace arift
{

namespace
{

bool isZero(const std::byte *bytes, size_t count)
{
	uint64_t any = 0;
	for (; count >= 32; bytes += 32, count -= 32) {
		uint64_t words[4];
		std::memcpy(words, bytes, sizeof words);
		any |= words[0] | words[1] | words[2] | words[3];
	}
	for (; count > 0; ++bytes, --count) any |= uint64_t(*bytes);
	return any == 0;
}

} // namespace

Occupancy::Occupancy(const std::byte *first, size_t rowPitch, size_t bytesPerTexel, uint32_t width, uint32_t height)
	: first_(first),
	  rowPitch_(rowPitch),
	  bytesPerTexel_(bytesPerTexel),
	  width_(int(width)),
	  height_(int(height)),
	  columns_((int(width) + block - 1) / block),
	  blocks_(size_t(columns_) * size_t((height + block - 1) / block))
{
}

bool Occupancy::isEmpty(int column, int row) const
{
	const int x = column * block, y1 = std::min((row + 1) * block, height_);
	const size_t count = size_t(std::min(block, width_ - x)) * bytesPerTexel_;
	for (int y = row * block; y < y1; ++y)
		if (!isZero(first_ + size_t(y) * rowPitch_ + size_t(x) * bytesPerTexel_, count)) return false;
	return true;
}

bool Occupancy::mayHaveContent(const TexelRect &rect)
{
	const int x0 = std::max(rect.x0, 0), y0 = std::max(rect.y0, 0), x1 = std::min(rect.x1, width_), y1 = std::min(rect.y1, height_);
	if (x0 >= x1 || y0 >= y1) return false;
	for (int row = y0 / block; row <= (y1 - 1) / block; ++row)
		for (int column = x0 / block; column <= (x1 - 1) / block; ++column) {
			Known &known = blocks_[size_t(row) * size_t(columns_) + size_t(column)];
			if (known == Known::nothing) {
				known = isEmpty(column, row) ? Known::empty : Known::occupied;
				++examined_;
			}
			if (known == Known::occupied) return true;
		}
	return false;
}

void Occupancy::forget()
{
	std::ranges::fill(blocks_, Known::nothing);
	examined_ = 0;
}

} // namespace arift
