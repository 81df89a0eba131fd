#include "runtime/compositor/camera_cover.h"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace arift
{

namespace
{

/// Which sides of the image something lies beyond, as bits. What the lens does not see at all lies beyond a side of its own.
constexpr unsigned left = 1, right = 2, above = 4, below = 8, outside = 16, everySide = 31;
/// Between its corners a tile may reach this many texels further into the image: the lenses bend its edges.
constexpr double bulge = 8;

/// Of a direction that the lens does not see: the one on its rim that lies the same way.
glm::dvec3 towardsRim(const PanelCamera &camera, const glm::dvec3 &direction)
{
	const double cosine = double(camera.form.cosineLimit);
	const double across = std::max(glm::length(glm::dvec2(direction)), 1e-9);
	return {glm::dvec2(direction) / across * std::sqrt(1 - cosine * cosine), cosine};
}

unsigned sidesOf(const PanelCamera &camera, const glm::dvec3 &direction)
{
	auto texel = texelOf(camera, direction);
	const unsigned angle = texel ? 0 : outside;
	if (!texel) texel = texelOf(camera, towardsRim(camera, direction));
	if (!texel) return angle;
	return angle | (texel->x < -0.5 - bulge ? left : 0) | (texel->x > camera.width - 0.5 + bulge ? right : 0) |
		   (texel->y < -0.5 - bulge ? above : 0) | (texel->y > camera.height - 0.5 + bulge ? below : 0);
}

} // namespace

std::optional<glm::dvec2> texelOf(const PanelCamera &camera, const glm::dvec3 &direction)
{
	const ShaderCamera &form = camera.form;
	const double length = glm::length(direction), cosine = direction.z / length;
	if (!(cosine >= double(form.cosineLimit) - 1e-9)) return std::nullopt;
	glm::dvec2 m = glm::dvec2(direction) / length * gainAt(camera, cosine);
	if (const double p1 = form.tangential[0], p2 = form.tangential[1]; p1 != 0 || p2 != 0) {
		const glm::dvec2 t = glm::dvec2(direction) / std::max(direction.z + double(form.xi) * length, 1e-6);
		const double r2 = glm::dot(t, t), both = 2 * t.x * t.y;
		m += glm::dvec2(p1 * both + p2 * (r2 + 2 * t.x * t.x), p1 * (r2 + 2 * t.y * t.y) + p2 * both);
	}
	return glm::dvec2(form.centre) + glm::dmat2(form.affine) * m;
}

FrameVector<bool> seenTiles(const TileGrid &grid, const MatrixByBand &cameraMatrix, const PanelCamera &camera)
{
	const int columns = grid.columns() + 1;
	FrameVector<unsigned> corners;
	corners.reserve(size_t(grid.rows() + 1) * size_t(columns));
	for (int row = 0; row <= grid.rows(); ++row) {
		const glm::dmat3 m = matrixAtRow(grid, cameraMatrix, row);
		for (int column = 0; column < columns; ++column) {
			unsigned sides = everySide;
			for (const double colour : extremeColours) sides &= sidesOf(camera, m * glm::dvec3(grid.corner(column, row) * colour, 1));
			corners.push_back(sides);
		}
	}
	FrameVector<bool> seen;
	seen.reserve(size_t(grid.rows()) * size_t(grid.columns()));
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) {
			const size_t first = size_t(row) * size_t(columns) + size_t(column), next = first + size_t(columns);
			seen.push_back(!(corners[first] & corners[first + 1] & corners[next] & corners[next + 1]));
		}
	return seen;
}

} // namespace arift
