#include "runtime/compositor/drawing.h"
#include "runtime/compositor/camera_cover.h"
#include <algorithm>

namespace arift
{

namespace
{

enum class Kind { flat, cube, depth };
Kind kindOf(const gpu::ImageSpec &spec)
{
	if (gpu::isDepth(VkFormat(spec.format))) return Kind::depth;
	return gpu::isCube(spec) ? Kind::cube : Kind::flat;
}

bool lies(const LayerTexture &texture, const gpu::ImageSpec &spec, Kind kind)
{
	if (kindOf(spec) != kind) return false;
	const XrOffset2Di &corner = texture.rect.offset;
	const XrExtent2Di &extent = texture.rect.extent;
	return corner.x >= 0 && corner.y >= 0 && extent.width > 0 && extent.height > 0 &&
		   int64_t(corner.x) + extent.width <= int64_t(spec.width) && int64_t(corner.y) + extent.height <= int64_t(spec.height) &&
		   texture.arrayIndex < gpu::arraySize(spec);
}

/// A texel's light reaches into its neighbours. `texture` must outlive the answer. `wholly`: the layer hides what is behind it, whatever
/// its image holds.
ContentOf contentOf(const LayerTexture &texture, Occupancy *occupancy, bool wholly)
{
	if (wholly || !occupancy) return [content = wholly ? Content::opaque : Content::some](auto, auto) { return content; };
	// Two pointers: what a std::function holds without memory of its own.
	return [&rect = texture.rect, occupancy](glm::dvec2 least, glm::dvec2 most) {
		const auto within = [](double place, int32_t offset, int32_t extent) { return offset + int(std::clamp(place, 0.0, 1.0) * extent); };
		return occupancy->contentOf(
			{within(least.x, rect.offset.x, rect.extent.width) - 1, within(least.y, rect.offset.y, rect.extent.height) - 1,
			 within(most.x, rect.offset.x, rect.extent.width) + 2, within(most.y, rect.offset.y, rect.extent.height) + 2});
	};
}

/// What an eye sees behind the layers.
PipelineKey backdropOf(const CameraView *camera, bool throughLens)
{
	if (!camera) return {.background = Background::pattern, .throughLens = throughLens};
	return {.background = Background::camera, .camera = camera->lens, .encoded = !camera->linear, .throughLens = throughLens};
}

/// Pictures for people and layers with a key are rare: they have no pipelines of their own for what lies wholly inside a layer.
void blendEverywhere(FrameVector<Cover> &cover)
{
	std::ranges::replace_if(
		cover, [](Cover tile) { return tile != Cover::none; }, Cover::partly);
}

void addRect(Drawing &drawing, const PixelRect &rect)
{
	const auto x0 = int16_t(rect.x0), y0 = int16_t(rect.y0), x1 = int16_t(rect.x1), y1 = int16_t(rect.y1);
	drawing.vertices.insert(drawing.vertices.end(), {{x0, y0}, {x1, y0}, {x0, y1}, {x0, y1}, {x1, y0}, {x1, y1}});
}

class EyeDrawing
{
public:
	EyeDrawing(Drawing &drawing, const EyeDraw &draw, const FindImage &findImage, const IsReady &isReady)
		: drawing_(drawing),
		  draw_(draw),
		  findImage_(findImage),
		  isReady_(isReady),
		  eyes_(eyesByBand(draw.inputs, draw.grid, draw.geometry.height))
	{
	}

	void make()
	{
		const auto firstEyeBlock = uint32_t(drawing_.eyeBlocks.size());
		const CameraView *camera = cameraOf(draw_.inputs, draw_.optics, draw_.eye);
		const MatrixByBand matrices = addEyeBlocks(camera);
		FrameVector<bool> seen;
		if (camera) seen = seenTiles(draw_.grid, matrices, draw_.optics.cameras[camera->lens]);
		const size_t count = std::min(draw_.inputs.layers.size(), maxDrawnLayers);
		covers_.resize(count);
		blocks_.resize(count);
		encoded_.resize(count);
		surfaces_.resize(count);
		needsAlpha_.resize(count);
		for (size_t i = 0; i < count; ++i) needsAlpha_[i] = needsAlphaBelow(draw_.inputs.layers[i]);
		gathers_ =
			draw_.inputs.blendMode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND && std::ranges::find(needsAlpha_, true) != needsAlpha_.end();
		for (size_t i = 0; i < count; ++i) addLayer(i);
		const PipelineKey backdrop = backdropOf(camera, draw_.geometry.throughLens);
		addItems(backdrop, firstEyeBlock, seen);
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
		const Surface surface = surfaceOf(layer, draw_.eye);
		if (surface == Surface::none) return;
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		const auto image = findImage_(texture);
		if (!image || !lies(texture, *image->spec, surface == Surface::cube ? Kind::cube : Kind::flat)) return;
		surfaces_[index] = isDeep(layer) ? Surface::deep : isPlain(layer) && !gathers_ ? Surface::none : surface;
		if (surfaces_[index] == Surface::none)
			addPlain(index, layer, *image);
		else
			addSurface(index, layer, *image);
	}

