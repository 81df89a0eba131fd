#include "runtime/compositor/block_set.h"
#include <algorithm>

namespace arift
{

namespace
{

constexpr int blocksIn(int pixels, int size) { return (pixels + size - 1) / size; }

} // namespace

BlockSet::BlockSet(const PixelRect &area)
	: area_(area),
	  columns_(blocksIn(area.width(), width)),
	  rows_(blocksIn(area.height(), height)),
	  filled_(size_t(columns_) * size_t(rows_)),
	  firstRow_(rows_),
	  firstColumn_(columns_)
{
}

void BlockSet::add(const PixelRect &rect)
{
	const int begin = (rect.y0 - area_.y0) / height, end = blocksIn(rect.y1 - area_.y0, height);
	const int first = (rect.x0 - area_.x0) / width, last = blocksIn(rect.x1 - area_.x0, width);
	for (int row = begin; row < end; ++row)
		for (int column = first; column < last; ++column) {
			uint8_t &block = filled_[size_t(row) * size_t(columns_) + size_t(column)];
			count_ += 1 - block;
			block = 1;
		}
	firstRow_ = std::min(firstRow_, begin);
	endRow_ = std::max(endRow_, end);
	firstColumn_ = std::min(firstColumn_, first);
	endColumn_ = std::max(endColumn_, last);
}

/// Row by row: how many filled blocks end here in each column, and the largest rectangle under that skyline: every column is remembered
/// until a lower one closes its rectangle.
BlockSet::Blocks BlockSet::largest() const
{
	Blocks best;
	FrameVector<int> heights(size_t(columns_) + 1);
	FrameVector<int> rising;
	for (int row = firstRow_; row < endRow_; ++row) {
		for (int column = firstColumn_; column < endColumn_; ++column)
			heights[size_t(column)] = filled_[size_t(row) * size_t(columns_) + size_t(column)] ? heights[size_t(column)] + 1 : 0;
		rising.clear();
		for (int column = firstColumn_; column <= endColumn_; ++column) {
			while (!rising.empty() && heights[size_t(rising.back())] >= heights[size_t(column)]) {
				const int risen = heights[size_t(rising.back())];
				rising.pop_back();
				const int first = rising.empty() ? firstColumn_ : rising.back() + 1;
				const Blocks found{first, row + 1 - risen, column - first, risen};
				if (found.count() > best.count()) best = found;
			}
			rising.push_back(column);
		}
	}
	return best;
}

PixelRect BlockSet::pixels(const Blocks &blocks) const
{
	const int x = area_.x0 + blocks.column * width, y = area_.y0 + blocks.row * height;
	return {x, y, std::min(x + blocks.columns * width, area_.x1), std::min(y + blocks.rows * height, area_.y1)};
}

FrameVector<PixelRect> BlockSet::takeRects()
{
	FrameVector<PixelRect> rects;
	while (count_ > 0) {
		const Blocks found = largest();
		for (int row = found.row; row < found.row + found.rows; ++row)
			std::fill_n(filled_.data() + size_t(row) * size_t(columns_) + found.column, found.columns, uint8_t(0));
		count_ -= found.count();
		rects.push_back(pixels(found));
	}
	return rects;
}

} // namespace arift
