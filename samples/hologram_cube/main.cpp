// A hologram in about 300 lines: a chequered cube stands still in the room, wherever the head turns.
//
// This page is the whole of what an augmented-reality application says to an OpenXR runtime, in the order in which it says it; copy it.
// It uses OpenXR 1.0 and XR_KHR_vulkan_enable2 and runs on every runtime that has them. What is not about augmented reality lies beside it:
// xr_helpers.h (errors, handles), vulkan_for_xr.h (a Vulkan device through the runtime), cube_renderer.cpp (how a cube is drawn).
#include "cube_renderer.h"
#include "vulkan_for_xr.h"
#include "xr_helpers.h"
#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{

// ---- Mathematics: OpenXR poses and fields of view as GLM matrices

glm::mat4 matrixOf(const XrPosef &pose)
{
	const auto &[q, p] = pose;
	return glm::translate(glm::mat4(1), {p.x, p.y, p.z}) * glm::mat4_cast(glm::quat(q.w, q.x, q.y, q.z));
}

/// OpenXR's view looks along -z with y up; Vulkan's clip space has y down, hence bottom and top change places.
glm::mat4 projectionOf(const XrFovf &fov)
{
	constexpr float nearZ = 0.05f, farZ = 50;
	return glm::frustumRH_ZO(nearZ * std::tan(fov.angleLeft), nearZ * std::tan(fov.angleRight), nearZ * std::tan(fov.angleUp),
							 nearZ * std::tan(fov.angleDown), nearZ, farZ);
}

/// A quarter of a metre, a little below the eyes and 1.2 m ahead of where the user looked at the start, slightly turned.
glm::mat4 cubeInRoom()
{
	const glm::mat4 place = glm::translate(glm::mat4(1), {0, -0.1f, -1.2f});
	const glm::mat4 turned = glm::rotate(glm::rotate(place, glm::radians(20.f), {1, 0, 0}), glm::radians(35.f), {0, 1, 0});
	return glm::scale(turned, glm::vec3(0.25f));
}

// ---- 1. The instance: the connection to the runtime. 2. The system: the headset.

Instance createInstance()
{
	const char *extensions[] = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	std::strcpy(info.applicationInfo.applicationName, "hologram_cube");
	info.applicationInfo.applicationVersion = 1;
	info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
	info.enabledExtensionCount = std::size(extensions);
	info.enabledExtensionNames = extensions;
	Instance instance;
	check(xrCreateInstance(&info, &instance.value), "xrCreateInstance");
	return instance;
}

XrSystemId getSystem(XrInstance instance)
{
	const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
	XrSystemId system = XR_NULL_SYSTEM_ID;
	check(xrGetSystem(instance, &info, &system), "xrGetSystem");
	return system;
}

/// What lies behind the user's holograms. With ALPHA_BLEND the runtime shows the world where our alpha is 0; a see-through display ADDs
/// our light to the world; with OPAQUE there is no world, and the cube stands in the dark.
XrEnvironmentBlendMode chooseBlendMode(XrInstance instance, XrSystemId system)
{
	const auto modes = enumerate("xrEnumerateEnvironmentBlendModes", XrEnvironmentBlendMode{}, [&](auto... a) {
		return xrEnumerateEnvironmentBlendModes(instance, system, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, a...);
	});
	for (const XrEnvironmentBlendMode wanted : {XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE})
		if (std::ranges::find(modes, wanted) != modes.end()) return wanted;
	return XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
}

// ---- 3. Vulkan: created through the runtime (vulkan_for_xr.h), which says which GPU the headset is on.
//         4. The session, the room's space and a swapchain for each eye

Session createSession(XrInstance instance, XrSystemId system, const Vulkan &vulkan)
{
	const XrGraphicsBindingVulkan2KHR binding{
		XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, nullptr, *vulkan.instance, *vulkan.physicalDevice, *vulkan.device, vulkan.queueFamily, 0};
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, system};
	Session session;
	check(xrCreateSession(instance, &info, &session.value), "xrCreateSession");
	return session;
}

/// LOCAL: level, its origin where the user's head was, -z ahead. What is placed in it stays where it is in the room.
Space createRoom(XrSession session)
{
	const XrReferenceSpaceCreateInfo info{
		XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_LOCAL, {{0, 0, 0, 1}, {0, 0, 0}}};
	Space space;
	check(xrCreateReferenceSpace(session, &info, &space.value), "xrCreateReferenceSpace");
	return space;
}

