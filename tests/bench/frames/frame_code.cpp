#include "tests/bench/frames/frame_code.h"

namespace arift::bench
{

std::optional<uint32_t> decodeFrame(std::span<const double> cells)
{
	if (cells.size() != codeCells || cells[0] - cells[1] < 100) return std::nullopt;
	const double threshold = (cells[0] + cells[1]) / 2;
	uint32_t number = 0;
	for (uint32_t bit = 0; bit < codeBits; ++bit) number |= uint32_t(cells[2 + bit] > threshold) << bit;
	return (cells[2 + codeBits] > threshold) == codeCellIsWhite(2 + codeBits, number) ? std::optional(number) : std::nullopt;
}

} // namespace arift::bench
