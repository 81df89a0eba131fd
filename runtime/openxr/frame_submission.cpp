#include "runtime/openxr/frame_submission.h"
#include "runtime/openxr/ext/fb_composition_layer_alpha_blend.h"
#include "runtime/openxr/ext/fb_composition_layer_depth_test.h"
#include "runtime/openxr/ext/fb_composition_layer_settings.h"
#include "runtime/openxr/ext/fb_passthrough.h"
#include "runtime/openxr/ext/khr_composition_layer_color_scale_bias.h"
#include "runtime/openxr/ext/khr_composition_layer_cube.h"
#include "runtime/openxr/ext/khr_composition_layer_cylinder.h"
#include "runtime/openxr/ext/khr_composition_layer_depth.h"
#include "runtime/openxr/ext/khr_composition_layer_equirect.h"
#include "runtime/openxr/ext/khr_composition_layer_equirect2.h"
#include "runtime/openxr/ext/varjo_composition_layer_depth_test.h"
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
	const auto has = [this](Extension extension) { return session_.instance.has(extension); };
	if (has(Extension::FB_composition_layer_settings)) requireLayerSettings(header->next);
	switch (header->type) {
	case XR_TYPE_COMPOSITION_LAYER_PROJECTION: return addProjection(reinterpret_cast<const XrCompositionLayerProjection &>(*header));
	case XR_TYPE_COMPOSITION_LAYER_QUAD: return addQuad(reinterpret_cast<const XrCompositionLayerQuad &>(*header));
	case XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR:
		if (!has(Extension::KHR_composition_layer_cylinder)) break;
		return addCurved(reinterpret_cast<const XrCompositionLayerCylinderKHR &>(*header), ipc::LayerType::cylinder, "a cylinder layer");
	case XR_TYPE_COMPOSITION_LAYER_EQUIRECT_KHR:
		if (!has(Extension::KHR_composition_layer_equirect)) break;
		return addCurved(reinterpret_cast<const XrCompositionLayerEquirectKHR &>(*header), ipc::LayerType::equirect, "an equirect layer");
	case XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR:
		if (!has(Extension::KHR_composition_layer_equirect2)) break;
		return addCurved(reinterpret_cast<const XrCompositionLayerEquirect2KHR &>(*header), ipc::LayerType::equirect, "an equirect layer");
	case XR_TYPE_COMPOSITION_LAYER_CUBE_KHR:
		if (!has(Extension::KHR_composition_layer_cube)) break;
		return addCube(reinterpret_cast<const XrCompositionLayerCubeKHR &>(*header));
	case XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB:
		if (!has(Extension::FB_passthrough)) break;
		return addPassthrough(reinterpret_cast<const XrCompositionLayerPassthroughFB &>(*header));
	default: break;
	}
	throw Error(XR_ERROR_LAYER_INVALID, "layers of XrStructureType {} are not supported, or not enabled", int(header->type));
}

ipc::Layer FrameSubmission::layerWith(const void *next) const
{
	const Instance &instance = session_.instance;
	ipc::Layer layer;
	if (instance.has(Extension::KHR_composition_layer_color_scale_bias)) applyColorScaleBias(layer, next);
	if (instance.has(Extension::FB_composition_layer_alpha_blend)) applyBlendFactors(layer, next);
	if (instance.has(Extension::FB_composition_layer_depth_test)) applyDepthTest(layer, next);
	return layer;
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
	ipc::Layer layer = layerWith(projection.next);
	layer.type = ipc::LayerType::projection;
	layer.flags = requireFlags(projection.layerFlags);
	if (projection.viewCount != 2 || !projection.views)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a projection layer has {} views instead of 2", projection.viewCount);
	const bool rangesCount = session_.instance.has(Extension::VARJO_composition_layer_depth_test);
	bool isPlaced = true, haveRange = rangesCount;
	for (size_t eye = 0; eye < 2; ++eye) {
		const XrCompositionLayerProjectionView &view = projection.views[eye];
		requireType(&view);
		requireFov(view.fov);
		const auto pose = place(layer, projection.space, view.pose, "a projection layer's view");
		isPlaced = isPlaced && pose;
		layer.views[eye] = {pose.value_or(identityPose), view.fov, subImage(view.subImage, gpu::ImageKind::flat)};
		addDepth(layer.views[eye], view.next);
		// The specification's text asks for it in the views' chains, its registry in the layer's.
		if (rangesCount)
			haveRange =
				(setDepthTestRange(layer.views[eye], view.next) || setDepthTestRange(layer.views[eye], projection.next)) && haveRange;
	}
	if (haveRange && !layer.depthTest.given) layer.depthTest = depthTestInRange;
	if (!haveRange)
		for (ipc::LayerView &view : layer.views) view.depth.testedFrom = view.depth.testedTo = 0;
	// What has no depth is not tested for it.
	if (layer.views[0].depth.image.swapchain == 0 || layer.views[1].depth.image.swapchain == 0) layer.depthTest = {};
	if (isPlaced) submission.layers[submission.layerCount++] = layer;
}

