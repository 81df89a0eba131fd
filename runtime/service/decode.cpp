#include "runtime/service/decode.h"
#include "runtime/base/pose.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace arift
{

namespace
{

template <typename M> M exactly(const ipc::Received &received)
{
	if (const auto message = received.as<M>()) return *message;
	throw Malformed("message {} has {} bytes, expected {}", uint32_t(M::type), received.size, sizeof(M));
}

void require(bool fulfilled, const char *what)
{
	if (!fulfilled) throw Malformed("{}", what);
}

/// Of another protocol only what tells so is taken: the rest may have any size and meaning.
ipc::Hello decodeHello(const ipc::Received &received)
{
	constexpr size_t fixed = offsetof(ipc::Hello, role);
	require(received.size >= fixed, "hello is too short");
	ipc::Hello hello;
	std::memcpy(static_cast<void *>(&hello), received.bytes.data(), fixed);
	require(hello.magic == ipc::magic, "hello without the magic number");
	if (hello.protocol == ipc::protocol) hello = exactly<ipc::Hello>(received);
	require(hello.role <= ipc::Role::monitor, "hello of an unknown role");
	return hello;
}
void check(const ipc::CreateSession &message)
{
	require(message.headless <= 1 && message.overlay <= 1 && message.hasDepth <= 1, "session with what is neither yes nor no");
}
void check(const ipc::DestroySession &) {}
void check(const ipc::SessionRunning &message) { require(message.running <= 1, "session running: neither begin nor end"); }
void check(const ipc::CreateSwapchain &message)
{
	const gpu::ImageSpec &spec = message.spec;
	require(message.imageCount >= 1 && message.imageCount <= ipc::maxImages, "swapchain: number of images out of range");
	require(spec.width >= 1 && spec.width <= Quota::extent && spec.height >= 1 && spec.height <= Quota::extent,
			"swapchain: extent out of range");
	require(spec.arrayLayers >= 1 && spec.arrayLayers <= ipc::maxArrayLayers, "swapchain: number of array layers out of range");
	require(spec.mipLevels >= 1 && spec.mipLevels <= uint32_t(std::bit_width(std::max(spec.width, spec.height))),
			"swapchain: number of mip levels out of range");
	require(spec.samples >= 1 && spec.samples <= 16 && (spec.samples & (spec.samples - 1)) == 0, "swapchain: sample count out of range");
	require(spec.inRows <= 1, "swapchain: neither in rows nor otherwise");
	require(message.sharing <= ipc::Sharing::copies, "swapchain: neither shared nor copied");
}
void check(const ipc::DestroySwapchain &) {}
bool isShare(float value) { return value >= 0 && value <= 1; }
void check(const ipc::ShowPassthrough &message)
{
	require(message.layer <= ipc::everyPassthroughLayer && message.shown <= 1, "passthrough: layer or state out of range");
}
void check(const ipc::StylePassthrough &message)
{
	require(message.layer < ipc::maxPassthroughLayers && message.mapped <= 1, "passthrough style: layer or map out of range");
	for (const float share : {message.opacity, message.edge.r, message.edge.g, message.edge.b, message.edge.a})
		require(isShare(share), "passthrough style: opacity or edge out of range");
	require(std::abs(message.brightness) <= 100, "passthrough style: brightness out of range");
	for (const float factor : {message.contrast, message.saturation})
		require(factor >= 0 && factor <= 1e6f, "passthrough style: contrast or saturation out of range");
}
void check(const ipc::ForcePassthrough &message)
{
	require(message.mode <= ipc::Forced::underlay, "passthrough of an unknown kind");
	for (const float share :
		 {message.tolerance, message.softness, message.opacity, message.colour[0], message.colour[1], message.colour[2]})
		require(isShare(share), "passthrough: a number out of range");
}
void check(const ipc::GetStatus &message) { require(message.resetFigures <= 1, "status: reset is neither yes nor no"); }
void check(const ipc::Screenshot &message) { require(message.kind <= ipc::PictureKind::eyes, "screenshot of an unknown kind"); }
void check(const ipc::SetSetting &message)
{
	require(message.setting <= ipc::Setting::rawPassthrough, "unknown setting");
	require(std::isfinite(message.value), "setting is not a number");
}
void check(const ipc::Recenter &) {}
void check(const ipc::Vibrate &message)
{
	require(message.motors <= 3, "vibration of unknown motors");
	require(message.amplitude >= 0 && message.amplitude <= 1, "vibration's amplitude out of range");
}
void check(const ipc::ShutDown &) {}

template <typename M> M checked(const ipc::Received &received)
{
	const M message = exactly<M>(received);
	check(message);
	return message;
}

void checkImage(const ipc::SubImage &image, gpu::ImageKind kind, const FindSwapchain &find)
{
	const auto shape = find(image.swapchain);
	require(shape.has_value(), "layer names an unknown swapchain");
	require(shape->kind == kind, "layer names a swapchain of another kind");
	require(image.image < shape->imageCount, "layer names an image its swapchain has not");
	require(image.arrayIndex < shape->arraySize, "layer names an array layer its swapchain has not");
	require(image.x >= 0 && image.y >= 0 && image.width > 0 && image.height > 0, "layer rectangle is empty or begins outside");
	// 64-bit sums: two large positive numbers must not wrap round to a small one.
	require(int64_t(image.x) + image.width <= int64_t(shape->width) && int64_t(image.y) + image.height <= int64_t(shape->height),
			"layer rectangle reaches beyond its image");
}

bool isWithin(float number, float most) { return std::isfinite(number) && std::abs(number) <= most; }
constexpr float farthest = 1e6f;

/// OpenXR 1.1, XrFovf: angles of a half space each; a view without extent shows nothing and divides by nothing.
void checkFov(const XrFovf &fov)
{
	constexpr float limit = float(std::numbers::pi / 2);
	for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown})
		require(std::isfinite(angle) && std::abs(angle) < limit, "layer field of view out of range");
	require(fov.angleLeft != fov.angleRight && fov.angleUp != fov.angleDown, "layer field of view is empty");
}

