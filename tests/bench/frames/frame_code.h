// A number that is drawn in an image and read back from a picture of the panel: a strip of black and white cells, so that a frame that was
// really shown is known from one that was only submitted.
#pragma once
#include <cstdint>
#include <optional>
#include <span>

namespace arift::bench
{

/// The strip: a white and a black cell, the number's bits (lowest first), their parity. Cells are squares of texels in one row.
constexpr uint32_t codeBits = 10, codeCells = codeBits + 3, codeCell = 24;
constexpr uint32_t codeWidth = codeCells * codeCell, codeHeight = codeCell;

/// Whether a cell is white.
constexpr bool codeCellIsWhite(uint32_t cell, uint32_t number)
{
	if (cell < 2) return cell == 0;
	if (cell < 2 + codeBits) return number >> (cell - 2) & 1;
	return __builtin_popcount(number & ((1u << codeBits) - 1)) & 1;
}

/// The number in a row of cells' brightness, 0..255; nothing when it is no code.
std::optional<uint32_t> decodeFrame(std::span<const double> cells);

} // namespace arift::bench
