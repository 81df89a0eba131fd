#include "runtime/compositor/tiles.h"
#include "runtime/compositor/block_set.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace arift
{

namespace
{

static_assert(bandCount == 2);

/// How much further than its corners the inside of a tile may reach: the lens bends its edges.
constexpr double bulge = 0.25;

/// First and last pixel columns of lines y0 to y1 inside the circle.
std::array<int, 2> circleColumns(const PixelRect &area, glm::dvec2 centre, double radius, int y0, int y1)
{
	const double nearest = std::clamp(centre.y, double(y0), double(y1)) - centre.y;
	if (std::abs(nearest) >= radius) return {area.x0, area.x0};
	const double half = std::sqrt(radius * radius - nearest * nearest);
	const double first = (centre.x - half - area.x0) / BlockSet::width, last = (centre.x + half - area.x0) / BlockSet::width;
	return {area.x0 + std::max(0, int(std::floor(first)) * BlockSet::width),
			std::min(area.x1, area.x0 + int(std::ceil(last)) * BlockSet::width)};
}

/// What a layer's coordinates do at one corner, over all colours.
struct Reach {
	glm::dvec2 least{1e30}, most{-1e30};
	bool front = false, behind = false;
	void add(const glm::dvec3 &h)
	{
		(h.z > 1e-6 ? front : behind) = true;
		if (h.z <= 1e-6) return;
		const glm::dvec2 uv(h.x / h.z, h.y / h.z);
		least = glm::min(least, uv);
		most = glm::max(most, uv);
	}
	Cover cover(glm::dvec2 border, const ContentOf &contentOf) const
	{
		if (!front) return Cover::none;
		if (behind) return Cover::partly;
		const glm::dvec2 margin = (most - least) * bulge + 1e-6;
		const glm::dvec2 low = least - margin, high = most + margin;
		if (low.x > 1 || low.y > 1 || high.x < 0 || high.y < 0) return Cover::none;
		const Content content = contentOf(low, high);
		if (content == Content::none) return Cover::none;
		if (!(low.x > border.x && low.y > border.y && high.x < 1 - border.x && high.y < 1 - border.y)) return Cover::partly;
		return content == Content::opaque ? Cover::opaque : Cover::fully;
	}
};

/// A layer's matrix at every row of corners.
class LayerReach
{
public:
	LayerReach(const TileGrid &grid, const MatrixByBand &uvMatrix) : grid_(grid)
	{
		for (int row = 0; row <= grid.rows(); ++row) byRow_.push_back(matrixAtRow(grid, uvMatrix, row));
	}
	/// Over tiles from (column, row) to before (column1, row1).
	Reach of(int column, int row, int column1, int row1) const
	{
		Reach reach;
		for (const int y : {row, row1})
			for (const int x : {column, column1})
				for (const double colour : extremeColours) reach.add(byRow_[size_t(y)] * glm::dvec3(grid_.corner(x, y) * colour, 1));
		return reach;
	}

private:
	const TileGrid &grid_;
	FrameVector<glm::dmat3> byRow_;
};

/// Collects tiles by what draws them, and cuts them into rectangles.
class Plan
{
public:
	explicit Plan(const TileGrid &grid) : grid_(grid) {}
	void add(Blend blend, Behind behind, int layer, Cover cover, uint32_t band, const PixelRect &tile)
	{
		// The bottom-most of a tile first, then layers upwards, then light that is added to all of them.
		const Key key{blend, blend == Blend::over ? layer : 0, band, layer, cover, behind};
		if (last_ == byDraw_.end() || last_->first != key) last_ = byDraw_.try_emplace(key, grid_.area()).first;
		last_->second.add(tile);
	}
	FrameVector<TileDraw> draws()
	{
		FrameVector<TileDraw> draws;
		for (auto &[key, blocks] : byDraw_) {
			const auto &[blend, order, band, layer, cover, behind] = key;
			draws.push_back({blend, behind, layer, cover, band, blocks.takeRects()});
		}
		return draws;
	}

private:
	using Key = std::tuple<Blend, int, uint32_t, int, Cover, Behind>;
	const TileGrid &grid_;
	using ByDraw = std::map<Key, BlockSet, std::less<>, FrameMemoryAllocator<std::pair<const Key, BlockSet>>>;
	ByDraw byDraw_;
	ByDraw::iterator last_ = byDraw_.end(); ///< neighbours are mostly drawn alike
};

} // namespace

glm::dmat3 matrixAtRow(const TileGrid &grid, const MatrixByBand &m, int row)
{
	const uint32_t band = row == grid.rows() ? bandCount - 1 : grid.bandOf(row);
	const double y = std::min(row * TileGrid::tileHeight, grid.bandBegin(bandCount));
	const double begin = grid.bandBegin(band), end = grid.bandBegin(band + 1);
	const double s = (y - begin) / (end - begin);
	return m[band] * (1 - s) + m[band + 1] * s;
}

TileGrid::TileGrid(PixelRect area, glm::dvec2 centre, double radius, const std::function<glm::dvec2(glm::dvec2)> &tangents)
	: area_(area), columns_((area.x1 - area.x0 + tileWidth - 1) / tileWidth), rows_((area.y1 - area.y0 + tileHeight - 1) / tileHeight)
{
	for (int row = 0; row <= rows_; ++row) {
		const int y = std::min(area.y0 + row * tileHeight, area.y1);
		for (int column = 0; column <= columns_; ++column)
			corners_.push_back(tangents({std::min(area.x0 + column * tileWidth, area.x1), y}));
		// Two rows alike: fewer rectangles.
		const int pair = area.y0 + row / 2 * 2 * tileHeight;
		if (row < rows_) visible_.push_back(circleColumns(area, centre, radius, pair, std::min(pair + 2 * tileHeight, area.y1)));
	}
}

int TileGrid::bandBegin(uint32_t band) const
{
	const int end = area_.y1 - area_.y0;
	return band == bandCount ? end : std::min(end, int(band) * (rows_ / int(bandCount)) * tileHeight);
}

PixelRect TileGrid::tile(int column, int row) const
{
	const auto [first, last] = visible_[size_t(row)];
	const int x = area_.x0 + column * tileWidth, y = area_.y0 + row * tileHeight;
	return {std::max(x, first), y, std::min(x + tileWidth, last), std::min(y + tileHeight, area_.y1)};
}

FrameVector<Cover> coverage(const TileGrid &grid, const MatrixByBand &uvMatrix, glm::dvec2 border, const ContentOf &contentOf)
{
	const LayerReach reach(grid, uvMatrix);
	FrameVector<Cover> cover(size_t(grid.rows()) * size_t(grid.columns()));
	const auto coverOf = [&](int column, int row, int column1, int row1) {
		return reach.of(column, row, column1, row1).cover(border, contentOf);
	};
	// Four tiles together first: most lie wholly inside or outside.
	for (int row = 0; row < grid.rows(); row += 2)
		for (int column = 0; column < grid.columns(); column += 2) {
			const int row1 = std::min(row + 2, grid.rows()), column1 = std::min(column + 2, grid.columns());
			const Cover together = coverOf(column, row, column1, row1);
			for (int y = row; y < row1; ++y)
				for (int x = column; x < column1; ++x)
					cover[size_t(y) * size_t(grid.columns()) + size_t(x)] =
						together == Cover::partly ? coverOf(x, y, x + 1, y + 1) : together;
		}
	return cover;
}

FrameVector<TileDraw> planDraws(const TileGrid &grid, XrEnvironmentBlendMode blendMode, std::span<const FrameVector<Cover>> layers,
								const FrameVector<bool> &seen, Base base, const FrameVector<bool> &needsAlpha)
{
	const bool kept = base == Base::kept;
	const bool environment = blendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE && !kept;
	const bool additive = blendMode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE && !kept;
	Plan plan(grid);
	FrameVector<int> here;
	const auto addTile = [&](int column, int row) {
		const PixelRect rect = grid.tile(column, row);
		if (rect.x0 >= rect.x1) return;
		const size_t index = size_t(row) * size_t(grid.columns()) + size_t(column);
		bool backdrop = environment;
		here.clear();
		for (size_t i = 0; i < layers.size(); ++i) {
			if (layers[i].empty() || layers[i][index] == Cover::none) continue;
			if (layers[i][index] == Cover::opaque) {
				here.clear();
				backdrop = additive;
			}
			here.push_back(int(i));
		}
		// What a layer covers wholly is drawn with what is behind it in one pass; at its edges it is blended over it.
		const Cover lowest = here.empty() ? Cover::partly : layers[size_t(here.front())][index];
		const bool together = kept ? lowest == Cover::opaque : lowest != Cover::partly;
		// Light is added to the finished picture of the layers: with one layer in the same pass, with more after them.
		const bool later = additive && here.size() > size_t(together);
		const uint32_t band = grid.bandOf(row);
		const Behind behind = seen.empty() || seen[index] ? Behind::camera : Behind::unseen;
		const auto addLayer = [&](Blend blend, Behind under, int layer) {
			plan.add(blend, under, layer, layers[size_t(layer)][index], band, rect);
		};
		const auto needs = [&](int layer) { return !needsAlpha.empty() && needsAlpha[size_t(layer)]; };
		if (!kept && std::ranges::any_of(here, needs)) {
			plan.add(Blend::clear, Behind::nothing, -1, Cover::none, band, rect);
			for (const int layer : here) addLayer(Blend::over, Behind::nothing, layer);
			if (additive) plan.add(Blend::add, behind, -1, Cover::none, band, rect);
			plan.add(Blend::under, environment && !additive ? behind : Behind::nothing, -1, Cover::none, band, rect);
			return;
		}
		const Behind under = backdrop && !later ? behind : Behind::nothing;
		if (together)
			addLayer(Blend::replace, under, here.front());
		else if (!kept)
			plan.add(Blend::replace, under, -1, Cover::none, band, rect);
		for (size_t i = together ? 1 : 0; i < here.size(); ++i) addLayer(Blend::over, Behind::nothing, here[i]);
		if (later) plan.add(Blend::add, behind, -1, Cover::none, band, rect);
	};
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) addTile(column, row);
	return plan.draws();
}

} // namespace arift
