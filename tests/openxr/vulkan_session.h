// A session that draws with Vulkan, the validation layer listening.
#pragma once
#include "tests/openxr/image_service.h"
#include "tests/openxr/vulkan_application.h"
#include <optional>

namespace arift
{

struct VulkanSession : testing::Test, ImageService {
	/// As ImageService.
	explicit VulkanSession(ipc::Sharing sharing = ipc::Sharing::memory, std::function<void(ipc::SessionCreated &)> probe = {},
						   std::vector<const char *> extensions = {})
		: ImageService(sharing, std::move(probe)),
		  vulkan(std::in_place, std::move(extensions)),
		  session(application.session(&vulkan->binding))
	{
	}

	std::optional<VulkanApplication> vulkan;
	Application &application = vulkan->application;
	XrSession session;

	template <typename Pfn> Pfn get(const char *name) const { return application.get<Pfn>(name); }

	XrSwapchainCreateInfo swapchainInfo() const
	{
		return {.type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
				.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT,
				.format = VK_FORMAT_R8G8B8A8_SRGB,
				.sampleCount = 1,
				.width = 64,
				.height = 48,
				.faceCount = 1,
				.arraySize = 2,
				.mipCount = 1};
	}
	XrResult create(const XrSwapchainCreateInfo &info, XrSwapchain &swapchain) const
	{
		return get<PFN_xrCreateSwapchain>("xrCreateSwapchain")(session, &info, &swapchain);
	}
	XrSwapchain swapchain() const
	{
		XrSwapchain made = XR_NULL_HANDLE;
		EXPECT_EQ(create(swapchainInfo(), made), XR_SUCCESS);
		return made;
	}
	std::vector<VkImage> imagesOf(XrSwapchain swapchain) const
	{
		uint32_t count = 0;
		std::vector<XrSwapchainImageVulkan2KHR> found(8, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
		EXPECT_EQ(get<PFN_xrEnumerateSwapchainImages>("xrEnumerateSwapchainImages")(
					  swapchain, 8, &count, reinterpret_cast<XrSwapchainImageBaseHeader *>(found.data())),
				  XR_SUCCESS);
		std::vector<VkImage> all;
		for (uint32_t i = 0; i < count; ++i) all.push_back(found[i].image);
		return all;
	}
	uint32_t acquire(XrSwapchain swapchain) const
	{
		uint32_t index = 99;
		EXPECT_EQ(get<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(swapchain, nullptr, &index), XR_SUCCESS);
		return index;
	}
	XrResult wait(XrSwapchain swapchain, XrDuration timeout = second) const
	{
		const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, timeout};
		return get<PFN_xrWaitSwapchainImage>("xrWaitSwapchainImage")(swapchain, &info);
	}
	XrResult release(XrSwapchain swapchain) const
	{
		return get<PFN_xrReleaseSwapchainImage>("xrReleaseSwapchainImage")(swapchain, nullptr);
	}
	/// Draws the next image of the swapchain.
	uint32_t draw(XrSwapchain swapchain, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB)
	{
		const uint32_t index = acquire(swapchain);
		EXPECT_EQ(wait(swapchain), XR_SUCCESS);
		vulkan->clear(imagesOf(swapchain)[index], 0.5f, format);
		EXPECT_EQ(release(swapchain), XR_SUCCESS);
		return index;
	}
	XrTime beginFrame() const
	{
		XrFrameState state;
		EXPECT_EQ(application.wait(session, state), XR_SUCCESS);
		EXPECT_EQ(application.beginFrame(session), XR_SUCCESS);
		return state.predictedDisplayTime;
	}
	~VulkanSession() override
	{
		// The specification's order: what draws goes before what it draws with.
		if (session) get<PFN_xrDestroySession>("xrDestroySession")(session);
		EXPECT_EQ(vulkan->complaints(), 0);
	}
};

struct Projection {
	XrCompositionLayerProjectionView views[2];
	XrCompositionLayerProjection layer;
	Projection(XrSwapchain swapchain, XrSpace space)
	{
		for (uint32_t eye = 0; eye < 2; ++eye)
			views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
						  nullptr,
						  {{0, 0, 0, 1}, {float(eye), 0, 0}},
						  {-0.8f, 0.7f, 0.6f, -0.5f},
						  {swapchain, {{0, 0}, {64, 48}}, eye}};
		layer = {XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT, space, 2, views};
	}
	const XrCompositionLayerBaseHeader *header() const { return reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer); }
};

} // namespace arift
