// Sessions that draw: swapchains in shared memory, frames with layers, validation layers silent on the application's side.
#include "tests/openxr/vulkan_session.h"
#include <numbers>

namespace arift
{
namespace
{

TEST_F(VulkanSession, AFrameReachesTheServiceWhenItIsFinished)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	service.send({.type = ipc::EventType::visibilityChanged, .session = 1, .visible = 1, .focused = 1});
	const XrSwapchain chain = swapchain();
	EXPECT_EQ(imagesOf(chain).size(), 3u);
	const XrSpace stage = application.space(session, XR_REFERENCE_SPACE_TYPE_STAGE),
				  view = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, -2}});
	const Projection projection(chain, stage);
	const XrCompositionLayerQuad quad{
		XR_TYPE_COMPOSITION_LAYER_QUAD, nullptr,      0, view, XR_EYE_VISIBILITY_RIGHT, {chain, {{8, 4}, {16, 12}}, 1},
		{{0, 0, 0, 1}, {0.25f, 0, 0}},  {0.5f, 0.25f}};
	uint32_t shown = 0;
	for (uint64_t frame = 1; frame <= 7; ++frame) {
		const XrTime time = beginFrame();
		shown = draw(chain);
		ASSERT_EQ(application.endFrame(session, time, {projection.header(), reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quad)},
									   XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND),
				  XR_SUCCESS);
		const auto record = service.waitFor([&](const auto &r) { return r.submissions.size() == frame; });
		const ipc::Submission &submission = record.submissions.back();
		EXPECT_EQ(record.waits.back(), frame - 1) << "the service is told how many submissions to expect";
		EXPECT_EQ(submission.frame, frame);
		EXPECT_EQ(submission.displayTime, time);
		EXPECT_EQ(submission.blendMode, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
		ASSERT_EQ(submission.layerCount, 2u);
		EXPECT_EQ(submission.layers[0].type, ipc::LayerType::projection);
		EXPECT_EQ(submission.layers[0].frame, ipc::LayerFrame::origin);
		EXPECT_EQ(submission.layers[0].flags, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT);
		EXPECT_FLOAT_EQ(submission.layers[0].views[1].pose.position.y, -1.6f) << "the stage lies on the floor";
		EXPECT_FLOAT_EQ(submission.layers[0].views[1].pose.position.x, 1);
		EXPECT_EQ(submission.layers[0].views[1].image.image, shown);
		EXPECT_EQ(submission.layers[0].views[1].image.arrayIndex, 1u);
		EXPECT_EQ(submission.layers[1].frame, ipc::LayerFrame::head);
		EXPECT_EQ(submission.layers[1].eyes, 2u);
		EXPECT_FLOAT_EQ(submission.layers[1].views[0].pose.position.z, -2);
		EXPECT_EQ(submission.layers[1].views[0].image.x, 8);
		EXPECT_FLOAT_EQ(submission.layers[1].height, 0.25f);
	}
	EXPECT_EQ(application.states().back(), XR_SESSION_STATE_FOCUSED);
	XrFrameState state;
	ASSERT_EQ(application.wait(session, state), XR_SUCCESS);
	EXPECT_TRUE(state.shouldRender);
}

