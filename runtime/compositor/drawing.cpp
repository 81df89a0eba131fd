#include "runtime/compositor/drawing.h"
#include "runtime/compositor/camera_cover.h"
#include <algorithm>

namespace arift
{

namespace
{

bool lies(const LayerTexture &texture, const gpu::ImageSpec &spec, gpu::ImageKind kind)
{
	if (gpu::kindOf(spec) != kind) return false;
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

/// Pictures for people and layers with a key are rare: they have no pipelines of their own for what lies wholly inside a layer. Where
/// depths are tested, what an opaque layer hides may hide what is above that.
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
		pipelines_.resize(count);
		needsAlpha_.resize(count);
		for (size_t i = 0; i < count; ++i) needsAlpha_[i] = needsAlpha(draw_.inputs.layers[i]);
		tests_ = std::ranges::any_of(draw_.inputs.layers, [](const PanelLayer &layer) { return layer.depthTest.has_value(); });
		gathers_ = std::ranges::find(needsAlpha_, true) != needsAlpha_.end();
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

	/// With no world behind the layers, or light added to them, their alpha matters only to one of them that asks for it.
	bool needsAlpha(const PanelLayer &layer) const
	{
		return draw_.inputs.blendMode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND ? needsAlphaBelow(layer) : readsAlphaBelow(layer);
	}

	void addLayer(size_t index)
	{
		const PanelLayer &layer = draw_.inputs.layers[index];
		const Surface surface = surfaceOf(layer, draw_.eye);
		if (surface == Surface::none) return;
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		const auto image = findImage_(texture);
		if (!image || !lies(texture, *image->spec, surface == Surface::cube ? gpu::ImageKind::cube : gpu::ImageKind::flat)) return;
		const PipelineKey key = surfaceKey(layer, isDeep(layer) ? Surface::deep : surface);
		if (isPlain(layer) && !gathers_ && key.surface == Surface::flat && key.depth == Depth::unused)
			addPlain(index, layer, *image);
		else
			addSurface(index, key, layer, *image);
	}

	/// What surface.frag draws it with; a view that is not deep is not tested.
	PipelineKey surfaceKey(const PanelLayer &layer, Surface surface) const
	{
		PipelineKey key{.blend = Blend::over,
						.layer = Cover::partly,
						.throughLens = draw_.geometry.throughLens,
						.keyed = layer.key.has_value(),
						.surface = surface,
						.byAlphaBelow = alphaBelowFactors(layer)};
		// What is always seen and never there for others is not tested.
		const bool matters = layer.depthTest && (layer.depthTest->compare != VK_COMPARE_OP_ALWAYS || layer.depthTest->writes);
		if (matters && (surface == Surface::deep || !layer.projection[draw_.eye])) {
			key.depth = Depth::tested;
			key.compare = layer.depthTest->compare;
			key.writesDepth = layer.depthTest->writes;
		}
		return key;
	}

	bool isDeep(const PanelLayer &layer) const
	{
		if (!seesDepth(layer, draw_.eye, eyes_)) return false;
		const LayerTexture &depth = layer.projection[draw_.eye]->depth->texture;
		const auto image = findImage_(depth);
		if (!image || !lies(depth, *image->spec, gpu::ImageKind::depth)) return false;
		const PipelineKey key = surfaceKey(layer, Surface::deep);
		return isReady_(key) && (key.depth == Depth::unused || !hasRange(layer) || isReady_(outsideOf(key)));
	}

	void addPlain(size_t index, const PanelLayer &layer, const KnownImage &image)
	{
		const auto matrices = layerMatrices(layer, draw_.eye, eyes_);
		if (!matrices) return;
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		// Half a texel within the edge, what lies beyond it would be mixed in.
		const glm::dvec2 border(0.5 / texture.rect.extent.width, 0.5 / texture.rect.extent.height);
		covers_[index] =
			coverage(draw_.grid, *matrices, border, contentOf(texture, layer.key ? nullptr : image.occupancy, layer.isOpaque()));
		if (!draw_.geometry.throughLens || layer.key || tests_) blendEverywhere(covers_[index]);
		pipelines_[index] = {.layerEncoded = gpu::storedFormat(VkFormat(image.spec->format)) != VkFormat(image.spec->format),
							 .throughLens = draw_.geometry.throughLens,
							 .keyed = layer.key.has_value()};
		blocks_[index] = uint32_t(drawing_.layerBlocks.size());
		for (uint32_t band = 0; band < bandCount; ++band)
			drawing_.layerBlocks.push_back(layerBlock(layer, draw_.eye, band, *matrices, image.spec->width, image.spec->height));
	}

	/// Where its image is empty, a layer may have a bias, or hide what is below it.
	void addSurface(size_t index, const PipelineKey &key, const PanelLayer &layer, const KnownImage &image)
	{
		const Surface surface = key.surface;
		pipelines_[index] = key;
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
		DrawItem item{.pipeline = {.throughLens = draw_.geometry.throughLens}, .eyeBlock = firstEyeBlock + tiles.band};
		if (tiles.layer >= 0) describeLayer(item, size_t(tiles.layer), tiles.band);
		if (tiles.behind != Behind::nothing) {
			item.pipeline.background = tiles.behind == Behind::camera ? backdrop.background : Background::unseen;
			item.pipeline.camera = tiles.behind == Behind::camera ? backdrop.camera : 0;
			item.pipeline.encoded = tiles.behind == Behind::camera && backdrop.encoded;
		}
		item.pipeline.blend = tiles.blend;
		// What is behind an opaque layer is drawn with it only where light is added to it: too seldom for a pipeline.
		const bool alone = item.pipeline.background == Background::none;
		item.pipeline.layer = tiles.cover == Cover::opaque && !alone ? Cover::fully : tiles.cover;
		addRects(item, tiles.rects);
		if (item.pipeline.depth == Depth::unused || !hasRange(draw_.inputs.layers[size_t(tiles.layer)])) return;
		item.pipeline = outsideOf(item.pipeline);
		addRects(item, tiles.rects);
	}

	void describeLayer(DrawItem &item, size_t index, uint32_t band) const
	{
		const PanelLayer &layer = draw_.inputs.layers[index];
		const LayerTexture &texture = textureOf(layer, draw_.eye);
		item.pipeline = pipelines_[index];
		item.layerBlock = blocks_[index] + band;
		item.image = texture.image;
		item.arrayIndex = texture.arrayIndex;
		if (item.pipeline.surface != Surface::deep) return;
		const LayerTexture &depth = layer.projection[draw_.eye]->depth->texture;
		item.depthImage = depth.image;
		item.depthArrayIndex = depth.arrayIndex;
	}

	/// What draws the rest of a layer that is tested in a range alone.
	static PipelineKey outsideOf(PipelineKey key)
	{
		key.depth = Depth::outside;
		key.compare = PipelineKey{}.compare;
		key.writesDepth = false;
		return key;
	}

	/// Of a view that is tested.
	bool hasRange(const PanelLayer &layer) const
	{
		const auto &view = layer.projection[draw_.eye];
		return view && (view->depth->testedFrom > 0 || view->depth->testedTo > 0);
	}

	Drawing &drawing_;
	const EyeDraw &draw_;
	const FindImage &findImage_;
	const IsReady &isReady_;
	EyesByBand eyes_;
	FrameVector<FrameVector<Cover>> covers_; ///< by layer
	FrameVector<uint32_t> blocks_;           ///< by layer: its first block
	FrameVector<PipelineKey> pipelines_;     ///< by layer: what of it is drawn with, wherever it is
	FrameVector<bool> needsAlpha_;           ///< by layer: needsAlpha()
	bool gathers_ = false;                   ///< a layer needs it: all are drawn so that their alpha is known
	bool tests_ = false;                     ///< a layer may be tested
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