/// An sRGB format if there is one, so that the shader may write linear light; else what the runtime likes best.
int64_t chooseFormat(XrSession session)
{
	const auto formats =
		enumerate("xrEnumerateSwapchainFormats", int64_t{}, [&](auto... a) { return xrEnumerateSwapchainFormats(session, a...); });
	for (const int64_t wanted : {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB})
		if (std::ranges::find(formats, wanted) != formats.end()) return wanted;
	if (formats.empty()) throw std::runtime_error("the runtime offers no swapchain format");
	return formats.front();
}

struct Eye {
	Swapchain swapchain;
	XrExtent2Di size;
};

Eye createEye(XrSession session, int64_t format, const XrViewConfigurationView &view, CubeRenderer &renderer)
{
	XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
	info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
	info.format = format;
	info.width = view.recommendedImageRectWidth;
	info.height = view.recommendedImageRectHeight;
	info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
	Eye eye{.size = {int32_t(info.width), int32_t(info.height)}};
	check(xrCreateSwapchain(session, &info, &eye.swapchain.value), "xrCreateSwapchain");
	const auto images = enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
								  [&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *data) {
									  return xrEnumerateSwapchainImages(eye.swapchain, capacity, count,
																		reinterpret_cast<XrSwapchainImageBaseHeader *>(data));
								  });
	std::vector<VkImage> vulkanImages;
	for (const auto &image : images) vulkanImages.push_back(image.image);
	renderer.addView(vulkanImages, {info.width, info.height});
	return eye;
}

// ---- 5. The frame loop

volatile std::sig_atomic_t interrupted = 0;

class Hologram
{
public:
	Hologram() : renderer_(vulkan_.physicalDevice, vulkan_.device, vulkan_.queueFamily, vk::Format(format_))
	{
		const auto views =
			enumerate("xrEnumerateViewConfigurationViews", XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW}, [&](auto... a) {
				return xrEnumerateViewConfigurationViews(instance_, system_, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, a...);
			});
		for (const XrViewConfigurationView &view : views) eyes_.push_back(createEye(session_, format_, view, renderer_));
	}

	/// Until the runtime ends the session, a signal comes, or the time is up.
	void run(std::optional<double> seconds)
	{
		const auto start = std::chrono::steady_clock::now();
		while (!finished_) {
			const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
			if (interrupted || (seconds && elapsed.count() >= *seconds)) leave();
			pollEvents();
			if (running_)
				frame();
			else if (!finished_) // xrWaitFrame paces a running session; until there is one, look for events now and then
				std::this_thread::sleep_for(std::chrono::milliseconds(10));
		}
		std::printf("hologram_cube: %llu frames\n", static_cast<unsigned long long>(frames_));
	}

