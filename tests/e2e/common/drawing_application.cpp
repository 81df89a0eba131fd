#include "tests/e2e/common/drawing_application.h"
#include <cstring>

namespace arift::e2e
{
namespace
{

Instance createInstance(const std::string &name, std::vector<const char *> extensions)
{
	extensions.push_back(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	name.copy(info.applicationInfo.applicationName, XR_MAX_APPLICATION_NAME_SIZE - 1);
	info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
	info.enabledExtensionCount = uint32_t(extensions.size());
	info.enabledExtensionNames = extensions.data();
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

Session createSession(XrInstance instance, XrSystemId system, const Vulkan &vulkan)
{
	const XrGraphicsBindingVulkan2KHR binding{
		XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, nullptr, *vulkan.instance, *vulkan.physicalDevice, *vulkan.device, vulkan.queueFamily, 0};
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, system};
	Session session;
	check(xrCreateSession(instance, &info, &session.value), "xrCreateSession");
	return session;
}

Swapchain createSwapchain(XrSession session, VkExtent2D size, uint32_t arrayLayers, VkFormat format)
{
	XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
	info.usageFlags = (isDepth(format) ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT) |
					  XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
	info.format = format;
	info.sampleCount = info.faceCount = info.mipCount = 1;
	info.width = size.width;
	info.height = size.height;
	info.arraySize = arrayLayers;
	Swapchain swapchain;
	check(xrCreateSwapchain(session, &info, &swapchain.value), "xrCreateSwapchain");
	return swapchain;
}

} // namespace

bool isDepth(VkFormat format) { return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT; }

DrawnImages::DrawnImages(XrSession session, VkExtent2D extent, uint32_t arrayLayers, VkFormat wanted)
	: size(extent),
	  format(wanted),
	  swapchain_(createSwapchain(session, extent, arrayLayers, wanted)),
	  images_(enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
						[&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *images) {
							return xrEnumerateSwapchainImages(swapchain_, capacity, count,
															  reinterpret_cast<XrSwapchainImageBaseHeader *>(images));
						}))
{
}

uint32_t DrawnImages::acquire() const
{
	uint32_t index = 0;
	check(xrAcquireSwapchainImage(swapchain_, nullptr, &index), "xrAcquireSwapchainImage");
	const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
	check(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
	return index;
}

void DrawnImages::release() const { check(xrReleaseSwapchainImage(swapchain_, nullptr), "xrReleaseSwapchainImage"); }

XrSwapchainSubImage DrawnImages::all(uint32_t arrayLayer) const
{
	return {swapchain_, {{0, 0}, {int32_t(size.width), int32_t(size.height)}}, arrayLayer};
}

void recordFill(const vk::raii::CommandBuffer &commands, VkImage image, VkFormat format, const std::array<float, 4> &colour, int times)
{
	using Layout = vk::ImageLayout;
	using Aspect = vk::ImageAspectFlagBits;
	const bool hasStencil = format >= VK_FORMAT_D16_UNORM_S8_UINT && isDepth(format);
	const vk::ImageAspectFlags aspect = !isDepth(format) ? Aspect::eColor : hasStencil ? Aspect::eDepth | Aspect::eStencil : Aspect::eDepth;
	const vk::ImageSubresourceRange whole{.aspectMask = aspect, .levelCount = 1, .layerCount = VK_REMAINING_ARRAY_LAYERS};
	const auto change = [&](Layout from, Layout to) {
		commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, {}, {},
								 vk::ImageMemoryBarrier{.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
														.dstAccessMask = vk::AccessFlagBits::eMemoryWrite,
														.oldLayout = from,
														.newLayout = to,
														.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
														.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
														.image = image,
														.subresourceRange = whole});
	};
	const Layout boundary = isDepth(format) ? Layout::eDepthStencilAttachmentOptimal : Layout::eColorAttachmentOptimal;
	change(boundary, Layout::eTransferDstOptimal);
	for (int i = 0; i < times; ++i) {
		if (isDepth(format))
			commands.clearDepthStencilImage(image, Layout::eTransferDstOptimal, vk::ClearDepthStencilValue{.depth = colour[0]}, whole);
		else
			commands.clearColorImage(image, Layout::eTransferDstOptimal, vk::ClearColorValue(colour), whole);
	}
	change(Layout::eTransferDstOptimal, boundary);
}

DrawingApplication::DrawingApplication(const std::string &name, std::vector<const char *> extensions)
	: instance_(createInstance(name, std::move(extensions))),
	  system_(findSystem(instance_)),
	  vulkan_(instance_, system_),
	  session_(createSession(instance_, system_, vulkan_)),
	  queue_(vulkan_.device, vulkan_.queueFamily, 0)
{
}

void DrawingApplication::run(const volatile int &leave)
{
	for (;;) {
		handleEvents(leave);
		if (life_ == Life::over || (life_ == Life::waiting && leave)) break;
		if (life_ == Life::running || life_ == Life::leaving) frame();
	}
	vulkan_.device.waitIdle();
}

void DrawingApplication::handleEvents(bool leave)
{
	if (leave && life_ == Life::running && XR_SUCCEEDED(xrRequestExitSession(session_))) life_ = Life::leaving;
	XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
	XrResult result;
	while ((result = xrPollEvent(instance_, &event)) == XR_SUCCESS) {
		if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
			follow(reinterpret_cast<const XrEventDataSessionStateChanged &>(event).state);
		event = {XR_TYPE_EVENT_DATA_BUFFER};
	}
	check(result, "xrPollEvent");
}

void DrawingApplication::follow(XrSessionState state)
{
	if (state == XR_SESSION_STATE_READY) {
		const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
		check(xrBeginSession(session_, &info), "xrBeginSession");
		life_ = Life::running;
	} else if (state == XR_SESSION_STATE_STOPPING) {
		life_ = Life::waiting;
		check(xrEndSession(session_), "xrEndSession");
	} else if (state == XR_SESSION_STATE_EXITING || state == XR_SESSION_STATE_LOSS_PENDING) {
		life_ = Life::over;
	}
}

Space DrawingApplication::createSpace(XrReferenceSpaceType type) const
{
	const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, {{0, 0, 0, 1}, {0, 0, 0}}};
	Space space;
	check(xrCreateReferenceSpace(session_, &info, &space.value), "xrCreateReferenceSpace");
	return space;
}

