#include "runtime/compositor/surface.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace arift
{

namespace
{

constexpr double turn = 2 * std::numbers::pi;

/// A blend factor in the shader's terms: constant + byAlpha * the layer's alpha. Of the alpha below, which no shader sees, there is none.
struct Factor {
	float constant = 0, byAlpha = 0;
};
Factor factorOf(XrBlendFactorFB factor)
{
	switch (factor) {
	case XR_BLEND_FACTOR_ONE_FB: return {1, 0};
	case XR_BLEND_FACTOR_SRC_ALPHA_FB: return {0, 1};
	case XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB: return {1, -1};
	default: return {0, 0};
	}
}

BlendFactors factorsOf(const PanelLayer &layer)
{
	if (layer.factors) return *layer.factors;
	const bool straight = layer.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	return {straight && !isOpaque(layer) ? XR_BLEND_FACTOR_SRC_ALPHA_FB : XR_BLEND_FACTOR_ONE_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB,
			XR_BLEND_FACTOR_ONE_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB};
}

bool isTransformed(const PanelLayer &layer)
{
	const auto &[r, g, b, a] = layer.colorScale;
	const auto &bias = layer.colorBias;
	return !(r == 1 && g == 1 && b == 1 && a == 1 && bias.r == 0 && bias.g == 0 && bias.b == 0 && bias.a == 0);
}

glm::vec4 vectorOf(const XrColor4f &c) { return {c.r, c.g, c.b, c.a}; }

/// A layer's own frame as seen from an eye; `radius` 0: infinitely far away, where only directions count.
void addRays(RaysByBand &rays, size_t band, const EyeAtLine &eye, bool headLocked, const XrPosef &pose, double radius)
{
	const Placement place = layerInOrigin(eye, headLocked, pose);
	const glm::dmat3 toLayer = glm::mat3_cast(glm::conjugate(place.orientation));
	rays.matrix[band] = toLayer * directionMatrix(eye);
	rays.origin[band] = radius > 0 ? toLayer * (eye.view.position - place.position) / radius : glm::dvec3(0);
}

/// surface.frag's met(): angle to the right, and angle up or height in radii.
std::optional<glm::dvec2> met(Surface surface, const glm::dvec3 &ray, const glm::dvec3 &origin)
{
	const glm::dvec3 flattened(1, surface == Surface::cylinder ? 0 : 1, 1), r = ray * flattened, o = origin * flattened;
	const double a = std::max(glm::dot(r, r), 1e-12), b = glm::dot(o, r), square = b * b - a * (glm::dot(o, o) - 1);
	const double along = (std::sqrt(std::max(square, 0.0)) - b) / a;
	if (square < 0 || along <= 0) return std::nullopt;
	const glm::dvec3 place = origin + ray * along;
	const double up = surface == Surface::cylinder ? place.y : std::atan2(place.y, std::hypot(place.x, place.z));
	return glm::dvec2(std::atan2(place.x, -place.z), up);
}

/// What a curved layer's coordinates do at the corners of a tile.
class CurvedReach
{
public:
	CurvedReach(const TileGrid &grid, const CurvedView &view, const RaysByBand &rays) : grid_(grid), view_(view)
	{
		for (int row = 0; row <= grid.rows(); ++row) {
			matrices_.push_back(matrixAtRow(grid, rays.matrix, row));
			origins_.push_back(originAtRow(grid, rays, row));
		}
	}

	Cover cover(int column, int row, const ContentOf &contentOf) const
	{
		glm::dvec2 least(1e30), most(-1e30);
		for (const int y : {row, row + 1})
			for (const int x : {column, column + 1})
				for (const double colour : extremeColours) {
					const auto place =
						met(view_.surface, matrices_[size_t(y)] * glm::dvec3(grid_.corner(x, y) * colour, 1), origins_[size_t(y)]);
					if (!place) return Cover::partly;
					least = glm::min(least, *place);
					most = glm::max(most, *place);
				}
		// Over the back, where angles begin anew, or over a pole.
		if (most.x - least.x > turn / 4) return Cover::partly;
		const glm::dvec2 margin = (most - least) * bulge + 1e-6;
		const glm::dvec2 one = uvOf(least - margin), other = uvOf(most + margin);
		const glm::dvec2 low = glm::min(one, other), high = glm::max(one, other);
		if (low.x > 1 || low.y > 1 || high.x < 0 || high.y < 0) return Cover::none;
		return contentOf(low, high) == Content::none ? Cover::none : Cover::partly;
	}

private:
	/// How much further than its corners the inside of a tile may reach.
	static constexpr double bulge = 0.5;

	static glm::dvec3 originAtRow(const TileGrid &grid, const RaysByBand &rays, int row)
	{
		MatrixByBand asColumns;
		for (size_t band = 0; band <= bandCount; ++band) asColumns[band][0] = rays.origin[band];
		return matrixAtRow(grid, asColumns, row)[0];
	}
	glm::dvec2 uvOf(const glm::dvec2 &place) const
	{
		return {view_.uvAhead.x + view_.uvPerUnit.x * place.x, view_.uvAhead.y + view_.uvPerUnit.y * place.y};
	}

	const TileGrid &grid_;
	const CurvedView &view_;
	FrameVector<glm::dmat3> matrices_;
	FrameVector<glm::dvec3> origins_;
};

/// Of a flat layer: panel.frag's own.
FrameVector<Cover> flatCoverage(const TileGrid &grid, const RaysByBand &rays, const ContentOf &contentOf)
{
	FrameVector<Cover> cover = coverage(grid, rays.matrix, glm::dvec2(0), contentOf);
	std::ranges::replace_if(
		cover, [](Cover tile) { return tile != Cover::none; }, Cover::partly);
	return cover;
}

} // namespace

Surface surfaceOf(const PanelLayer &layer, size_t eye)
{
	if (layer.curved[eye]) return layer.curved[eye]->surface;
	if (layer.cube[eye]) return Surface::cube;
	return layer.projection[eye] || layer.quad[eye] ? Surface::flat : Surface::none;
}

bool isPlain(const PanelLayer &layer)
{
	const bool flat = !layer.curved[0] && !layer.curved[1] && !layer.cube[0] && !layer.cube[1];
	return flat && (layer.key || (!layer.factors && !isTransformed(layer)));
}

bool isShownWhereEmpty(const PanelLayer &layer) { return layer.factors || isOpaque(layer) || layer.colorBias.a != 0; }

/// Over a picture of colour C and alpha A in front of the world W, C + W (1 - A) becomes k of itself and something added where both C and
/// 1 - A become k of themselves: where what is kept of the alpha is k, too, and what is added to it 1 - k.
bool needsAlphaBelow(const PanelLayer &layer)
{
	if (!layer.factors) return false;
	const auto &[sourceColor, keptColor, sourceAlpha, keptAlpha] = *layer.factors;
	(void)sourceColor;
	const bool usual = keptColor == XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB && sourceAlpha == XR_BLEND_FACTOR_ONE_FB;
	const bool added = keptColor == XR_BLEND_FACTOR_ONE_FB && sourceAlpha == XR_BLEND_FACTOR_ZERO_FB;
	return keptColor != keptAlpha || !(usual || added);
}

std::optional<RaysByBand> surfaceRays(const PanelLayer &layer, size_t eye, const std::array<std::array<EyeAtLine, 2>, bandCount + 1> &eyes)
{
	RaysByBand rays;
	switch (surfaceOf(layer, eye)) {
	case Surface::none: return std::nullopt;
	case Surface::flat: {
		const auto matrices = layerMatrices(layer, eye, eyes);
		if (!matrices) return std::nullopt;
		rays.matrix = *matrices;
		return rays;
	}
	case Surface::cube:
		for (size_t band = 0; band <= bandCount; ++band)
			addRays(rays, band, eyes[band][eye], layer.headLocked, {layer.cube[eye]->orientationInFrame, {0, 0, 0}}, 0);
		return rays;
	case Surface::cylinder:
	case Surface::sphere: break;
	}
	const CurvedView &view = *layer.curved[eye];
	for (size_t band = 0; band <= bandCount; ++band)
		addRays(rays, band, eyes[band][eye], layer.headLocked, view.centreInFrame, double(view.radius));
	return rays;
}

FrameVector<Cover> surfaceCoverage(const TileGrid &grid, const PanelLayer &layer, size_t eye, const RaysByBand &rays,
								   const ContentOf &contentOf)
{
	const Surface surface = surfaceOf(layer, eye);
	if (surface == Surface::flat) return flatCoverage(grid, rays, contentOf);
	FrameVector<Cover> cover(size_t(grid.rows()) * size_t(grid.columns()), Cover::partly);
	if (surface == Surface::cube) return cover;
	const CurvedReach reach(grid, *layer.curved[eye], rays);
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column)
			cover[size_t(row) * size_t(grid.columns()) + size_t(column)] = reach.cover(column, row, contentOf);
	return cover;
}

