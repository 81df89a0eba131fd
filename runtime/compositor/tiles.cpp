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
	void add(const Reach &other)
	{
		least = glm::min(least, other.least);
		most = glm::max(most, other.most);
		front |= other.front;
		behind |= other.behind;
	}
	Cover cover(const HasContent &hasContent) const
	{
		if (!front) return Cover::none;
		if (behind) return Cover::partly;
		const glm::dvec2 margin = (most - least) * bulge + 1e-6;
		const glm::dvec2 low = least - margin, high = most + margin;
		if (low.x > 1 || low.y > 1 || high.x < 0 || high.y < 0) return Cover::none;
		if (hasContent && !hasContent(low, high)) return Cover::none;
		return low.x > 0 && low.y > 0 && high.x < 1 && high.y < 1 ? Cover::fully : Cover::partly;
	}
};

std::vector<Reach> reachOfCorners(const TileGrid &grid, const MatrixByBand &uvMatrix)
{
	std::vector<Reach> reach;
	reach.reserve(size_t(grid.rows() + 1) * size_t(grid.columns() + 1));
	for (int row = 0; row <= grid.rows(); ++row) {
		const glm::dmat3 m = matrixAtRow(grid, uvMatrix, row);
		for (int column = 0; column <= grid.columns(); ++column) {
			const glm::dvec2 t = grid.corner(column, row);
			Reach &here = reach.emplace_back();
			for (const double colour : extremeColours) here.add(m * glm::dvec3(t * colour, 1));
		}
	}
	return reach;
}

/// Collects tiles by what draws them, and cuts them into rectangles.
class Plan
{
public:
	explicit Plan(const TileGrid &grid) : grid_(grid) {}
	void add(Blend blend, Behind behind, int layer, uint32_t band, const PixelRect &tile)
	{
		// The bottom-most of a tile first, then layers upwards, then light that is added to all of them.
		byDraw_.try_emplace({blend, blend == Blend::over ? layer : 0, band, layer, behind}, grid_.area()).first->second.add(tile);
	}
	std::vector<TileDraw> draws()
	{
		std::vector<TileDraw> draws;
		for (auto &[key, blocks] : byDraw_) {
			const auto &[blend, order, band, layer, behind] = key;
			draws.push_back({blend, behind, layer, band, blocks.takeRects()});
		}
		return draws;
	}

private:
	const TileGrid &grid_;
	std::map<std::tuple<Blend, int, uint32_t, int, Behind>, BlockSet> byDraw_;
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
		if (row < rows_) visible_.push_back(circleColumns(area, centre, radius, y, std::min(y + tileHeight, area.y1)));
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

std::vector<Cover> coverage(const TileGrid &grid, const MatrixByBand &uvMatrix, const HasContent &hasContent)
{
	const auto corners = reachOfCorners(grid, uvMatrix);
	const auto at = [&](int column, int row) -> const Reach & {
		return corners[size_t(row) * size_t(grid.columns() + 1) + size_t(column)];
	};
	std::vector<Cover> cover;
	cover.reserve(size_t(grid.rows()) * size_t(grid.columns()));
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) {
			Reach tile = at(column, row);
			tile.add(at(column + 1, row));
			tile.add(at(column, row + 1));
			tile.add(at(column + 1, row + 1));
			cover.push_back(tile.cover(hasContent));
		}
	return cover;
}

std::vector<TileDraw> planDraws(const TileGrid &grid, XrEnvironmentBlendMode blendMode, std::span<const PlannedLayer> layers,
								const std::vector<bool> &seen)
{
	const bool environment = blendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE, additive = blendMode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
	Plan plan(grid);
	std::vector<int> here;
	const auto addTile = [&](int column, int row) {
		const PixelRect rect = grid.tile(column, row);
		if (rect.x0 >= rect.x1) return;
		const size_t index = size_t(row) * size_t(grid.columns()) + size_t(column);
		bool backdrop = environment;
		here.clear();
		for (size_t i = 0; i < layers.size(); ++i) {
			if (layers[i].cover.empty() || layers[i].cover[index] == Cover::none) continue;
			if (layers[i].opaque && layers[i].cover[index] == Cover::fully) {
				here.clear();
				backdrop = additive;
			}
			here.push_back(int(i));
		}
		// Light is added to the finished picture of the layers: with one layer in the same pass, with more after them.
		const bool later = additive && here.size() > 1;
		const uint32_t band = grid.bandOf(row);
		const Behind behind = seen.empty() || seen[index] ? Behind::camera : Behind::unseen;
		plan.add(Blend::replace, backdrop && !later ? behind : Behind::nothing, here.empty() ? -1 : here.front(), band, rect);
		for (size_t i = 1; i < here.size(); ++i) plan.add(Blend::over, Behind::nothing, here[i], band, rect);
		if (later) plan.add(Blend::add, behind, -1, band, rect);
	};
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) addTile(column, row);
	return plan.draws();
}

} // namespace arift
