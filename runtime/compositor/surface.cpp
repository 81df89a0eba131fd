#include "runtime/compositor/surface.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace arift
{

namespace
{

constexpr double turn = 2 * std::numbers::pi;

/// A blend factor in the shader's terms: constant + byAlpha * the layer's alpha. The alpha below, which no shader sees, comes later.
struct Factor {
	float constant = 0, byAlpha = 0;
};
Factor factorOf(XrBlendFactorFB factor)
{
	switch (factor) {
	case XR_BLEND_FACTOR_ONE_FB:
	case XR_BLEND_FACTOR_DST_ALPHA_FB:
	case XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB: return {1, 0};
	case XR_BLEND_FACTOR_SRC_ALPHA_FB: return {0, 1};
	case XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB: return {1, -1};
	default: return {0, 0};
	}
}

ByAlphaBelow byAlphaBelow(XrBlendFactorFB factor)
{
	if (factor == XR_BLEND_FACTOR_DST_ALPHA_FB) return ByAlphaBelow::alpha;
	return factor == XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB ? ByAlphaBelow::rest : ByAlphaBelow::no;
}

BlendFactors factorsOf(const PanelLayer &layer)
{
	if (layer.factors) return *layer.factors;
	return {layer.isStraight() ? XR_BLEND_FACTOR_SRC_ALPHA_FB : XR_BLEND_FACTOR_ONE_FB, XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB,
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

/// Rays and where they begin at the corners of tiles.
class CornerRays
{
public:
	CornerRays(const TileGrid &grid, const RaysByBand &rays) : grid_(grid)
	{
		for (int row = 0; row <= grid.rows(); ++row) {
			matrices_.push_back(matrixAtRow(grid, rays.matrix, row));
			origins_.push_back(originAtRow(grid, rays, row));
		}
	}

	/// Calls use(ray, origin) for every corner of a tile in its extreme colours, until it says false; says whether it never did.
	template <typename Use> bool all(int column, int row, Use use) const
	{
		for (const int y : {row, row + 1})
			for (const int x : {column, column + 1})
				for (const double colour : extremeColours)
					if (!use(matrices_[size_t(y)] * glm::dvec3(grid_.corner(x, y) * colour, 1), origins_[size_t(y)])) return false;
		return true;
	}

private:
	static glm::dvec3 originAtRow(const TileGrid &grid, const RaysByBand &rays, int row)
	{
		MatrixByBand asColumns;
		for (size_t band = 0; band <= bandCount; ++band) asColumns[band][0] = rays.origin[band];
		return matrixAtRow(grid, asColumns, row)[0];
	}

	const TileGrid &grid_;
	FrameVector<glm::dmat3> matrices_;
	FrameVector<glm::dvec3> origins_;
};

/// Of a tile whose corners lie between these places of a layer's image, uv, in any order.
Cover coverBetween(const glm::dvec2 &one, const glm::dvec2 &other, const ContentOf &contentOf)
{
	// How much further than its corners the inside of a tile may reach.
	const glm::dvec2 margin = glm::abs(other - one) * 0.5 + 1e-6;
	const glm::dvec2 low = glm::min(one, other) - margin, high = glm::max(one, other) + margin;
	if (low.x > 1 || low.y > 1 || high.x < 0 || high.y < 0) return Cover::none;
	return contentOf(low, high) == Content::none ? Cover::none : Cover::partly;
}

/// What a curved layer's coordinates do at the corners of a tile.
class CurvedReach
{
public:
	CurvedReach(const TileGrid &grid, const CurvedView &view, const RaysByBand &rays) : rays_(grid, rays), view_(view) {}

	Cover cover(int column, int row, const ContentOf &contentOf) const
	{
		glm::dvec2 least(1e30), most(-1e30);
		const bool isMet = rays_.all(column, row, [&](const glm::dvec3 &ray, const glm::dvec3 &origin) {
			const auto place = met(view_.surface, ray, origin);
			least = glm::min(least, place.value_or(least));
			most = glm::max(most, place.value_or(most));
			return place.has_value();
		});
		if (!isMet) return Cover::partly;
		// Over the back, where angles begin anew, or over a pole.
		if (most.x - least.x > turn / 4) return Cover::partly;
		return coverBetween(uvOf(least), uvOf(most), contentOf);
	}

private:
	glm::dvec2 uvOf(const glm::dvec2 &place) const
	{
		return {view_.uvAhead.x + view_.uvPerUnit.x * place.x, view_.uvAhead.y + view_.uvPerUnit.y * place.y};
	}

	const CornerRays rays_;
	const CurvedView &view_;
};

/// What counts as nearer than this, metres, is moved as if it were there: where a view is wrong about its depth, it is not torn to pieces.
constexpr double nearestMoved = 0.2;
/// An eye that has moved less than this, metres, sees what is nearest by less than a third of a panel's pixel elsewhere: not worth a
/// search.
constexpr double leastMove = 2e-4;
/// Between two steps of surface.frag's search a view's texels move by about this much, unless that takes more than so many steps: then it
/// may miss what is thinner than a step.
constexpr double texelsPerStep = 2;
constexpr double mostSteps = 16;

/// More than any 1 / distance.
constexpr float endless = 1e30f;

/// 1 / distance of the nearest that a view's depth can say.
double largestInverse(const ViewDepth &depth)
{
	const double atZero = double(depth.inverseBias), atOne = atZero + double(depth.inverseScale);
	return std::clamp(std::max(atZero, atOne), 0.0, 1 / nearestMoved);
}

/// What a deep layer's coordinates do at the corners of a tile, from what is infinitely far away to what is nearest.
class DeepReach
{
public:
	DeepReach(const TileGrid &grid, const RaysByBand &rays, double inverse) : rays_(grid, rays), inverse_(inverse) {}

	Cover cover(int column, int row, const ContentOf &contentOf) const
	{
		glm::dvec2 least(1e30), most(-1e30);
		const bool isInFront = rays_.all(column, row, [&](const glm::dvec3 &ray, const glm::dvec3 &origin) {
			for (const glm::dvec3 &place : {ray, ray + origin * (std::max(ray.z, 0.0) * inverse_)}) {
				if (place.z <= 1e-6) return false;
				const glm::dvec2 uv(place.x / place.z, place.y / place.z);
				least = glm::min(least, uv);
				most = glm::max(most, uv);
			}
			return true;
		});
		if (!isInFront) return Cover::partly;
		return coverBetween(least, most, contentOf);
	}

private:
	const CornerRays rays_;
	const double inverse_;
};

/// How many steps surface.frag searches from what is nearest to what is infinitely far away.
double searchSteps(const RaysByBand &rays, const XrExtent2Di &extent, double inverse)
{
	double texels = 0;
	for (const glm::dvec3 &offset : rays.origin)
		for (const double edge : {0, 1}) {
			const glm::dvec2 moved = (glm::dvec2(offset) - edge * offset.z) * glm::dvec2(extent.width, extent.height) * inverse;
			texels = std::max(texels, glm::length(moved));
		}
	return std::clamp(std::ceil(texels / texelsPerStep), 1.0, mostSteps);
}

void describeDepth(shaders::SurfaceBlock &block, const ProjectionView &view, const RaysByBand &rays)
{
	const auto vector = [](auto x, auto y) { return glm::vec2(float(x), float(y)); };
	const auto &[corner, extent] = view.texture.rect;
	const auto &[depthCorner, depthExtent] = view.depth->texture.rect;
	const glm::vec2 scale = vector(depthExtent.width, depthExtent.height) / vector(extent.width, extent.height);
	const glm::vec2 first = vector(depthCorner.x, depthCorner.y);
	const double inverse = largestInverse(*view.depth);
	const float nearest = view.depth->testedFrom, farthest = view.depth->testedTo;
	block.placing = {farthest > 0 ? 1 / farthest : 0, nearest > 0 ? 1 / nearest : endless, 0, 0};
	block.depthTexel = {scale, first - (vector(corner.x, corner.y) - 0.5f) * scale};
	block.depthBounds = {first, first + vector(depthExtent.width, depthExtent.height) - 1.0f};
	block.depthSearch = {view.depth->inverseBias, view.depth->inverseScale, float(inverse), float(searchSteps(rays, extent, inverse))};
}

/// An opacity is a scale of the alpha that the key leaves.
void describeKey(shaders::SurfaceBlock &block, const KeyedOut &keyed)
{
	const auto &[red, green, blue] = keyed.key.colour;
	block.key = {red, green, blue, keyed.key.tolerance};
	block.size.w = keyed.key.softness;
	block.colorScale.a *= keyed.opacity;
	block.colorBias.a *= keyed.opacity;
	if (keyed.opacity < 1) block.texels.z = 1;
}

/// uv (x w, y w, w) to texels.
glm::dmat3 texelsOf(const XrRect2Di &rect)
{
	const auto &[corner, extent] = rect;
	return {extent.width, 0, 0, 0, extent.height, 0, corner.x - 0.5, corner.y - 0.5, 1};
}

template <typename Reach> FrameVector<Cover> coverageOf(const TileGrid &grid, const Reach &reach, const ContentOf &contentOf)
{
	FrameVector<Cover> cover;
	cover.reserve(size_t(grid.rows()) * size_t(grid.columns()));
	for (int row = 0; row < grid.rows(); ++row)
		for (int column = 0; column < grid.columns(); ++column) cover.push_back(reach.cover(column, row, contentOf));
	return cover;
}

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
	return flat && !(layer.key && layer.hasAlpha()) && !layer.factors && !isTransformed(layer);
}

bool isShownWhereEmpty(const PanelLayer &layer)
{
	return layer.factors || !layer.hasAlpha() || layer.colorBias.a != 0 || (layer.depthTest && layer.depthTest->writes);
}

AlphaBelowFactors alphaBelowFactors(const PanelLayer &layer)
{
	if (!layer.factors) return {};
	const auto &[sourceColor, keptColor, sourceAlpha, keptAlpha] = *layer.factors;
	return {byAlphaBelow(sourceColor), byAlphaBelow(keptColor), byAlphaBelow(sourceAlpha), byAlphaBelow(keptAlpha)};
}

bool readsAlphaBelow(const PanelLayer &layer) { return alphaBelowFactors(layer) != AlphaBelowFactors{}; }

/// Over a picture of colour C and alpha A in front of the world W, C + W (1 - A) becomes k of itself and something added where both C and
/// 1 - A become k of themselves: where what is kept of the alpha is k, too, and what is added to it 1 - k.
bool needsAlphaBelow(const PanelLayer &layer)
{
	if (!layer.factors) return false;
	if (readsAlphaBelow(layer)) return true;
	const auto &[sourceColor, keptColor, sourceAlpha, keptAlpha] = *layer.factors;
	(void)sourceColor;
	const bool usual = keptColor == XR_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA_FB && sourceAlpha == XR_BLEND_FACTOR_ONE_FB;
	const bool added = keptColor == XR_BLEND_FACTOR_ONE_FB && sourceAlpha == XR_BLEND_FACTOR_ZERO_FB;
	return keptColor != keptAlpha || !(usual || added);
}

bool seesDepth(const PanelLayer &layer, size_t eye, const EyesByBand &eyes)
{
	const auto &view = layer.projection[eye];
	if (!view || !view->depth) return false;
	if (layer.depthTest) return true;
	return std::ranges::any_of(eyes, [&](const auto &both) {
		const Placement drawn = layerInOrigin(both[eye], layer.headLocked, view->viewInFrame);
		return glm::distance(both[eye].view.position, drawn.position) > leastMove;
	});
}

std::optional<RaysByBand> surfaceRays(const PanelLayer &layer, Surface surface, size_t eye, const EyesByBand &eyes)
{
	RaysByBand rays;
	switch (surface) {
	case Surface::none: return std::nullopt;
	case Surface::flat: {
		const auto matrices = layerMatrices(layer, eye, eyes);
		if (!matrices) return std::nullopt;
		rays.matrix = *matrices;
		if (const auto &quad = layer.quad[eye])
			for (size_t band = 0; band <= bandCount; ++band)
				rays.origin[band].x = 1 / std::max(distanceFrom(eyes[band][eye], layer.headLocked, *quad), 1e-6);
		return rays;
	}
	case Surface::deep:
		for (size_t band = 0; band <= bandCount; ++band) {
			const DeepProjection deep = deepProjection(eyes[band][eye], layer.headLocked, *layer.projection[eye]);
			rays.matrix[band] = deep.direction;
			rays.origin[band] = deep.offset;
		}
		return isFinite(rays.matrix) ? std::optional(rays) : std::nullopt;
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

FrameVector<Cover> surfaceCoverage(const TileGrid &grid, const PanelLayer &layer, Surface surface, size_t eye, const RaysByBand &rays,
								   const ContentOf &contentOf)
{
	if (surface == Surface::flat) return flatCoverage(grid, rays, contentOf);
	if (surface == Surface::cube) return FrameVector<Cover>(size_t(grid.rows()) * size_t(grid.columns()), Cover::partly);
	if (surface == Surface::deep) return coverageOf(grid, DeepReach(grid, rays, largestInverse(*layer.projection[eye]->depth)), contentOf);
	return coverageOf(grid, CurvedReach(grid, *layer.curved[eye], rays), contentOf);
}

shaders::SurfaceBlock surfaceBlock(const PanelLayer &layer, Surface surface, size_t eye, uint32_t band, const RaysByBand &rays,
								   const gpu::ImageSpec &spec)
{
	const shaders::LayerBlock flat = layerBlock(layer, eye, band, rays.matrix, spec.width, spec.height);
	const bool isFlat = surface == Surface::flat || surface == Surface::deep;
	shaders::SurfaceBlock block{.ray = isFlat ? flat.texel : byLine(rays.matrix, band), .bounds = flat.bounds};
	const glm::dmat3 inBlock = surface == Surface::deep ? texelsOf(layer.projection[eye]->texture.rect) : glm::dmat3(1);
	const glm::dvec3 origin = inBlock * rays.origin[band], change = inBlock * rays.origin[band + 1] - origin;
	for (int column = 0; column < 3; ++column) {
		block.ray.first[column].w = float(origin[column]);
		block.ray.change[column].w = float(change[column]);
	}
	if (surface == Surface::deep) describeDepth(block, *layer.projection[eye], rays);
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
	block.colorScale = vectorOf(layer.colorScale);
	block.colorBias = vectorOf(layer.colorBias);
	block.source = {sourceColor.constant, sourceColor.byAlpha, sourceAlpha.constant, sourceAlpha.byAlpha};
	block.kept = {keptColor.constant, keptColor.byAlpha, keptAlpha.constant, keptAlpha.byAlpha};
	block.texels = {encoded, !layer.hasAlpha(), isTransformed(layer), layer.isStraight()};
	const float radius = layer.curved[eye] ? layer.curved[eye]->radius : 0;
	block.size = {flat.mode.x, flat.mode.y, radius > 0 ? 1 / radius : 0, 0};
	if (layer.key) describeKey(block, *layer.key);
	return block;
}

} // namespace arift