void checkPose(const XrPosef &pose)
{
	require(isValidPose(pose), "layer pose is invalid");
	require(std::abs(pose.position.x) < farthest && std::abs(pose.position.y) < farthest && std::abs(pose.position.z) < farthest,
			"layer pose is too far away");
}

void checkView(const ipc::LayerView &view, const FindSwapchain &find)
{
	checkPose(view.pose);
	checkFov(view.fov);
	checkImage(view.image, gpu::ImageKind::flat, find);
	const ipc::ViewDepth &depth = view.depth;
	if (depth.image.swapchain == 0) return;
	checkImage(depth.image, gpu::ImageKind::depth, find);
	require(isWithin(depth.inverseBias, farthest) && isWithin(depth.inverseScale, farthest), "layer depth out of range");
	require(depth.testedFrom >= 0 && depth.testedTo >= 0 && isWithin(depth.testedFrom, farthest) && isWithin(depth.testedTo, farthest),
			"layer depth test out of range");
}

void checkCurved(const ipc::CurvedSurface &surface)
{
	require(surface.radius >= 0 && isWithin(surface.radius, farthest), "layer radius out of range");
	for (const float number : {surface.uvAhead.x, surface.uvAhead.y, surface.uvPerUnit.x, surface.uvPerUnit.y})
		require(isWithin(number, farthest), "layer texture coordinates out of range");
}

/// How a layer of any kind is combined with those below it.
void checkBlending(const ipc::Layer &layer)
{
	for (const XrColor4f &color : {layer.colorScale, layer.colorBias})
		for (const float number : {color.r, color.g, color.b, color.a}) require(isWithin(number, farthest), "layer color out of range");
	const ipc::BlendFactors &blend = layer.blend;
	for (const uint32_t factor : {blend.sourceColor, blend.destinationColor, blend.sourceAlpha, blend.destinationAlpha})
		require(factor <= XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB, "layer with an unknown blend factor");
	const ipc::DepthTest &test = layer.depthTest;
	require(blend.given <= 1 && test.given <= 1 && test.writes <= 1, "layer with what is neither yes nor no");
	require(test.compareOp <= 7, "layer with an unknown depth test");
}

