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

PanelLayer layerOf(const ipc::Layer &layer, bool rowsGoUp)
{
	PanelLayer result{.headLocked = layer.frame == ipc::LayerFrame::head, .flags = layer.flags};
	for (uint32_t eye = 0; eye < 2; ++eye) {
		if (!(layer.eyes >> eye & 1)) continue;
		const ipc::LayerView &view = layer.views[layer.type == ipc::LayerType::quad ? 0 : eye];
		if (layer.type == ipc::LayerType::quad)
			result.quad[eye] = QuadView{view.pose, sizeOf(layer, rowsGoUp), textureOf(view.image)};
		else if (layer.type == ipc::LayerType::projection)
			result.projection[eye] = ProjectionView{view.pose, fovOf(view, rowsGoUp), textureOf(view.image)};
	}
	return result;
}

} // namespace

std::shared_ptr<const FrameContent> contentOf(const ipc::Submission &submission, XrTime received)
{
	if (submission.layerCount == 0) return nullptr;
	auto content = std::make_shared<FrameContent>();
	content->frame = submission.frame;
	content->received = received;
	content->blendMode = XrEnvironmentBlendMode(submission.blendMode);
	for (uint32_t i = 0; i < submission.layerCount; ++i) content->layers.push_back(layerOf(submission.layers[i], submission.rowsGoUp != 0));
	return content;
}

} // namespace arift
