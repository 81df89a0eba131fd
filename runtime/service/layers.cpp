#include "runtime/service/layers.h"
#include "runtime/service/swapchains.h"

namespace arift
{

namespace
{

LayerTexture textureOf(const ipc::SubImage &image)
{
	return {imageKey(image.swapchain, image.image), image.arrayIndex, {{image.x, image.y}, {image.width, image.height}}, image.release};
}

/// What is first in an image is up in a layer; of an image whose rows go up it is down.
XrFovf fovOf(const ipc::LayerView &view, bool rowsGoUp)
{
	const XrFovf &fov = view.fov;
	return rowsGoUp ? XrFovf{fov.angleLeft, fov.angleRight, fov.angleDown, fov.angleUp} : fov;
}
XrExtent2Df sizeOf(const ipc::Layer &layer, bool rowsGoUp) { return {layer.width, rowsGoUp ? -layer.height : layer.height}; }

std::optional<ViewDepth> depthOf(const ipc::ViewDepth &depth)
{
	if (depth.image.swapchain == 0) return std::nullopt;
	return ViewDepth{textureOf(depth.image), depth.inverseBias, depth.inverseScale, depth.testedFrom, depth.testedTo};
}

CurvedView curvedOf(const ipc::Layer &layer, bool rowsGoUp)
{
	const auto &[radius, ahead, perUnit] = layer.curved;
	CurvedView view{.surface = layer.type == ipc::LayerType::cylinder ? Surface::cylinder : Surface::sphere,
					.centreInFrame = layer.views[0].pose,
					.radius = radius,
					.uvAhead = ahead,
					.uvPerUnit = perUnit,
					.texture = textureOf(layer.views[0].image)};
	if (rowsGoUp) {
		view.uvAhead.y = 1 - ahead.y;
		view.uvPerUnit.y = -perUnit.y;
	}
	return view;
}

void addView(PanelLayer &result, uint32_t eye, const ipc::Layer &layer, bool rowsGoUp)
{
	using enum ipc::LayerType;
	const ipc::LayerView &view = layer.views[layer.type == projection ? eye : 0];
	switch (layer.type) {
	case projection:
		result.projection[eye] = ProjectionView{view.pose, fovOf(view, rowsGoUp), textureOf(view.image), depthOf(view.depth)};
		return;
	case quad: result.quad[eye] = QuadView{view.pose, sizeOf(layer, rowsGoUp), textureOf(view.image)}; return;
	case cylinder:
	case equirect: result.curved[eye] = curvedOf(layer, rowsGoUp); return;
	// Every graphics API looks up a face's first row alike.
	case cube: result.cube[eye] = CubeView{view.pose.orientation, textureOf(view.image)}; return;
	case passthrough: return; // shows no image
	}
}

PanelLayer layerOf(const ipc::Layer &layer, bool rowsGoUp)
{
	PanelLayer result{.headLocked = layer.frame == ipc::LayerFrame::head,
					  .flags = layer.flags,
					  .colorScale = layer.colorScale,
					  .colorBias = layer.colorBias};
	if (const ipc::BlendFactors &blend = layer.blend; blend.given)
		result.factors = {XrBlendFactorFB(blend.sourceColor), XrBlendFactorFB(blend.destinationColor), XrBlendFactorFB(blend.sourceAlpha),
						  XrBlendFactorFB(blend.destinationAlpha)};
	// XrCompareOpFB counts as VkCompareOp does.
	if (const ipc::DepthTest &test = layer.depthTest; test.given)
		result.depthTest = DepthTest{VkCompareOp(test.compareOp), test.writes != 0};
	for (uint32_t eye = 0; eye < 2; ++eye)
		if (layer.eyes >> eye & 1) addView(result, eye, layer, rowsGoUp);
	return result;
}

} // namespace

std::shared_ptr<const FrameContent> contentOf(const ipc::Submission &submission, XrTime received, const Presentation &presentation)
{
	if (submission.layerCount == 0) return nullptr;
	auto content = std::make_shared<FrameContent>();
	content->frame = submission.frame;
	content->received = received;
	content->blendMode = XrEnvironmentBlendMode(submission.blendMode);
	for (uint32_t i = 0; i < submission.layerCount; ++i) {
		const ipc::Layer &layer = submission.layers[i];
		if (layer.type == ipc::LayerType::passthrough)
			addPassthrough(*content, presentation, layer.passthrough);
		else
			content->layers.push_back(layerOf(layer, submission.rowsGoUp != 0));
	}
	force(*content, presentation);
	if (content->layers.empty() && content->blendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE) return nullptr;
	return content;
}

} // namespace arift
