#include "runtime/compositor/occupancy.h"
#include <algorithm>
#include <array>
#include <bit>
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

/// Of texels of four bytes with their alpha last.
bool isOpaque(const std::byte *bytes, size_t count)
{
	uint64_t all = ~uint64_t(0);
	for (; count >= 32; bytes += 32, count -= 32) {
		uint64_t words[4];
		std::memcpy(words, bytes, sizeof words);
		all &= words[0] & words[1] & words[2] & words[3];
	}
	constexpr std::array<std::byte, 8> alphas{std::byte{}, std::byte{}, std::byte{}, std::byte{255},
											  std::byte{}, std::byte{}, std::byte{}, std::byte{255}};
	const auto mask = std::bit_cast<uint64_t>(alphas);
	bool opaque = (all & mask) == mask;
	for (; count > 0; bytes += 4, count -= 4) opaque &= bytes[3] == std::byte{255};
	return opaque;
}

} // namespace

Occupancy::Occupancy(const Texels &texels)
	: texels_(texels),
	  width_(int(texels.width)),
	  height_(int(texels.height)),
	  columns_((width_ + block - 1) / block),
	  blocks_(size_t(columns_) * size_t((height_ + block - 1) / block))
{
}

/// The first texel says which of the two it can be at all.
Content Occupancy::examine(int column, int row) const
{
	const int x = column * block, y = row * block;
	const size_t bytes = size_t(std::min(block, width_ - x)) * texels_.bytesPerTexel;
	const std::byte *line = texels_.first + size_t(y) * texels_.rowPitch + size_t(x) * texels_.bytesPerTexel;
	const Content can = texels_.alphaLast && line[3] == std::byte{255} ? Content::opaque : Content::none;
	for (int left = std::min(block, height_ - y); left > 0; --left, line += texels_.rowPitch)
		if (!(can == Content::opaque ? isOpaque(line, bytes) : isZero(line, bytes))) return Content::some;
	return can;
}

Content Occupancy::contentOf(const TexelRect &rect)
{
	const int x0 = std::max(rect.x0, 0), y0 = std::max(rect.y0, 0), x1 = std::min(rect.x1, width_), y1 = std::min(rect.y1, height_);
	if (x0 >= x1 || y0 >= y1) return Content::none;
	std::optional<Content> all;
	for (int row = y0 / block; row <= (y1 - 1) / block; ++row)
		for (int column = x0 / block; column <= (x1 - 1) / block; ++column) {
			std::optional<Content> &here = known(column, row);
			if (!here) {
				here = examine(column, row);
				++examined_;
			}
			if (here == Content::some || (all && all != here)) return Content::some;
			all = here;
		}
	return *all;
}

void Occupancy::forget()
{
	std::ranges::fill(blocks_, std::nullopt);
	examined_ = 0;
}

} // namespace arift
