// Which pixels one draw covers, cut into few large rectangles: along the diagonal where the two triangles of a rectangle meet, a software
// renderer shades every block of pixels twice, and slower. Pure.
#pragma once
#include "runtime/base/frame_memory.h"
#include <cstdint>

namespace arift
{

/// Pixels, x1 and y1 excluded.
struct PixelRect {
	int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
	int width() const { return x1 - x0; }
	int height() const { return y1 - y0; }
};

/// A set of blocks inside an area, whose corner is block (0, 0). At the area's far edges blocks are cut off.
class BlockSet
{
public:
	/// Multiples of what a software renderer shades at once (4x4 pixels).
	static constexpr int width = 16, height = 16;
	explicit BlockSet(const PixelRect &area);

	/// `rect` begins and ends at blocks' edges or the area's.
	void add(const PixelRect &rect);
	/// All of it in rectangles that do not overlap, the largest first; the set is empty afterwards.
	FrameVector<PixelRect> takeRects();

private:
	struct Blocks {
		int column = 0, row = 0, columns = 0, rows = 0;
		int count() const { return columns * rows; }
	};
	Blocks largest() const;
	PixelRect pixels(const Blocks &blocks) const;

	PixelRect area_;
	int columns_, rows_;
	FrameVector<uint8_t> filled_;                             ///< row by row
	int firstRow_, endRow_ = 0, firstColumn_, endColumn_ = 0; ///< all filled blocks lie between
	int count_ = 0;
};

} // namespace arift
