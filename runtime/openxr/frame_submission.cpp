#include "runtime/openxr/frame_submission.h"
#include "runtime/openxr/ext/fb_composition_layer_settings.h"
#include "runtime/openxr/swapchain.h"
#include <numbers>

namespace arift::openxr
{
namespace
{

constexpr XrCompositionLayerFlags knownLayerFlags = XR_COMPOSITION_LAYER_CORRECT_CHROMATIC_ABERRATION_BIT |
													XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
													XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;

uint32_t requireFlags(XrCompositionLayerFlags flags)
{
	if (flags & ~knownLayerFlags) throw Error(XR_ERROR_VALIDATION_FAILURE, "layerFlags {:#x} has unknown bits", flags);
	return uint32_t(flags);
}

void requireFov(const XrFovf &fov)
{
	constexpr float limit = std::numbers::pi_v<float> / 2;
	for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown})
		if (!(std::abs(angle) < limit)) throw Error(XR_ERROR_VALIDATION_FAILURE, "a field of view has the angle {}", angle);
	if (fov.angleLeft == fov.angleRight || fov.angleUp == fov.angleDown)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a field of view is empty: {} to {}, {} to {}", fov.angleLeft, fov.angleRight,
					fov.angleDown, fov.angleUp);
}

uint32_t eyesOf(XrEyeVisibility visibility)
{
	switch (visibility) {
	case XR_EYE_VISIBILITY_BOTH: return 3;
	case XR_EYE_VISIBILITY_LEFT: return 1;
	case XR_EYE_VISIBILITY_RIGHT: return 2;
	default: throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrEyeVisibility", int(visibility));
	}
}

/// Metres that arithmetic in single precision still makes sense for.
constexpr float farthest = 1e6f;

std::optional<XrPosef> unlessTooFar(const XrPosef &pose)
{
	const auto &[x, y, z] = pose.position;
	if (std::abs(x) < farthest && std::abs(y) < farthest && std::abs(z) < farthest) return pose;
	return std::nullopt;
}

void requireBlendMode(const ipc::Welcome &welcome, XrEnvironmentBlendMode mode)
{
	for (uint32_t i = 0; i < welcome.blendModeCount; ++i)
		if (welcome.blendModes[i] == int32_t(mode)) return;
	if (mode < XR_ENVIRONMENT_BLEND_MODE_OPAQUE || mode > XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrEnvironmentBlendMode", int(mode));
	throw Error(XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED, "environment blend mode {} is not supported", int(mode));
}

XrTime requireFrame(const Session &session, const XrFrameEndInfo &info)
{
	requireTime(info.displayTime);
	const ipc::Welcome &welcome = session.instance.service.welcome();
	requireBlendMode(welcome, info.environmentBlendMode);
	if (info.layerCount > welcome.maxLayers)
		throw Error(XR_ERROR_LAYER_LIMIT_EXCEEDED, "{} layers are more than {}", info.layerCount, welcome.maxLayers);
	if (info.layerCount > 0 && !info.layers) throw Error(XR_ERROR_LAYER_INVALID, "layers is null but layerCount is {}", info.layerCount);
	return info.displayTime;
}

} // namespace

FrameSubmission::FrameSubmission(Session &session, const XrFrameEndInfo &info)
	: session_(session), locator_(session, requireFrame(session, info))
{
	submission.displayTime = info.displayTime;
	submission.blendMode = info.environmentBlendMode;
	submission.rowsGoUp = session.graphics() && session.graphics()->rowsGoUp() ? 1 : 0;
	for (uint32_t i = 0; i < info.layerCount; ++i) addLayer(info.layers[i]);
	for (const Use &use : uses_)
		if (auto completion = use.swapchain->workOn(use.image)) work.push_back(std::move(completion));
}

void FrameSubmission::noteUse() const
{
	for (const Use &use : uses_) use.swapchain->noteSubmitted(use.image, submission.frame);
}

void FrameSubmission::addLayer(const XrCompositionLayerBaseHeader *header)
{
	if (!header) throw Error(XR_ERROR_LAYER_INVALID, "a layer is null");
	if (!session_.graphics()) return; // a headless session shows nothing
	if (session_.instance.has(Extension::FB_composition_layer_settings)) requireLayerSettings(header->next);
	switch (header->type) {
	case XR_TYPE_COMPOSITION_LAYER_PROJECTION: return addProjection(reinterpret_cast<const XrCompositionLayerProjection &>(*header));
	case XR_TYPE_COMPOSITION_LAYER_QUAD: return addQuad(reinterpret_cast<const XrCompositionLayerQuad &>(*header));
	default: throw Error(XR_ERROR_LAYER_INVALID, "layers of XrStructureType {} are not supported", int(header->type));
	}
}