	bool isDeep(const PanelLayer &layer) const
	{
		if (!seesDepth(layer, draw_.eye, eyes_)) return false;
		const LayerTexture &depth = layer.projection[draw_.eye]->depth->texture;
		const auto image = findImage_(depth);
		return image && lies(depth, *image->spec, Kind::depth) && isReady_(deepKey(draw_.geometry.throughLens));
	}

	void addPlain(size_t index, const PanelLayer &layer, const KnownImage &image)
	{
		const auto matrices = layerMatrices(layer, draw_.eye, eyes_);
		if (!matrices) return;
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		// Half a texel within the edge, what lies beyond it would be mixed in.
		const glm::dvec2 border(0.5 / texture.rect.extent.width, 0.5 / texture.rect.extent.height);
		covers_[index] =
			coverage(draw_.grid, *matrices, border, contentOf(texture, layer.key ? nullptr : image.occupancy, isOpaque(layer)));
		if (!draw_.geometry.throughLens || layer.key) blendEverywhere(covers_[index]);
		encoded_[index] = gpu::storedFormat(VkFormat(image.spec->format)) != VkFormat(image.spec->format);
		blocks_[index] = uint32_t(drawing_.layerBlocks.size());
		for (uint32_t band = 0; band < bandCount; ++band)
			drawing_.layerBlocks.push_back(layerBlock(layer, draw_.eye, band, *matrices, image.spec->width, image.spec->height));
	}

	/// Where its image is empty, a layer may have a bias, or hide what is below it.
	void addSurface(size_t index, const PanelLayer &layer, const KnownImage &image)
	{
		const Surface surface = surfaces_[index];
		const auto rays = surfaceRays(layer, surface, draw_.eye, eyes_);
		if (!rays) return;
		Occupancy *occupancy = isShownWhereEmpty(layer) ? nullptr : image.occupancy;
		const ContentOf content = contentOf(textureOf(layer, draw_.eye), occupancy, false);
		covers_[index] = surfaceCoverage(draw_.grid, layer, surface, draw_.eye, *rays, content);
		blocks_[index] = uint32_t(drawing_.surfaceBlocks.size());
		for (uint32_t band = 0; band < bandCount; ++band)
			drawing_.surfaceBlocks.push_back(surfaceBlock(layer, surface, draw_.eye, band, *rays, *image.spec));
	}

	/// The layers below the first passthrough layer, that one over them, those above it over both, and so on.
	void addItems(const PipelineKey &backdrop, uint32_t firstEyeBlock, const FrameVector<bool> &seen)
	{
		const std::span<const FrameVector<Cover>> covers = covers_;
		size_t begin = 0;
		for (size_t i = 0; i <= covers.size(); ++i) {
			const bool isPassthrough = i < covers.size() && draw_.inputs.layers[i].passthrough;
			if (i < covers.size() && !isPassthrough) continue;
			const Base base = begin == 0 ? Base::replaced : Base::kept;
			const FrameVector<bool> needsAlpha(needsAlpha_.begin() + ptrdiff_t(begin), needsAlpha_.begin() + ptrdiff_t(i));
			for (TileDraw &tiles :
				 planDraws(draw_.grid, draw_.inputs.blendMode, covers.subspan(begin, i - begin), seen, base, needsAlpha)) {
				if (tiles.layer >= 0) tiles.layer += int(begin);
				addItem(tiles, backdrop, firstEyeBlock);
			}
			if (isPassthrough) addPassthrough(*draw_.inputs.layers[i].passthrough, backdrop, firstEyeBlock);
			begin = i + 1;
		}
	}

	void addPassthrough(PassthroughStyle style, const PipelineKey &backdrop, uint32_t firstEyeBlock)
	{
		if (style.map && !findImage_(*style.map)) style.map.reset();
		DrawItem item{.pipeline = backdrop, .layerBlock = uint32_t(drawing_.layerBlocks.size())};
		item.pipeline.blend = Blend::over;
		item.pipeline.look = style.isChanged() ? Look::styled : Look::faded;
		if (style.map) item.image = style.map->image;
		drawing_.layerBlocks.push_back(passthroughBlock(style));
		for (const TileDraw &everywhere : planDraws(draw_.grid, XR_ENVIRONMENT_BLEND_MODE_OPAQUE, {})) {
			item.eyeBlock = firstEyeBlock + everywhere.band;
			addRects(item, everywhere.rects);
		}
	}

