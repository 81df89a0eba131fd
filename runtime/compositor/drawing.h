// The whole drawing of one image as data: what is drawn where, with which pipeline and which numbers. Pure.
#pragma once
#include "runtime/compositor/surface.h"

namespace arift
{

/// Of all applications together: layers above this many are not drawn. One application can submit ipc::maxLayers of them.
constexpr size_t maxDrawnLayers = 1024;

struct DrawItem {
	PipelineKey pipeline;
	uint32_t eyeBlock = 0;   ///< index into Drawing::eyeBlocks
	uint32_t layerBlock = 0; ///< index into Drawing::layerBlocks, where the pipeline has a layer or a look of its own; of one with a
							 ///< surface into Drawing::surfaceBlocks
	uint64_t image = 0;      ///< the layer's, or a passthrough layer's map; 0: none
	uint32_t arrayIndex = 0;
	uint64_t depthImage = 0; ///< of a deep surface
	uint32_t depthArrayIndex = 0;
	uint32_t firstVertex = 0, vertexCount = 0;
};

struct Drawing {
	FrameVector<DrawItem> items;
	FrameVector<std::array<int16_t, 2>> vertices; ///< triangles, pixels
	FrameVector<shaders::EyeBlock> eyeBlocks;
	FrameVector<shaders::LayerBlock> layerBlocks;
	FrameVector<shaders::SurfaceBlock> surfaceBlocks;
};

/// An image that can be sampled.
struct KnownImage {
	const gpu::ImageSpec *spec = nullptr;
	Occupancy *occupancy = nullptr; ///< of the array layer asked for; null where nobody can look
};
using FindImage = std::function<std::optional<KnownImage>(const LayerTexture &)>;
/// Whether something can be drawn with a pipeline; its making begins where it cannot.
using IsReady = std::function<bool(const PipelineKey &)>;
/// Layers whose image or rectangle is not there are left out, and tiles where a layer has no content.
/// Layers with depth are drawn as if they had none as long as what draws them with it is not ready.
Drawing makeDrawing(const PanelInputs &inputs, const PanelOptics &optics, const ViewGeometry &geometry,
					const std::array<TileGrid, 2> &grids, const FindImage &findImage, const IsReady &isReady);
/// Draws a few pixels with every pipeline, those of layers with every image, so that nothing is left for a driver to do at a pipeline's
/// first draw.
/// `cubes`: images for pipelines of cubes.
Drawing warmUpDrawing(std::span<const PipelineKey> pipelines, std::span<const uint64_t> images, std::span<const uint64_t> cubes,
					  const PixelRect &pixels);

} // namespace arift