std::optional<XrPosef> FrameSubmission::place(ipc::Layer &layer, XrSpace handle, const XrPosef &given, const char *what)
{
	const Space &space = handles.at<Space>(handle);
	if (&space.session != &session_) throw Error(XR_ERROR_VALIDATION_FAILURE, "the space of {} belongs to another session", what);
	const XrPosef pose = requirePose(given, what);
	layer.frame = space.isHeadLocked() ? ipc::LayerFrame::head : ipc::LayerFrame::origin;
	if (space.isHeadLocked()) return unlessTooFar(space.offset * pose);
	const auto inOrigin = locator_.inOrigin<XrPosef>(space);
	if (!inOrigin) return std::nullopt;
	return unlessTooFar(*inOrigin * pose);
}

void FrameSubmission::addProjection(const XrCompositionLayerProjection &projection)
{
	ipc::Layer layer;
	layer.type = ipc::LayerType::projection;
	layer.flags = requireFlags(projection.layerFlags);
	if (projection.viewCount != 2 || !projection.views)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a projection layer has {} views instead of 2", projection.viewCount);
	bool isPlaced = true;
	for (size_t eye = 0; eye < 2; ++eye) {
		const XrCompositionLayerProjectionView &view = projection.views[eye];
		requireType(&view);
		requireFov(view.fov);
		const auto pose = place(layer, projection.space, view.pose, "a projection layer's view");
		isPlaced = isPlaced && pose;
		layer.views[eye] = {pose.value_or(identityPose), view.fov, subImage(view.subImage)};
	}
	if (isPlaced) submission.layers[submission.layerCount++] = layer;
}

void FrameSubmission::addQuad(const XrCompositionLayerQuad &quad)
{
	ipc::Layer layer;
	layer.type = ipc::LayerType::quad;
	layer.flags = requireFlags(quad.layerFlags);
	layer.eyes = eyesOf(quad.eyeVisibility);
	if (!std::isfinite(quad.size.width) || !std::isfinite(quad.size.height))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a quad layer has the size {} x {} m", quad.size.width, quad.size.height);
	layer.width = quad.size.width;
	layer.height = quad.size.height;
	const auto pose = place(layer, quad.space, quad.pose, "a quad layer");
	layer.views[0] = {pose.value_or(identityPose), {}, subImage(quad.subImage)};
	layer.views[1] = layer.views[0];
	const auto isExtent = [](float size) { return size > 0 && size < farthest; };
	const bool hasArea = isExtent(quad.size.width) && isExtent(quad.size.height);
	if (pose && hasArea) submission.layers[submission.layerCount++] = layer;
}

ipc::SubImage FrameSubmission::subImage(const XrSwapchainSubImage &given)
{
	Swapchain &swapchain = handles.at<Swapchain>(given.swapchain);
	if (&swapchain.session != &session_) throw Error(XR_ERROR_VALIDATION_FAILURE, "a layer's swapchain belongs to another session");
	const gpu::ImageSpec &spec = swapchain.spec();
	const auto &[offset, extent] = given.imageRect;
	const bool fits = offset.x >= 0 && offset.y >= 0 && extent.width > 0 && extent.height > 0 &&
					  int64_t(offset.x) + extent.width <= int64_t(spec.width) && int64_t(offset.y) + extent.height <= int64_t(spec.height);
	if (!fits)
		throw Error(XR_ERROR_SWAPCHAIN_RECT_INVALID, "the rectangle {}x{} at ({}, {}) does not lie in the image of {}x{}", extent.width,
					extent.height, offset.x, offset.y, spec.width, spec.height);
	if (given.imageArrayIndex >= spec.arrayLayers)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "imageArrayIndex {} is not below {}", given.imageArrayIndex, spec.arrayLayers);
	if (swapchain.isCube() || gpu::isDepth(VkFormat(spec.format)))
		throw Error(XR_ERROR_LAYER_INVALID, "a cube or depth image cannot be shown as a flat one");
	const auto newest = swapchain.newestImage();
	if (!newest) throw Error(XR_ERROR_LAYER_INVALID, "a layer shows a swapchain of which no image was released");
	uses_.push_back({&swapchain, newest->image});
	return {.swapchain = swapchain.id(),
			.image = newest->image,
			.arrayIndex = given.imageArrayIndex,
			.x = offset.x,
			.y = offset.y,
			.width = extent.width,
			.height = extent.height,
			.release = newest->release};
}

} // namespace arift::openxr