shaders::SurfaceBlock surfaceBlock(const PanelLayer &layer, size_t eye, uint32_t band, const RaysByBand &rays, const gpu::ImageSpec &spec)
{
	const Surface surface = surfaceOf(layer, eye);
	const shaders::LayerBlock flat = layerBlock(layer, eye, band, rays.matrix, spec.width, spec.height);
	shaders::SurfaceBlock block{.ray = surface == Surface::flat ? flat.texel : byLine(rays.matrix, band), .bounds = flat.bounds};
	for (int column = 0; column < 3; ++column) {
		block.ray.first[column].w = float(rays.origin[band][column]);
		block.ray.change[column].w = float(rays.origin[band + 1][column] - rays.origin[band][column]);
	}
	if (layer.curved[eye]) {
		const CurvedView &view = *layer.curved[eye];
		const auto &[corner, extent] = view.texture.rect;
		const glm::vec2 size(extent.width, extent.height);
		block.placing = {glm::vec2(view.uvAhead.x, view.uvAhead.y) * size + glm::vec2(corner.x, corner.y) - 0.5f,
						 glm::vec2(view.uvPerUnit.x, view.uvPerUnit.y) * size};
	}
	const BlendFactors factors = factorsOf(layer);
	const Factor sourceColor = factorOf(factors.sourceColor), keptColor = factorOf(factors.keptColor);
	const Factor sourceAlpha = factorOf(factors.sourceAlpha), keptAlpha = factorOf(factors.keptAlpha);
	const bool encoded = surface != Surface::cube && gpu::storedFormat(VkFormat(spec.format)) != VkFormat(spec.format);
	const bool straight = layer.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
	block.colorScale = vectorOf(layer.colorScale);
	block.colorBias = vectorOf(layer.colorBias);
	block.source = {sourceColor.constant, sourceColor.byAlpha, sourceAlpha.constant, sourceAlpha.byAlpha};
	block.kept = {keptColor.constant, keptColor.byAlpha, keptAlpha.constant, keptAlpha.byAlpha};
	block.texels = {encoded, isOpaque(layer) && !layer.factors, isTransformed(layer), straight};
	block.size = {flat.mode.x, flat.mode.y, 0, 0};
	return block;
}

} // namespace arift
