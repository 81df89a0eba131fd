#include "runtime/compositor/drawing.h"
#include "runtime/compositor/camera_cover.h"

namespace arift
{

namespace
{

bool lies(const LayerTexture &texture, const gpu::ImageSpec &spec)
{
	const XrOffset2Di &corner = texture.rect.offset;
	const XrExtent2Di &extent = texture.rect.extent;
	return corner.x >= 0 && corner.y >= 0 && extent.width > 0 && extent.height > 0 &&
		   int64_t(corner.x) + extent.width <= int64_t(spec.width) && int64_t(corner.y) + extent.height <= int64_t(spec.height) &&
		   texture.arrayIndex < spec.arrayLayers;
}

/// What an eye sees behind the layers.
PipelineKey backdropOf(const CameraView *camera, bool throughLens)
{
	if (!camera) return {.background = Background::pattern, .throughLens = throughLens};
	const bool bayer = isBayer(camera->frame.format);
	return {.background = bayer ? Background::bayer : Background::grey,
			.camera = camera->lens,
			.encoded = !camera->linear,
			.throughLens = throughLens};
}

class EyeDrawing
{
public:
	EyeDrawing(Drawing &drawing, const EyeDraw &draw, const std::function<const gpu::ImageSpec *(uint64_t)> &specOf)
		: drawing_(drawing), draw_(draw), specOf_(specOf), eyes_(eyesByBand(draw.inputs, draw.grid, draw.geometry.height))
	{
	}

	void make()
	{
		const auto firstEyeBlock = uint32_t(drawing_.eyeBlocks.size());
		const CameraView *camera = cameraOf(draw_.inputs, draw_.optics, draw_.eye);
		const MatrixByBand matrices = addEyeBlocks(camera);
		std::vector<bool> seen;
		if (camera) seen = seenTiles(draw_.grid, matrices, draw_.optics.cameras[camera->lens]);
		const size_t count = std::min(draw_.inputs.layers.size(), maxDrawnLayers);
		planned_.resize(count);
		blocks_.resize(count);
		for (size_t i = 0; i < count; ++i) addLayer(i);
		const PipelineKey backdrop = backdropOf(camera, draw_.geometry.throughLens);
		for (const TileDraw &tiles : planDraws(draw_.grid, draw_.inputs.blendMode, planned_, seen)) addItem(tiles, backdrop, firstEyeBlock);
	}

private:
	MatrixByBand addEyeBlocks(const CameraView *camera)
	{
		MatrixByBand matrices;
		for (uint32_t band = 0; band <= bandCount; ++band) {
			const EyeAtLine &eye = eyes_[band][draw_.eye];
			matrices[band] = camera ? cameraMatrix(eye, camera->cameraInOrigin) : directionMatrix(eye);
		}
		for (uint32_t band = 0; band < bandCount; ++band) drawing_.eyeBlocks.push_back(eyeBlock(draw_, band, matrices));
		return matrices;
	}

	void addLayer(size_t index)
	{
		const PanelLayer &layer = draw_.inputs.layers[index];
		const auto matrices = layerMatrices(layer, draw_.eye, eyes_);
		if (!matrices) return;
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		const gpu::ImageSpec *spec = specOf_(texture.image);
		if (!spec || !lies(texture, *spec)) return;
		planned_[index] = {coverage(draw_.grid, *matrices), isOpaque(layer)};
		blocks_[index] = uint32_t(drawing_.layerBlocks.size());
		for (uint32_t band = 0; band < bandCount; ++band)
			drawing_.layerBlocks.push_back(layerBlock(layer, draw_.eye, band, *matrices, spec->width, spec->height));
	}

	void addItem(const TileDraw &tiles, const PipelineKey &backdrop, uint32_t firstEyeBlock)
	{
		DrawItem item{.pipeline = {.throughLens = draw_.geometry.throughLens}};
		if (tiles.behind == Behind::camera) item.pipeline = backdrop;
		if (tiles.behind == Behind::unseen) item.pipeline.background = Background::unseen;
		item.pipeline.blend = tiles.blend;
		item.pipeline.layer = tiles.layer >= 0;
		item.eyeBlock = firstEyeBlock + tiles.band;
		if (tiles.layer >= 0) {
			item.layerBlock = blocks_[size_t(tiles.layer)] + tiles.band;
			item.image = textureOf(draw_.inputs.layers[size_t(tiles.layer)], draw_.eye).image;
		}
		item.firstVertex = uint32_t(drawing_.vertices.size());
		for (const PixelRect &rect : tiles.rects) {
			const auto x0 = int16_t(rect.x0), y0 = int16_t(rect.y0), x1 = int16_t(rect.x1), y1 = int16_t(rect.y1);
			drawing_.vertices.insert(drawing_.vertices.end(), {{x0, y0}, {x1, y0}, {x0, y1}, {x0, y1}, {x1, y0}, {x1, y1}});
		}
		item.vertexCount = uint32_t(drawing_.vertices.size()) - item.firstVertex;
		drawing_.items.push_back(item);
	}

	Drawing &drawing_;
	const EyeDraw &draw_;
	const std::function<const gpu::ImageSpec *(uint64_t)> &specOf_;
	std::array<std::array<EyeAtLine, 2>, bandCount + 1> eyes_;
	std::vector<PlannedLayer> planned_;
	std::vector<uint32_t> blocks_; ///< by layer: its first block
};

} // namespace

Drawing makeDrawing(const PanelInputs &inputs, const PanelOptics &optics, const ViewGeometry &geometry,
					const std::array<TileGrid, 2> &grids, const std::function<const gpu::ImageSpec *(uint64_t)> &specOf)
{
	Drawing drawing;
	for (size_t eye = 0; eye < 2; ++eye) {
		const EyeDraw draw{inputs, optics, geometry, grids[eye], eye};
		EyeDrawing(drawing, draw, specOf).make();
	}
	return drawing;
}

} // namespace arift
