#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace arift::gpu
{
namespace
{

TEST(Device, comesUpAndSaysWhoItIs)
{
	Device device;
	EXPECT_FALSE(device.identity().name.empty());
	EXPECT_NE(device.identity().driverUuid, (std::array<uint8_t, 16>{}));
	EXPECT_EQ(device.validationMessages(), 0u);
}

TEST(Device, twoOfTheSameGpuHaveTheSameIdentity)
{
	Device first, second;
	EXPECT_EQ(first.identity().deviceUuid, second.identity().deviceUuid);
	EXPECT_EQ(first.identity().driverUuid, second.identity().driverUuid);
}

TEST(Device, aMisuseIsCounted)
{
	Device device;
	const auto &gpu = device.handles();
	if (!gpu.messenger) GTEST_SKIP() << "needs ARIFT_VULKAN_VALIDATION=1";
	const vk::raii::CommandPool pool(gpu.device, {{}, gpu.queueFamily});
	const vk::raii::CommandBuffers commands(gpu.device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
	commands[0].begin(vk::CommandBufferBeginInfo{});
	commands[0].setLineWidth(-1); // wide lines are not enabled
	commands[0].end();
	EXPECT_GT(device.validationMessages(), 0u);
}

TEST(SwapchainFormats, beginWithEncodedColourAndHoldADepthFormat)
{
	Device device;
	const auto formats = swapchainFormats(device);
	ASSERT_GE(formats.size(), 4u);
	EXPECT_EQ(formats[0], VK_FORMAT_R8G8B8A8_SRGB);
	EXPECT_TRUE(std::any_of(formats.begin(), formats.end(), [](int64_t format) { return isDepth(VkFormat(format)); }));
	for (const int64_t format : formats) {
		const VkImageUsageFlags usage =
			isDepth(VkFormat(format)) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
		const SharedImage image(device, {.format = int32_t(format), .usage = usage, .width = 33, .height = 17});
		EXPECT_TRUE(image.exportMemory());
	}
	EXPECT_EQ(device.validationMessages(), 0u);
}

} // namespace
} // namespace arift::gpu
