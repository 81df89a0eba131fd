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

PanelLayer layerOf(const ipc::Layer &layer)
{
	PanelLayer result{.headLocked = layer.frame == ipc::LayerFrame::head, .flags = layer.flags};
	for (uint32_t eye = 0; eye < 2; ++eye) {
		if (!(layer.eyes >> eye & 1)) continue;
		const ipc::LayerView &view = layer.views[layer.type == ipc::LayerType::quad ? 0 : eye];
		if (layer.type == ipc::LayerType::quad)
			result.quad[eye] = QuadView{view.pose, {layer.width, layer.height}, textureOf(view.image)};
		else
			result.projection[eye] = ProjectionView{view.pose, view.fov, textureOf(view.image)};
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
	for (uint32_t i = 0; i < submission.layerCount; ++i) content->layers.push_back(layerOf(submission.layers[i]));
	return content;
}

} // namespace arift
