// A small OpenXR application that shows a transparent image, and stops where it is told to:   stopping_application POINT FRAMES
// It prints "stopped" and stops itself at the named point of the frame after FRAMES frames; at the point "never" it goes on for ever.
#include "samples/hologram_cube/vulkan_for_xr.h" // first: with OpenXR's functions

#include "runtime/ipc/messages.h"
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace
{

using arift::ipc::MessageType;

std::string_view stopPoint = "never";
std::atomic<bool> lastFrame = false;

void stopHere()
{
	if (::write(STDOUT_FILENO, "stopped\n", 8) == 8) ::raise(SIGSTOP);
}

void pass(std::string_view point)
{
	if (lastFrame && point == stopPoint) stopHere();
}

} // namespace

/// In the place of the C library's: the points inside the runtime's own calls are those where it is about to tell the service something.
extern "C" __attribute__((visibility("default"))) ssize_t sendmsg(int fd, const msghdr *message, int flags)
{
	MessageType type{};
	if (message->msg_iovlen == 1 && message->msg_iov[0].iov_len >= sizeof type)
		std::memcpy(&type, message->msg_iov[0].iov_base, sizeof type);
	if (type == MessageType::submission) pass("inside xrEndFrame");
	const ssize_t sent = ::syscall(SYS_sendmsg, fd, message, flags);
	if (type == MessageType::waitFrame) pass("inside xrWaitFrame");
	return sent;
}

namespace
{

constexpr uint32_t size = 256;

Instance createInstance()
{
	const char *const extension = XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME;
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	std::strcpy(info.applicationInfo.applicationName, "stopping_application");
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

class Application
{
public:
	Application()
		: instance_(createInstance()),
		  system_(findSystem(instance_)),
		  vulkan_(instance_, system_),
		  session_(createSession()),
		  space_(createSpace()),
		  swapchain_(createSwapchain()),
		  images_(enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
							[&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *images) {
								return xrEnumerateSwapchainImages(swapchain_, capacity, count,
																  reinterpret_cast<XrSwapchainImageBaseHeader *>(images));
							})),
		  queue_(vulkan_.device, vulkan_.queueFamily, 0),
		  pool_(vulkan_.device, {.queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = uint32_t(2 * images_.size())})
	{
		for (size_t image = 0; image < images_.size(); ++image) {
			record(commands_[2 * image], images_[image].image, 1);
			record(commands_[2 * image + 1], images_[image].image, 2000); // work that is not finished for a long time
		}
	}

	/// Until the runtime ends it.
	void run(long frames)
	{
		for (long frame = 0; handleEvents();) {
			if (!running_) continue;
			lastFrame = frame++ == frames;
			showFrame();
		}
	}

private:
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
	Space createSpace()
	{
		const XrReferenceSpaceCreateInfo info{
			XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_LOCAL, {{0, 0, 0, 1}, {0, 0, 0}}};
		Space space;
		check(xrCreateReferenceSpace(session_, &info, &space.value), "xrCreateReferenceSpace");
		return space;
	}
	Swapchain createSwapchain()
	{
		XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
		info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
		info.format = VK_FORMAT_R8G8B8A8_SRGB;
		info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
		info.width = info.height = size;
		Swapchain swapchain;
		check(xrCreateSwapchain(session_, &info, &swapchain.value), "xrCreateSwapchain");
		return swapchain;
	}

	static void record(const vk::raii::CommandBuffer &commands, vk::Image image, int times)
	{
		using Layout = vk::ImageLayout;
		using Stage = vk::PipelineStageFlagBits;
		const vk::ImageSubresourceRange whole{.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1};
		const auto change = [&](Layout from, Layout to) {
			commands.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands, {}, {}, {},
									 vk::ImageMemoryBarrier{.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
															.dstAccessMask = vk::AccessFlagBits::eMemoryWrite,
															.oldLayout = from,
															.newLayout = to,
															.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
															.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
															.image = image,
															.subresourceRange = whole});
		};
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eSimultaneousUse});
		change(Layout::eColorAttachmentOptimal, Layout::eTransferDstOptimal);
		for (int i = 0; i < times; ++i) commands.clearColorImage(image, Layout::eTransferDstOptimal, vk::ClearColorValue{}, whole);
		change(Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
		commands.end();
	}

	/// False when the session is over.
	bool handleEvents()
	{
		XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
		while (xrPollEvent(instance_, &event) == XR_SUCCESS) {
			if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
				const XrSessionState state = reinterpret_cast<const XrEventDataSessionStateChanged &>(event).state;
				if (state == XR_SESSION_STATE_READY) begin();
				if (state == XR_SESSION_STATE_STOPPING || state == XR_SESSION_STATE_LOSS_PENDING) return false;
			}
			event = {XR_TYPE_EVENT_DATA_BUFFER};
		}
		return true;
	}
	void begin()
	{
		const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
		check(xrBeginSession(session_, &info), "xrBeginSession");
		running_ = true;
	}

	void showFrame()
	{
		pass("before xrWaitFrame");
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		pass("after xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		pass("after xrBeginFrame");
		draw();
		end(state.predictedDisplayTime);
		pass("after xrEndFrame");
	}
	void draw()
	{
		uint32_t index = 0;
		check(xrAcquireSwapchainImage(swapchain_, nullptr, &index), "xrAcquireSwapchainImage");
		pass("image acquired");
		const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
		check(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
		pass("image waited for");
		const bool pending = lastFrame && (stopPoint == "work submitted" || stopPoint == "image released");
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands_[2 * index + (pending ? 1 : 0)]});
		pass("work submitted");
		check(xrReleaseSwapchainImage(swapchain_, nullptr), "xrReleaseSwapchainImage");
		pass("image released");
	}
	void end(XrTime displayTime)
	{
		const XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, displayTime, space_};
		XrViewState viewState{XR_TYPE_VIEW_STATE};
		std::array<XrView, 2> views{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
		uint32_t count = 0;
		check(xrLocateViews(session_, &where, &viewState, 2, &count, views.data()), "xrLocateViews");
		std::array<XrCompositionLayerProjectionView, 2> shown;
		for (size_t eye = 0; eye < 2; ++eye) {
			shown[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
			shown[eye].pose = views[eye].pose;
			shown[eye].fov = views[eye].fov;
			shown[eye].subImage = {swapchain_, {{0, 0}, {int32_t(size), int32_t(size)}}, 0};
		}
		XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
		layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		layer.space = space_;
		layer.viewCount = 2;
		layer.views = shown.data();
		const auto *const header = reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer);
		XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
		info.displayTime = displayTime;
		info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		info.layerCount = 1;
		info.layers = &header;
		check(xrEndFrame(session_, &info), "xrEndFrame");
	}

	Instance instance_;
	XrSystemId system_;
	Vulkan vulkan_;
	Session session_;
	Space space_;
	Swapchain swapchain_;
	std::vector<XrSwapchainImageVulkan2KHR> images_;
	vk::raii::Queue queue_;
	vk::raii::CommandPool pool_;
	vk::raii::CommandBuffers commands_;
	bool running_ = false;
};

} // namespace

int main(int count, char **arguments)
{
	if (count != 3) {
		std::fprintf(stderr, "usage: stopping_application POINT FRAMES\n");
		return 2;
	}
	stopPoint = arguments[1];
	try {
		Application().run(std::atol(arguments[2]));
		return 0;
	} catch (const std::exception &problem) {
		std::fprintf(stderr, "stopping_application: %s\n", problem.what());
		return 1;
	}
}
