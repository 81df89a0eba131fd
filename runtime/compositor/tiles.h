// Which part of an eye's image needs which pipeline: a software renderer pays for every pixel that a layer is asked about in vain, and
// branching in the shader does not help it. Pure functions.
#pragma once
#include "runtime/base/frame_memory.h"
#include "runtime/base/xr.h"
#include "runtime/compositor/block_set.h"
#include "runtime/compositor/occupancy.h"
#include <array>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace arift
{

/// An eye's image is drawn in bands of lines; within one, matrices change linearly. Two bands keep the chord within 0.02 px of the arc at
/// 200 °/s.
constexpr uint32_t bandCount = 2;
/// A matrix at the top of every band and at the bottom of the last.
using MatrixByBand = std::array<glm::dmat3, bandCount + 1>;

/// One eye's part of an image, cut into tiles.
class TileGrid
{
public:
	/// Of whole blocks of a software renderer (4x4, 16x16 and 64x64 pixels): it shades those that are covered wholly at half the price.
	static constexpr int tileWidth = BlockSet::width, tileHeight = BlockSet::height;
	/// `tangents` of a pixel position; nothing is drawn further than `radius` pixels from `centre`.
	TileGrid(PixelRect area, glm::dvec2 centre, double radius, const std::function<glm::dvec2(glm::dvec2)> &tangents);

	const PixelRect &area() const { return area_; }
	int columns() const { return columns_; }
	int rows() const { return rows_; }
	uint32_t bandOf(int row) const { return row < rows_ / int(bandCount) ? 0 : 1; }
	/// Line at which a band begins; of `bandCount`: where the last ends.
	int bandBegin(uint32_t band) const;
	/// The part of a tile that may be seen; empty (x0 >= x1) outside the circle.
	PixelRect tile(int column, int row) const;
	/// Tangents at a corner, column 0..columns(), row 0..rows().
	glm::dvec2 corner(int column, int row) const { return corners_[size_t(row) * size_t(columns_ + 1) + size_t(column)]; }

private:
	PixelRect area_;
	int columns_, rows_;
	std::vector<glm::dvec2> corners_;
	std::vector<std::array<int, 2>> visible_; ///< first and last column of pixels, by row of tiles, in whole tiles where the area allows
};

/// Red and blue are seen at tangents that differ by at most these factors from green's.
inline constexpr std::array extremeColours{0.985, 1.02};
/// At the upper edge of a row of tiles; of `grid.rows()`: at the lower edge of the last.
glm::dmat3 matrixAtRow(const TileGrid &grid, const MatrixByBand &m, int row);

/// Fully: the whole tile lies inside the layer's image. Opaque: and nothing behind the layer shines through.
enum class Cover : uint8_t { none, partly, fully, opaque };
/// What there may be between two corners of a layer's image, uv.
using ContentOf = std::function<Content(glm::dvec2 least, glm::dvec2 most)>;
/// By tile, row by row: where a layer with these matrices (reprojection.h) lies and has content. Never says `none`, `fully` or `opaque` in
/// error, for any colour; `border`: less than this inside the image's edges, uv, is not inside.
FrameVector<Cover> coverage(const TileGrid &grid, const MatrixByBand &uvMatrix, glm::dvec2 border, const ContentOf &contentOf);

/// Clear: to nothing, not even alpha. Under: behind what is there, as far as its alpha lets it through. In the order in which they are
/// drawn.
enum class Blend : uint32_t { replace, clear, over, add, under };
/// What stands behind a tile's layers: the camera's image, or what is shown where it sees nothing.
enum class Behind : uint8_t { nothing, unseen, camera };
struct TileDraw {
	Blend blend = Blend::replace;
	Behind behind = Behind::nothing;
	int layer = -1;
	Cover cover = Cover::none; ///< the layer's, of every tile
	uint32_t band = 0;
	FrameVector<PixelRect> rects; ///< do not overlap
};
/// What a plan finds in its place. Kept: what is drawn already stays, and layers are drawn over it.
enum class Base : uint8_t { replaced, kept };
/// The draws of one eye in their order. `layers`: their coverage, bottom first; empty: this eye does not see it. `seen`: by tile, where the
/// camera's image is asked for; empty: everywhere.
FrameVector<TileDraw> planDraws(const TileGrid &grid, XrEnvironmentBlendMode blendMode, std::span<const FrameVector<Cover>> layers,
								const FrameVector<bool> &seen = {}, Base base = Base::replaced, const FrameVector<bool> &needsAlpha = {});

} // namespace arift
