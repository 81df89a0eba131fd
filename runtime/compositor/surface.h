// Layers that panel.frag does not draw: on cylinders, spheres and cubes, as far away as their depth says, and those that are tested for how
// far away they are, keyed out with an alpha of their own, or have a colour scale, a bias or blend factors. Pure functions in double
// precision; surface.frag is their other half.
#pragma once
#include "runtime/compositor/blocks.h"
#include "runtime/compositor/pipeline_key.h"
#include "runtime/gpu/image_spec.h"
#include "shaders/surface_block.h"

namespace arift
{

/// SurfaceBlock's ray and origin at the top of every band and at the bottom of the last; of flat and deep layers uv instead of texels, of
/// quads nearness in the origin's x.
struct RaysByBand {
	MatrixByBand matrix;
	std::array<glm::dvec3, bandCount + 1> origin{};
};

/// What this eye sees the layer on; none where it does not see it. Never deep.
Surface surfaceOf(const PanelLayer &layer, size_t eye);
/// Whether it matters how near things are in the layer's view, which says so: where a depth test wants to know, or an eye is so far from
/// where the view was drawn that it sees near things elsewhere.
bool seesDepth(const PanelLayer &layer, size_t eye, const EyesByBand &eyes);
/// Whether panel.frag can draw it.
bool isPlain(const PanelLayer &layer);
/// Whether it may be seen where its image is transparent black.
bool isShownWhereEmpty(const PanelLayer &layer);
/// Whether what becomes of what is behind the layers follows from nothing but their alpha together: else each layer can be drawn over the
/// cameras' image straight away.
bool needsAlphaBelow(const PanelLayer &layer);

AlphaBelowFactors alphaBelowFactors(const PanelLayer &layer);
/// Whether the alpha of the layers below it counts, in every blend mode.
bool readsAlphaBelow(const PanelLayer &layer);

/// What follows takes `surface`: surfaceOf(), or deep. Nothing where this eye does not see the layer.
std::optional<RaysByBand> surfaceRays(const PanelLayer &layer, Surface surface, size_t eye, const EyesByBand &eyes);
/// By tile, row by row: where such a layer may be seen and has content: `partly`, never `none` in error.
FrameVector<Cover> surfaceCoverage(const TileGrid &grid, const PanelLayer &layer, Surface surface, size_t eye, const RaysByBand &rays,
								   const ContentOf &contentOf);
shaders::SurfaceBlock surfaceBlock(const PanelLayer &layer, Surface surface, size_t eye, uint32_t band, const RaysByBand &rays,
								   const gpu::ImageSpec &spec);

} // namespace arift
