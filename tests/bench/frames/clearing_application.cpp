// An OpenXR application that does nothing but clear, with the number of its frame in the middle:   clearing_application CONTENT QUADS
// CONTENT: transparent (transparent black), translucent or opaque. QUADS: quad layers more, 0.2 m wide, 1 m ahead.
#include "samples/hologram_cube/vulkan_for_xr.h" // first: with OpenXR's functions

#include "tests/bench/frames/frame_code.h"
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace
{

using namespace arift::bench;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

constexpr uint32_t width = 1122, height = 1553, eyes = 2, quadSize = 256;

/// Linear, premultiplied.
vk::ClearColorValue colourOf(std::string_view content)
{
	if (content == "transparent") return vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 0.0f});
	if (content == "translucent") return vk::ClearColorValue(std::array{0.05f, 0.1f, 0.2f, 0.5f});
	if (content == "opaque") return vk::ClearColorValue(std::array{0.05f, 0.1f, 0.2f, 1.0f});
	throw std::runtime_error("content must be transparent, translucent or opaque, not " + std::string(content));
}

Instance createInstance()
{
	const char *const extension = XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME;
	XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
	std::strcpy(info.applicationInfo.applicationName, "clearing_application");
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

/// Host memory with the picture of every frame's code, one after another: nothing is painted while frames are counted.
struct CodePictures {
	static constexpr vk::DeviceSize each = vk::DeviceSize(codeWidth) * codeHeight * 4;
	explicit CodePictures(const Vulkan &vulkan)
		: buffer(vulkan.device, {.size = each << codeBits, .usage = vk::BufferUsageFlagBits::eTransferSrc}), memory(allocate(vulkan))
	{
		buffer.bindMemory(*memory, 0);
		auto *texel = static_cast<uint32_t *>(memory.mapMemory(0, VK_WHOLE_SIZE));
		for (uint32_t number = 0; number < 1u << codeBits; ++number)
			for (uint32_t y = 0; y < codeHeight; ++y)
				for (uint32_t x = 0; x < codeWidth; ++x) *texel++ = codeCellIsWhite(x / codeCell, number) ? 0xFFFFFFFF : 0xFF000000;
		memory.unmapMemory();
	}
	vk::raii::Buffer buffer;
	vk::raii::DeviceMemory memory;

private:
	vk::raii::DeviceMemory allocate(const Vulkan &vulkan) const
	{
		const auto needs = buffer.getMemoryRequirements();
		const auto properties = vulkan.physicalDevice.getMemoryProperties();
		constexpr auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
		for (uint32_t type = 0; type < properties.memoryTypeCount; ++type)
			if (needs.memoryTypeBits >> type & 1 && (properties.memoryTypes[type].propertyFlags & wanted) == wanted)
				return {vulkan.device, {.allocationSize = needs.size, .memoryTypeIndex = type}};
		throw std::runtime_error("the device has no memory that the CPU can write");
	}
};

/// A swapchain and its images.
struct Images {
	Images(XrSession session, uint32_t imageWidth, uint32_t imageHeight, uint32_t layers) : layerCount(layers)
	{
		XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
		info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
		info.format = VK_FORMAT_R8G8B8A8_SRGB;
		info.sampleCount = info.faceCount = info.mipCount = 1;
		info.width = imageWidth;
		info.height = imageHeight;
		info.arraySize = layers;
		check(xrCreateSwapchain(session, &info, &swapchain.value), "xrCreateSwapchain");
		images = enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
						   [&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *all) {
							   return xrEnumerateSwapchainImages(swapchain, capacity, count,
																 reinterpret_cast<XrSwapchainImageBaseHeader *>(all));
						   });
	}
	VkImage acquire() const
	{
		uint32_t index = 0;
		check(xrAcquireSwapchainImage(swapchain, nullptr, &index), "xrAcquireSwapchainImage");
		const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
		check(xrWaitSwapchainImage(swapchain, &wait), "xrWaitSwapchainImage");
		return images[index].image;
	}
	void release() const { check(xrReleaseSwapchainImage(swapchain, nullptr), "xrReleaseSwapchainImage"); }
	Swapchain swapchain;
	uint32_t layerCount;
	std::vector<XrSwapchainImageVulkan2KHR> images;
};