void checkLayer(const ipc::Layer &layer, const FindSwapchain &find)
{
	require(layer.type <= ipc::LayerType::passthrough, "layer of an unknown type");
	require(layer.frame <= ipc::LayerFrame::head, "layer in an unknown frame");
	require(layer.eyes <= 3, "layer for unknown eyes");
	if (layer.type == ipc::LayerType::passthrough)
		return require(layer.passthrough < ipc::maxPassthroughLayers, "layer names a passthrough layer that cannot be");
	checkBlending(layer);
	if (layer.type == ipc::LayerType::projection) {
		for (const ipc::LayerView &view : layer.views) checkView(view, find);
		return;
	}
	checkPose(layer.views[0].pose);
	const bool cube = layer.type == ipc::LayerType::cube;
	checkImage(layer.views[0].image, cube ? gpu::ImageKind::cube : gpu::ImageKind::flat, find);
	if (layer.type != ipc::LayerType::quad) return checkCurved(layer.curved);
	for (const float extent : {layer.width, layer.height})
		require(std::isfinite(extent) && extent >= 0 && extent < farthest, "quad extent out of range");
}

ipc::Submission decodeSubmission(const ipc::Received &received, const FindSwapchain &find)
{
	constexpr size_t fixed = offsetof(ipc::Submission, layers);
	require(received.size >= fixed, "submission is too short");
	ipc::Submission submission;
	std::memcpy(static_cast<void *>(&submission), received.bytes.data(), fixed);
	require(submission.layerCount <= ipc::maxLayers, "submission has too many layers");
	require(received.size == ipc::wireSize(submission), "submission is not as long as its layers");
	std::memcpy(static_cast<void *>(submission.layers.data()), received.bytes.data() + fixed, submission.layerCount * sizeof(ipc::Layer));
	require(submission.blendMode >= XR_ENVIRONMENT_BLEND_MODE_OPAQUE && submission.blendMode <= XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
			"submission with an unknown blend mode");
	require(submission.rowsGoUp <= 1, "submission of images whose rows go neither up nor down");
	for (uint32_t i = 0; i < submission.layerCount; ++i) checkLayer(submission.layers[i], find);
	return submission;
}

ipc::Header headerOf(const ipc::Received &received)
{
	const auto header = received.header();
	require(header.has_value(), "message is shorter than a header");
	return *header;
}

} // namespace

Request decodeRequest(const ipc::Received &received)
{
	using enum ipc::MessageType;
	switch (headerOf(received).type) {
	case hello: return decodeHello(received);
	case createSession: return checked<ipc::CreateSession>(received);
	case destroySession: return checked<ipc::DestroySession>(received);
	case sessionRunning: return checked<ipc::SessionRunning>(received);
	case createSwapchain: return checked<ipc::CreateSwapchain>(received);
	case destroySwapchain: return checked<ipc::DestroySwapchain>(received);
	case showPassthrough: return checked<ipc::ShowPassthrough>(received);
	case stylePassthrough: return checked<ipc::StylePassthrough>(received);
	case getStatus: return checked<ipc::GetStatus>(received);
	case screenshot: return checked<ipc::Screenshot>(received);
	case setSetting: return checked<ipc::SetSetting>(received);
	case recenter: return checked<ipc::Recenter>(received);
	case shutDown: return checked<ipc::ShutDown>(received);
	case forcePassthrough: return checked<ipc::ForcePassthrough>(received);
	default: throw Malformed("message of unknown type {}", uint32_t(headerOf(received).type));
	}
}

FrameRequest decodeFrameRequest(const ipc::Received &received, const FindSwapchain &find)
{
	using enum ipc::MessageType;
	switch (headerOf(received).type) {
	case waitFrame: return exactly<ipc::WaitFrame>(received);
	case relinquish: return exactly<ipc::Relinquish>(received);
	case vibrate: return checked<ipc::Vibrate>(received);
	case submission: return decodeSubmission(received, find);
	default: throw Malformed("message of unknown type {} in the frame channel", uint32_t(headerOf(received).type));
	}
}

} // namespace arift