private:
	/// Asks the runtime to end the session in good order: STOPPING and EXITING follow as events.
	void leave()
	{
		if (!running_) finished_ = true;
		if (running_ && !leaving_) check(xrRequestExitSession(session_), "xrRequestExitSession");
		leaving_ = true;
	}

	void pollEvents()
	{
		XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
		for (; xrPollEvent(instance_, &event) == XR_SUCCESS; event = {XR_TYPE_EVENT_DATA_BUFFER}) {
			if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) finished_ = true;
			if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
				changeState(reinterpret_cast<const XrEventDataSessionStateChanged &>(event).state);
		}
	}

	void changeState(XrSessionState state)
	{
		if (state == XR_SESSION_STATE_READY) {
			const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
			check(xrBeginSession(session_, &info), "xrBeginSession");
			running_ = true;
		} else if (state == XR_SESSION_STATE_STOPPING) {
			running_ = false;
			check(xrEndSession(session_), "xrEndSession");
		} else if (state == XR_SESSION_STATE_EXITING || state == XR_SESSION_STATE_LOSS_PENDING) {
			running_ = false;
			finished_ = true;
		}
	}

	void frame()
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame"); // sleeps until it is time to draw
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");

		std::vector<XrCompositionLayerProjectionView> views;
		if (state.shouldRender) views = drawViews(state.predictedDisplayTime);

		XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
		layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT; // our alpha counts; colours are premultiplied
		layer.space = room_;
		layer.viewCount = uint32_t(views.size());
		layer.views = views.data();
		const auto *header = reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer);

		XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO};
		end.displayTime = state.predictedDisplayTime;
		end.environmentBlendMode = blendMode_;
		end.layerCount = views.empty() ? 0 : 1;
		end.layers = &header;
		check(xrEndFrame(session_, &end), "xrEndFrame");
		++frames_;
	}

	/// Draws every eye's image for the time at which it will be seen. Empty while the runtime does not know where the head is.
	std::vector<XrCompositionLayerProjectionView> drawViews(XrTime displayTime)
	{
		const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, displayTime, room_};
		XrViewState viewState{XR_TYPE_VIEW_STATE};
		std::vector<XrView> located(eyes_.size(), {XR_TYPE_VIEW});
		uint32_t count = 0;
		check(xrLocateViews(session_, &info, &viewState, uint32_t(located.size()), &count, located.data()), "xrLocateViews");
		constexpr XrViewStateFlags valid = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
		if ((viewState.viewStateFlags & valid) != valid) return {};

		std::vector<XrCompositionLayerProjectionView> submitted;
		std::vector<CubeRenderer::View> drawn;
		for (size_t i = 0; i < eyes_.size(); ++i) {
			uint32_t image = 0;
			check(xrAcquireSwapchainImage(eyes_[i].swapchain, nullptr, &image), "xrAcquireSwapchainImage");
			const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
			check(xrWaitSwapchainImage(eyes_[i].swapchain, &wait), "xrWaitSwapchainImage");
			drawn.push_back({image, projectionOf(located[i].fov) * glm::inverse(matrixOf(located[i].pose))});
			submitted.push_back({XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
								 nullptr,
								 located[i].pose,
								 located[i].fov,
								 {eyes_[i].swapchain, {{0, 0}, eyes_[i].size}, 0}});
		}
		renderer_.draw(drawn, cubeInRoom());
		for (const Eye &eye : eyes_) check(xrReleaseSwapchainImage(eye.swapchain, nullptr), "xrReleaseSwapchainImage");
		return submitted;
	}

	// Declared parents first: destroyed in reverse order, the renderer before the images that it draws into.
	Instance instance_ = createInstance();
	XrSystemId system_ = getSystem(instance_);
	XrEnvironmentBlendMode blendMode_ = chooseBlendMode(instance_, system_);
	Vulkan vulkan_{instance_, system_};
	Session session_ = createSession(instance_, system_, vulkan_);
	Space room_ = createRoom(session_);
	int64_t format_ = chooseFormat(session_);
	std::vector<Eye> eyes_;
	CubeRenderer renderer_;

	bool running_ = false, leaving_ = false, finished_ = false;
	uint64_t frames_ = 0;
};

/// Nothing means: for ever. Throws with one sentence where the arguments make no sense.
std::optional<double> parseSeconds(int argc, char **argv)
{
	if (argc == 1) return {};
	double seconds = 0;
	const char *end = argv[argc - 1] + std::strlen(argv[argc - 1]);
	if (argc == 3 && std::string_view(argv[1]) == "--seconds")
		if (const auto [rest, error] = std::from_chars(argv[2], end, seconds); error == std::errc() && rest == end && seconds >= 0)
			return seconds;
	throw std::invalid_argument("expected no argument, --help or --seconds N with N >= 0");
}

} // namespace

int main(int argc, char **argv)
try {
	if (argc == 2 && std::string_view(argv[1]) == "--help") {
		std::puts("usage: hologram_cube [--seconds N]\n"
				  "Shows a chequered cube of 25 cm that stands still 1.2 m ahead of where you look at the start, on whatever the headset\n"
				  "shows of the room. Ends after N seconds, on Ctrl-C, or when the OpenXR runtime ends the session.\n"
				  "XR_RUNTIME_JSON chooses the OpenXR runtime.");
		return 0;
	}
	const std::optional<double> seconds = parseSeconds(argc, argv);
	for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
	Hologram().run(seconds);
	return 0;
} catch (const std::exception &error) {
	std::fprintf(stderr, "hologram_cube: %s\n", error.what());
	return 1;
}