class Application
{
public:
	Application(std::string_view content, uint32_t quads)
		: instance_(createInstance()),
		  system_(findSystem(instance_)),
		  vulkan_(instance_, system_),
		  session_(createSession()),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  head_(createSpace(XR_REFERENCE_SPACE_TYPE_VIEW)),
		  views_(session_, width, height, eyes),
		  quadImages_(session_, quadSize, quadSize, 1),
		  colour_(colourOf(content)),
		  quads_(quads),
		  codes_(vulkan_),
		  queue_(vulkan_.device, vulkan_.queueFamily, 0),
		  pool_(vulkan_.device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = 4}),
		  fences_{vk::raii::Fence(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled}),
				  vk::raii::Fence(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled})}
	{
	}

	/// Until the runtime ends it.
	void run()
	{
		while (handleEvents())
			if (running_) showFrame();
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
	Space createSpace(XrReferenceSpaceType type)
	{
		const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, {{0, 0, 0, 1}, {0, 0, 0}}};
		Space space;
		check(xrCreateReferenceSpace(session_, &info, &space.value), "xrCreateReferenceSpace");
		return space;
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
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		const size_t slot = frame_ % 2;
		if (vulkan_.device.waitForFences(*fences_[slot], true, UINT64_MAX) != vk::Result::eSuccess)
			throw std::runtime_error("the application's own work does not end");
		vulkan_.device.resetFences(*fences_[slot]);
		const vk::raii::CommandBuffer &commands = commands_[slot];
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		clear(commands, views_.acquire(), colour_, true);
		if (quads_ > 0) clear(commands, quadImages_.acquire(), vk::ClearColorValue(std::array{0.3f, 0.1f, 0.05f, 0.7f}), false);
		commands.end();
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands}, *fences_[slot]);
		views_.release();
		if (quads_ > 0) quadImages_.release();
		end(state.predictedDisplayTime);
		++frame_;
	}
	void clear(const vk::raii::CommandBuffer &commands, vk::Image image, const vk::ClearColorValue &colour, bool coded) const
	{
		const vk::ImageSubresourceRange whole{
			.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = VK_REMAINING_ARRAY_LAYERS};
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
		change(Layout::eColorAttachmentOptimal, Layout::eTransferDstOptimal);
		commands.clearColorImage(image, Layout::eTransferDstOptimal, colour, whole);
		if (coded) {
			change(Layout::eTransferDstOptimal, Layout::eTransferDstOptimal);
			const vk::BufferImageCopy strip{.bufferOffset = CodePictures::each * (frame_ % (1u << codeBits)),
											.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
											.imageOffset = {int32_t(width - codeWidth) / 2, int32_t(height - codeHeight) / 2, 0},
											.imageExtent = {codeWidth, codeHeight, 1}};
			commands.copyBufferToImage(*codes_.buffer, image, Layout::eTransferDstOptimal, strip);
		}
		change(Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
	}

	void end(XrTime displayTime)
	{
		const XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, displayTime, space_};
		XrViewState viewState{XR_TYPE_VIEW_STATE};
		std::array<XrView, eyes> located{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
		uint32_t count = 0;
		check(xrLocateViews(session_, &where, &viewState, eyes, &count, located.data()), "xrLocateViews");
		std::array<XrCompositionLayerProjectionView, eyes> shown;
		for (uint32_t eye = 0; eye < eyes; ++eye) {
			shown[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
			shown[eye].pose = located[eye].pose;
			shown[eye].fov = located[eye].fov;
			shown[eye].subImage = {views_.swapchain, {{0, 0}, {int32_t(width), int32_t(height)}}, eye};
		}
		XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
		projection.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
		projection.space = space_;
		projection.viewCount = eyes;
		projection.views = shown.data();
		std::vector<XrCompositionLayerQuad> quads(quads_, {XR_TYPE_COMPOSITION_LAYER_QUAD});
		std::vector<const XrCompositionLayerBaseHeader *> layers{reinterpret_cast<const XrCompositionLayerBaseHeader *>(&projection)};
		for (uint32_t i = 0; i < quads_; ++i) {
			quads[i].layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
			quads[i].space = head_;
			quads[i].subImage = {quadImages_.swapchain, {{0, 0}, {int32_t(quadSize), int32_t(quadSize)}}, 0};
			quads[i].pose = {{0, 0, 0, 1}, {0.25f * float(i % 4) - 0.375f, 0.3f - 0.25f * float(i / 4), -1}};
			quads[i].size = {0.2f, 0.2f};
			layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quads[i]));
		}
		XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
		info.displayTime = displayTime;
		info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		info.layerCount = uint32_t(layers.size());
		info.layers = layers.data();
		check(xrEndFrame(session_, &info), "xrEndFrame");
	}

	Instance instance_;
	XrSystemId system_;
	Vulkan vulkan_;
	Session session_;
	Space space_, head_;
	Images views_, quadImages_;
	vk::ClearColorValue colour_;
	uint32_t quads_;
	CodePictures codes_;
	vk::raii::Queue queue_;
	vk::raii::CommandPool pool_;
	vk::raii::CommandBuffers commands_;
	std::array<vk::raii::Fence, 2> fences_;
	uint32_t frame_ = 0;
	bool running_ = false;
};

} // namespace

int main(int count, char **arguments)
{
	if (count != 3) {
		std::fprintf(stderr, "usage: clearing_application CONTENT QUADS\n");
		return 2;
	}
	try {
		Application(arguments[1], uint32_t(std::atol(arguments[2]))).run();
		return 0;
	} catch (const std::exception &problem) {
		std::fprintf(stderr, "clearing_application: %s\n", problem.what());
		return 1;
	}
}