std::vector<int64_t> DrawingApplication::formats() const
{
	return enumerate("xrEnumerateSwapchainFormats", int64_t(0), [&](uint32_t capacity, uint32_t *count, int64_t *list) {
		return xrEnumerateSwapchainFormats(session_, capacity, count, list);
	});
}

bool DrawingApplication::locate(XrTime time, XrSpace space, std::array<XrView, 2> &views) const
{
	const XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, time, space};
	XrViewState state{XR_TYPE_VIEW_STATE};
	views.fill({XR_TYPE_VIEW});
	uint32_t count = 0;
	check(xrLocateViews(session_, &where, &state, uint32_t(views.size()), &count, views.data()), "xrLocateViews");
	return count == views.size() && (state.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT);
}

void DrawingApplication::endFrame(XrTime time, const std::vector<const XrCompositionLayerBaseHeader *> &layers,
								  XrEnvironmentBlendMode mode) const
{
	XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
	info.displayTime = time;
	info.environmentBlendMode = mode;
	info.layerCount = uint32_t(layers.size());
	info.layers = layers.data();
	check(xrEndFrame(session_, &info), "xrEndFrame");
}

ProjectionLayer::ProjectionLayer(XrSpace space, const std::array<XrView, 2> &views, const std::array<XrSwapchainSubImage, 2> &images,
								 XrCompositionLayerFlags flags)
{
	for (size_t eye = 0; eye < views_.size(); ++eye) {
		views_[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
		views_[eye].pose = views[eye].pose;
		views_[eye].fov = views[eye].fov;
		views_[eye].subImage = images[eye];
	}
	layer_.layerFlags = flags;
	layer_.space = space;
	layer_.viewCount = uint32_t(views_.size());
	layer_.views = views_.data();
}

} // namespace arift::e2e