TEST_F(VulkanSession, EndFrameChecksEverythingAndChangesNothing)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const XrSwapchain chain = swapchain();
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrTime time = beginFrame();
	const Projection good(chain, local);
	EXPECT_EQ(application.endFrame(session, time, {good.header()}), XR_ERROR_LAYER_INVALID) << "no image is released yet";
	draw(chain);
	const auto resultOf = [&](auto change) {
		Projection bad(chain, local);
		change(bad);
		return application.endFrame(session, time, {bad.header()});
	};
	EXPECT_EQ(application.endFrame(session, time, {nullptr}), XR_ERROR_LAYER_INVALID);
	EXPECT_EQ(application.endFrame(session, time, std::vector(ipc::maxLayers + 1, good.header())), XR_ERROR_LAYER_LIMIT_EXCEEDED);
	EXPECT_EQ(resultOf([](Projection &p) { p.layer.type = XR_TYPE_COMPOSITION_LAYER_CUBE_KHR; }), XR_ERROR_LAYER_INVALID);
	EXPECT_EQ(resultOf([](Projection &p) { p.layer.layerFlags = 0x100; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](Projection &p) { p.layer.viewCount = 1; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](Projection &p) { p.layer.space = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf([](Projection &p) { p.views[1].pose.orientation.w = 2; }), XR_ERROR_POSE_INVALID);
	EXPECT_EQ(resultOf([](Projection &p) { p.views[0].fov.angleUp = NAN; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](Projection &p) { p.views[0].fov.angleUp = 1.6f; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](Projection &p) { p.views[0].subImage.swapchain = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID);
	EXPECT_EQ(resultOf([](Projection &p) { p.views[0].subImage.imageArrayIndex = 2; }), XR_ERROR_VALIDATION_FAILURE);
	for (const XrRect2Di rectangle :
		 {XrRect2Di{{-1, 0}, {10, 10}}, {{0, 0}, {0, 10}}, {{0, 0}, {-5, 10}}, {{60, 0}, {5, 5}}, {{0, INT32_MAX}, {5, INT32_MAX}}})
		EXPECT_EQ(resultOf([&](Projection &p) { p.views[1].subImage.imageRect = rectangle; }), XR_ERROR_SWAPCHAIN_RECT_INVALID);
	EXPECT_TRUE(service.record().submissions.empty());
	EXPECT_EQ(application.endFrame(session, time, {good.header()}), XR_SUCCESS) << "the frame is still begun";
}

TEST_F(VulkanSession, WaitingForAnImageIsBoundedAndTheShownOneIsGivenUp)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	service.setShowing(false); // the compositor holds on to everything
	service.client().oldestHeldFrame = 1;
	const XrSwapchain chain = swapchain();
	const Projection projection(chain, application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL));
	for (int i = 0; i < 3; ++i) {
		const XrTime time = beginFrame();
		draw(chain);
		ASSERT_EQ(application.endFrame(session, time, {projection.header()}), XR_SUCCESS);
	}
	service.waitFor([](const auto &r) { return r.submissions.size() == 3; });
	EXPECT_EQ(acquire(chain), 0u);
	EXPECT_EQ(wait(chain, 0), XR_TIMEOUT_EXPIRED);
	EXPECT_EQ(wait(chain, 40 * millisecond), XR_TIMEOUT_EXPIRED) << "others could be shown instead: nothing is given up";
	EXPECT_TRUE(service.record().relinquished.empty());
	EXPECT_EQ(release(chain), XR_ERROR_CALL_ORDER_INVALID);
	acquire(chain);
	acquire(chain);
	EXPECT_EQ(wait(chain, XR_INFINITE_DURATION), XR_SUCCESS);
	EXPECT_EQ(service.record().relinquished, (std::vector<uint64_t>{1}));
	EXPECT_EQ(release(chain), XR_SUCCESS);
}

TEST_F(VulkanSession, SwapchainsAreCheckedBeforeTheServiceIsAsked)
{
	XrSwapchain made = XR_NULL_HANDLE;
	const auto resultOf = [&](auto change) {
		XrSwapchainCreateInfo info = swapchainInfo();
		change(info);
		return create(info, made);
	};
	EXPECT_EQ(resultOf([](auto &info) { info.width = 0; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](auto &info) { info.faceCount = 2; }), XR_ERROR_VALIDATION_FAILURE);
	EXPECT_EQ(resultOf([](auto &info) { info.format = VK_FORMAT_R64_SFLOAT; }), XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
	EXPECT_EQ(resultOf([](auto &info) { info.width = 5000; }), XR_ERROR_FEATURE_UNSUPPORTED);
	EXPECT_EQ(resultOf([](auto &info) { info.createFlags = XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT; }), XR_ERROR_FEATURE_UNSUPPORTED);
	EXPECT_EQ(resultOf([](auto &info) { info.sampleCount = 4; }), XR_ERROR_FEATURE_UNSUPPORTED);
	EXPECT_TRUE(service.record().swapchains.empty());
	ASSERT_EQ(resultOf([](auto &info) { info.createFlags = XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT; }), XR_SUCCESS);
	EXPECT_EQ(imagesOf(made).size(), 1u);
	draw(made);
	uint32_t index = 0;
	EXPECT_EQ(get<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(made, nullptr, &index), XR_ERROR_CALL_ORDER_INVALID);
	EXPECT_EQ(get<PFN_xrDestroySwapchain>("xrDestroySwapchain")(made), XR_SUCCESS);
	EXPECT_EQ(service.record().swapchainsDestroyed, 1u);
	uint32_t count = 0;
	ASSERT_EQ(get<PFN_xrEnumerateSwapchainFormats>("xrEnumerateSwapchainFormats")(session, 0, &count, nullptr), XR_SUCCESS);
	std::vector<int64_t> formats(count);
	ASSERT_EQ(get<PFN_xrEnumerateSwapchainFormats>("xrEnumerateSwapchainFormats")(session, count, &count, formats.data()), XR_SUCCESS);
	EXPECT_EQ(formats[0], VK_FORMAT_R8G8B8A8_SRGB);
	EXPECT_EQ(formats, gpu::swapchainFormats(device)) << "what the service makes, no more and no less";
	for (const int64_t format : formats) {
		XrSwapchainCreateInfo info = swapchainInfo();
		info.format = format;
		info.usageFlags =
			gpu::isDepth(VkFormat(format)) ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
		EXPECT_EQ(create(info, made), XR_SUCCESS) << "VkFormat " << format;
		acquire(made);
		EXPECT_EQ(wait(made), XR_SUCCESS);
		EXPECT_EQ(release(made), XR_SUCCESS);
	}
}

TEST_F(VulkanSession, TheGraphicsBindingIsChecked)
{
	ASSERT_EQ(get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS);
	session = XR_NULL_HANDLE;
	const auto resultOf = [&](const void *next) {
		const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, next, 0, application.system()};
		return get<PFN_xrCreateSession>("xrCreateSession")(application.instance, &info, &session);
	};
	EXPECT_EQ(resultOf(nullptr), XR_ERROR_GRAPHICS_DEVICE_INVALID) << "headless was not enabled";
	auto binding = vulkan->binding;
	binding.device = VK_NULL_HANDLE;
	EXPECT_EQ(resultOf(&binding), XR_ERROR_GRAPHICS_DEVICE_INVALID);
	binding = vulkan->binding;
	binding.queueFamilyIndex = 1000;
	EXPECT_EQ(resultOf(&binding), XR_ERROR_GRAPHICS_DEVICE_INVALID);
	EXPECT_EQ(resultOf(&vulkan->binding), XR_SUCCESS);
}

TEST_F(VulkanSession, TheFirstVulkanExtensionListsOnlyWhatIsThere)
{
	const Application other({"XR_KHR_vulkan_enable"});
	const XrSystemId system = other.system();
	for (const char *name : {"xrGetVulkanInstanceExtensionsKHR", "xrGetVulkanDeviceExtensionsKHR"}) {
		const auto function = other.get<PFN_xrGetVulkanDeviceExtensionsKHR>(name);
		uint32_t count = 0;
		ASSERT_EQ(function(other.instance, system, 0, &count, nullptr), XR_SUCCESS);
		std::string text(count, 'x');
		ASSERT_EQ(function(other.instance, system, count, &count, text.data()), XR_SUCCESS);
		EXPECT_EQ(text.back(), '\0');
		EXPECT_NE(text.find("VK_KHR_"), text.npos) << text;
		EXPECT_EQ(text.find("semaphore"), text.npos) << "not on every device, and not needed";
	}
	const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &vulkan->binding, 0, system};
	XrSession none = XR_NULL_HANDLE;
	EXPECT_EQ(other.get<PFN_xrCreateSession>("xrCreateSession")(other.instance, &info, &none), XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
}

} // namespace
} // namespace arift