void FrameSubmission::addDepth(ipc::LayerView &view, const void *next)
{
	if (!session_.instance.has(Extension::KHR_composition_layer_depth)) return;
	const auto *info = findInChain<XrCompositionLayerDepthInfoKHR>(next);
	if (!info) return;
	ipc::ViewDepth depth = depthOf(*info);
	depth.image = subImage(info->subImage, gpu::ImageKind::depth);
	if (session_.sharing().how == ipc::Sharing::copies && !session_.graphics()->copiesDepth()) return;
	if (std::abs(depth.inverseBias) < farthest && std::abs(depth.inverseScale) < farthest) view.depth = depth;
}

void FrameSubmission::addPassthrough(const XrCompositionLayerPassthroughFB &passthrough)
{
	const PassthroughLayer &object = handles.at<PassthroughLayer>(passthrough.layerHandle);
	if (&object.session != &session_) throw Error(XR_ERROR_VALIDATION_FAILURE, "a passthrough layer belongs to another session");
	ipc::Layer layer;
	layer.type = ipc::LayerType::passthrough;
	layer.flags = requireFlags(passthrough.flags);
	layer.passthrough = object.number();
	submission.layers[submission.layerCount++] = layer;
}

void FrameSubmission::addQuad(const XrCompositionLayerQuad &quad)
{
	ipc::Layer layer = layerWith(quad.next);
	layer.type = ipc::LayerType::quad;
	if (!std::isfinite(quad.size.width) || !std::isfinite(quad.size.height))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a quad layer has the size {} x {} m", quad.size.width, quad.size.height);
	const auto isExtent = [](float size) { return size > 0 && size < farthest; };
	layer.width = quad.size.width;
	layer.height = quad.size.height;
	addPlaced(layer, {"a quad layer", quad.layerFlags, quad.eyeVisibility, quad.space, quad.pose, quad.subImage},
			  isExtent(quad.size.width) && isExtent(quad.size.height));
}

template <typename Layer> void FrameSubmission::addCurved(const Layer &curved, ipc::LayerType type, const char *what)
{
	ipc::Layer layer = layerWith(curved.next);
	layer.type = type;
	const auto surface = surfaceOf(curved);
	layer.curved = surface.value_or(ipc::CurvedSurface{});
	addPlaced(layer, {what, curved.layerFlags, curved.eyeVisibility, curved.space, curved.pose, curved.subImage}, surface.has_value());
}

void FrameSubmission::addCube(const XrCompositionLayerCubeKHR &cube)
{
	ipc::Layer layer = layerWith(cube.next);
	layer.type = ipc::LayerType::cube;
	const Swapchain &swapchain = handles.at<Swapchain>(cube.swapchain);
	addPlaced(layer,
			  {"a cube layer",
			   cube.layerFlags,
			   cube.eyeVisibility,
			   cube.space,
			   {cube.orientation, {0, 0, 0}},
			   wholeFaceOf(cube, swapchain),
			   gpu::ImageKind::cube},
			  true);
}

void FrameSubmission::addPlaced(ipc::Layer layer, const Place &given, bool hasExtent)
{
	layer.flags = requireFlags(given.flags);
	layer.eyes = eyesOf(given.eyes);
	const auto pose = place(layer, given.space, given.pose, given.what);
	layer.views[0] = {pose.value_or(identityPose), {}, subImage(given.image, given.kind)};
	layer.views[1] = layer.views[0];
	if (pose && hasExtent) submission.layers[submission.layerCount++] = layer;
}

ipc::SubImage FrameSubmission::subImage(const XrSwapchainSubImage &given, gpu::ImageKind kind)
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
	if (given.imageArrayIndex >= gpu::arraySize(spec))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "imageArrayIndex {} is not below {}", given.imageArrayIndex, gpu::arraySize(spec));
	if (swapchain.isCube() != (kind == gpu::ImageKind::cube))
		throw Error(XR_ERROR_LAYER_INVALID, "a cube is shown by cube layers, which show nothing else: the swapchain has {} array layers",
					spec.arrayLayers);
	if (gpu::isDepth(VkFormat(spec.format)) != (kind == gpu::ImageKind::depth))
		throw Error(XR_ERROR_LAYER_INVALID, "depth is no colour and colour no depth: the swapchain has VkFormat {}", spec.format);
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
