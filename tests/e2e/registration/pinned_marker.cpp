// A hologram application for measurements: blue discs at fixed places of LOCAL space, as any OpenXR application would draw them. It is told
// their places once, on its command line, and knows nothing of the runtime but OpenXR.
#include "marker_painter.h"
#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <span>

namespace
{

volatile std::sig_atomic_t leave = 0;

struct Options {
	std::vector<XrVector3f> places; ///< metres, in LOCAL space
	float radius = 0.02f;           ///< metres
};

float number(std::span<char *> arguments, size_t index)
{
	float value = 0;
	if (index >= arguments.size()) throw std::invalid_argument("a number is missing at the end of the command line");
	const std::string_view text = arguments[index];
	const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
	if (error != std::errc{} || end != text.data() + text.size()) throw std::invalid_argument(std::string(text) + " is no number");
	return value;
}

Options read(std::span<char *> arguments)
{
	Options options;
	for (size_t i = 1; i < arguments.size();) {
		const std::string_view name = arguments[i];
		if (name == "--position") {
			options.places.push_back({number(arguments, i + 1), number(arguments, i + 2), number(arguments, i + 3)});
			i += 4;
		} else if (name == "--radius") {
			options.radius = number(arguments, i + 1);
			i += 2;
		} else {
			throw std::invalid_argument(std::string(name) + " is unknown; usage: pinned_marker --position X Y Z ... [--radius METRES]");
		}
	}
	if (options.places.empty()) throw std::invalid_argument("usage: pinned_marker --position X Y Z ... [--radius METRES]");
	return options;
}

Instance createInstance()
{
	const char *const extension = XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME;
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	std::strcpy(info.applicationInfo.applicationName, "pinned_marker");
	info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
	info.enabledExtensionCount = 1;
	info.enabledExtensionNames = &extension;
	Instance instance;
	check(xrCreateInstance(&info, &instance.value), "xrCreateInstance");
	return instance;
}

XrSystemId findSystem(XrInstance instance)
{
	const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
	XrSystemId system = XR_NULL_SYSTEM_ID;
	check(xrGetSystem(instance, &info, &system), "xrGetSystem");
	return system;
}

XrVector3f turned(const XrQuaternionf &q, const XrVector3f &v)
{
	const auto cross = [](const XrVector3f &a, const XrVector3f &b) {
		return XrVector3f{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
	};
	const XrVector3f axis{q.x, q.y, q.z}, once = cross(axis, v), twice = cross(axis, once);
	return {v.x + 2 * (q.w * once.x + twice.x), v.y + 2 * (q.w * once.y + twice.y), v.z + 2 * (q.w * once.z + twice.z)};
}

XrVector3f inView(const XrPosef &view, const XrVector3f &point)
{
	const XrQuaternionf back{-view.orientation.x, -view.orientation.y, -view.orientation.z, view.orientation.w};
	return turned(back, {point.x - view.position.x, point.y - view.position.y, point.z - view.position.z});
}

/// Both eyes' images and the session that shows them.
class Application
{
public:
	explicit Application(const Options &options)
		: options_(options),
		  instance_(createInstance()),
		  system_(findSystem(instance_)),
		  vulkan_(instance_, system_),
		  session_(createSession()),
		  local_(createLocalSpace()),
		  configuration_(viewConfiguration()),
		  format_(chooseFormat()),
		  eyes_{createEye(), createEye()},
		  painter_(vulkan_, format_, {configuration_.recommendedImageRectWidth, configuration_.recommendedImageRectHeight})
	{
	}

	void run()
	{
		while (handleEvents())
			if (running_) frame();
	}

private:
	struct EyeImages {
		Swapchain swapchain;
		std::vector<XrSwapchainImageVulkan2KHR> images;
	};

	Session createSession()
	{
		const XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR,
												  nullptr,
												  *vulkan_.instance,
												  *vulkan_.physicalDevice,
												  *vulkan_.device,
												  vulkan_.queueFamily,
												  0};
		const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, system_};
		Session session;
		check(xrCreateSession(instance_, &info, &session.value), "xrCreateSession");
		return session;
	}
	Space createLocalSpace()
	{
		const XrReferenceSpaceCreateInfo info{
			XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_LOCAL, {{0, 0, 0, 1}, {0, 0, 0}}};
		Space space;
		check(xrCreateReferenceSpace(session_, &info, &space.value), "xrCreateReferenceSpace");
		return space;
	}
	XrViewConfigurationView viewConfiguration()
	{
		return enumerate("xrEnumerateViewConfigurationViews", XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW},
						 [&](uint32_t capacity, uint32_t *count, XrViewConfigurationView *views) {
							 return xrEnumerateViewConfigurationViews(instance_, system_, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
																	  capacity, count, views);
						 })
			.at(0);
	}
	vk::Format chooseFormat()
	{
		const auto formats = enumerate("xrEnumerateSwapchainFormats", int64_t(0), [&](uint32_t capacity, uint32_t *count, int64_t *list) {
			return xrEnumerateSwapchainFormats(session_, capacity, count, list);
		});
		for (const int64_t format : formats)
			if (format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB) return vk::Format(format);
		throw std::runtime_error("the runtime offers no 8-bit sRGB format");
	}
	Swapchain createSwapchain()
	{
		XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
		info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
		info.format = int64_t(format_);
		info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
		info.width = configuration_.recommendedImageRectWidth;
		info.height = configuration_.recommendedImageRectHeight;
		Swapchain swapchain;
		check(xrCreateSwapchain(session_, &info, &swapchain.value), "xrCreateSwapchain");
		return swapchain;
	}

	EyeImages createEye()
	{
		EyeImages eye{createSwapchain(), {}};
		eye.images = enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
							   [&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *images) {
								   return xrEnumerateSwapchainImages(eye.swapchain, capacity, count,
																	 reinterpret_cast<XrSwapchainImageBaseHeader *>(images));
							   });
		return eye;
	}

	/// False when the application is to end.
	bool handleEvents()
	{
		if (leave && running_ && !asked_) asked_ = XR_SUCCEEDED(xrRequestExitSession(session_));
		XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
		XrResult result;
		while ((result = xrPollEvent(instance_, &event)) == XR_SUCCESS) {
			if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
				follow(reinterpret_cast<const XrEventDataSessionStateChanged &>(event).state);
			event = {XR_TYPE_EVENT_DATA_BUFFER};
		}
		check(result, "xrPollEvent");
		return !over_ && !(leave && !running_);
	}
	void follow(XrSessionState state)
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
			over_ = true;
		}
	}

	void frame()
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		std::array<XrCompositionLayerProjectionView, 2> views;
		const bool drawn = state.shouldRender && draw(state.predictedDisplayTime, views);
		XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
		layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		layer.space = local_;
		layer.viewCount = 2;
		layer.views = views.data();
		const auto *const header = reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer);
		XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO};
		end.displayTime = state.predictedDisplayTime;
		end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		end.layerCount = drawn ? 1 : 0;
		end.layers = &header;
		check(xrEndFrame(session_, &end), "xrEndFrame");
	}
	bool draw(XrTime time, std::array<XrCompositionLayerProjectionView, 2> &layers)
	{
		const XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, time, local_};
		XrViewState state{XR_TYPE_VIEW_STATE};
		std::array<XrView, 2> views{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
		uint32_t count = 0;
		check(xrLocateViews(session_, &where, &state, 2, &count, views.data()), "xrLocateViews");
		if (count != 2 || !(state.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT)) return false;
		for (size_t eye = 0; eye < 2; ++eye) layers[eye] = drawEye(eyes_[eye], views[eye]);
		return true;
	}
	XrCompositionLayerProjectionView drawEye(const EyeImages &eye, const XrView &view)
	{
		uint32_t index = 0;
		check(xrAcquireSwapchainImage(eye.swapchain, nullptr, &index), "xrAcquireSwapchainImage");
		const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
		check(xrWaitSwapchainImage(eye.swapchain, &wait), "xrWaitSwapchainImage");
		std::vector<Disc> discs;
		for (const XrVector3f &place : options_.places) discs.push_back({inView(view.pose, place), options_.radius});
		painter_.paint(eye.images.at(index).image, view.fov, discs);
		check(xrReleaseSwapchainImage(eye.swapchain, nullptr), "xrReleaseSwapchainImage");
		XrCompositionLayerProjectionView layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
		layer.pose = view.pose;
		layer.fov = view.fov;
		layer.subImage.swapchain = eye.swapchain;
		layer.subImage.imageRect.extent = {int32_t(configuration_.recommendedImageRectWidth),
										   int32_t(configuration_.recommendedImageRectHeight)};
		return layer;
	}

	Options options_;
	Instance instance_;
	XrSystemId system_;
	Vulkan vulkan_;
	Session session_;
	Space local_;
	XrViewConfigurationView configuration_;
	vk::Format format_;
	std::array<EyeImages, 2> eyes_;
	MarkerPainter painter_;
	bool running_ = false, asked_ = false, over_ = false;
};

} // namespace

int main(int count, char **arguments)
{
	try {
		const Options options = read({arguments, size_t(count)});
		std::signal(SIGTERM, [](int) { leave = 1; });
		std::signal(SIGINT, [](int) { leave = 1; });
		Application(options).run();
		return 0;
	} catch (const std::exception &e) {
		std::fprintf(stderr, "pinned_marker: %s\n", e.what());
		return 1;
	}
}