	void addRects(DrawItem item, const FrameVector<PixelRect> &rects)
	{
		item.firstVertex = uint32_t(drawing_.vertices.size());
		for (const PixelRect &rect : rects) addRect(drawing_, rect);
		item.vertexCount = uint32_t(drawing_.vertices.size()) - item.firstVertex;
		drawing_.items.push_back(item);
	}

	void addItem(const TileDraw &tiles, const PipelineKey &backdrop, uint32_t firstEyeBlock)
	{
		DrawItem item{.pipeline = {.throughLens = draw_.geometry.throughLens}};
		if (tiles.behind == Behind::camera) item.pipeline = backdrop;
		if (tiles.behind == Behind::unseen) item.pipeline.background = Background::unseen;
		item.pipeline.blend = tiles.blend;
		// What is behind an opaque layer is drawn with it only where light is added to it: too seldom for a pipeline.
		const bool alone = item.pipeline.background == Background::none;
		item.pipeline.layer = tiles.cover == Cover::opaque && !alone ? Cover::fully : tiles.cover;
		item.eyeBlock = firstEyeBlock + tiles.band;
		if (tiles.layer >= 0) {
			item.layerBlock = blocks_[size_t(tiles.layer)] + tiles.band;
			const LayerTexture &texture = textureOf(draw_.inputs.layers[size_t(tiles.layer)], draw_.eye);
			item.image = texture.image;
			item.arrayIndex = texture.arrayIndex;
			item.pipeline.surface = surfaces_[size_t(tiles.layer)];
			item.pipeline.layerEncoded = encoded_[size_t(tiles.layer)];
			if (item.pipeline.surface == Surface::deep) {
				const LayerTexture &depth = draw_.inputs.layers[size_t(tiles.layer)].projection[draw_.eye]->depth->texture;
				item.depthImage = depth.image;
				item.depthArrayIndex = depth.arrayIndex;
			}
			// Only plain layers are keyed out.
			item.pipeline.keyed = item.pipeline.surface == Surface::none && draw_.inputs.layers[size_t(tiles.layer)].key;
		}
		addRects(item, tiles.rects);
	}

	Drawing &drawing_;
	const EyeDraw &draw_;
	const FindImage &findImage_;
	const IsReady &isReady_;
	EyesByBand eyes_;
	FrameVector<FrameVector<Cover>> covers_; ///< by layer
	FrameVector<uint32_t> blocks_;           ///< by layer: its first block
	FrameVector<bool> encoded_;              ///< by layer: its texels are sRGB encoded, where it is plain
	FrameVector<Surface> surfaces_;          ///< by layer: none where it is plain
	FrameVector<bool> needsAlpha_;           ///< by layer: needsAlphaBelow()
	bool gathers_ = false;                   ///< a layer needs it: all are drawn so that their alpha is known
};

} // namespace

Drawing makeDrawing(const PanelInputs &inputs, const PanelOptics &optics, const ViewGeometry &geometry,
					const std::array<TileGrid, 2> &grids, const FindImage &findImage, const IsReady &isReady)
{
	Drawing drawing;
	for (size_t eye = 0; eye < 2; ++eye) {
		const EyeDraw draw{inputs, optics, geometry, grids[eye], eye};
		EyeDrawing(drawing, draw, findImage, isReady).make();
	}
	return drawing;
}

Drawing warmUpDrawing(std::span<const PipelineKey> pipelines, std::span<const uint64_t> images, std::span<const uint64_t> cubes,
					  const PixelRect &pixels)
{
	Drawing drawing{.eyeBlocks = FrameVector<shaders::EyeBlock>(1),
					.layerBlocks = FrameVector<shaders::LayerBlock>(1),
					.surfaceBlocks = FrameVector<shaders::SurfaceBlock>(1)};
	addRect(drawing, pixels);
	DrawItem item{.vertexCount = uint32_t(drawing.vertices.size())};
	for (const PipelineKey &key : pipelines) {
		item.pipeline = key;
		const std::span<const uint64_t> drawn = key.surface == Surface::cube ? cubes : images;
		for (const uint64_t image : key.layer == Cover::none && key.look != Look::styled ? images.first(1) : drawn) {
			item.image = image;
			drawing.items.push_back(item);
		}
	}
	return drawing;
}

} // namespace arift
