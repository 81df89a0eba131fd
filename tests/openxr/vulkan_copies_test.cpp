// Sessions whose images cannot be shared: what is drawn comes to the service through a memfd, in every format, before the submission does.
#include "runtime/openxr/vulkan/vulkan_copied_images.h"
#include "tests/openxr/vulkan_session.h"
#include <bit>
#include <cstring>

namespace arift
{
namespace
{

struct CopyingSession : VulkanSession {
	CopyingSession() : VulkanSession(ipc::Sharing::copies) {}
};

template <typename T> T valueAt(const std::byte *at)
{
	T value;
	std::memcpy(&value, at, sizeof value);
	return value;
}

/// Of half-precision numbers that are neither denormal nor special.
float fromHalf(uint16_t half)
{
	if (half == 0) return 0;
	return std::bit_cast<float>(uint32_t(half & 0x8000) << 16 | (uint32_t(half >> 10 & 31) + 112) << 23 | uint32_t(half & 0x3FF) << 13);
}

struct Texel {
	double value = 0; ///< red (linear) or depth
	double alpha = 1;
};
double linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }
Texel texelAt(const std::byte *at, VkFormat format)
{
	const auto byte = [at](size_t i) { return valueAt<uint8_t>(at + i) / 255.0; };
	switch (format) {
	case VK_FORMAT_R8G8B8A8_SRGB: return {linear(byte(0)), byte(3)};
	case VK_FORMAT_B8G8R8A8_SRGB: return {linear(byte(2)), byte(3)};
	case VK_FORMAT_R8G8B8A8_UNORM: return {byte(0), byte(3)};
	case VK_FORMAT_B8G8R8A8_UNORM: return {byte(2), byte(3)};
	case VK_FORMAT_A2B10G10R10_UNORM_PACK32: return {(valueAt<uint32_t>(at) & 1023) / 1023.0, (valueAt<uint32_t>(at) >> 30) / 3.0};
	case VK_FORMAT_R16G16B16A16_SFLOAT: return {fromHalf(valueAt<uint16_t>(at)), fromHalf(valueAt<uint16_t>(at + 6))};
	case VK_FORMAT_R16G16B16A16_UNORM: return {valueAt<uint16_t>(at) / 65535.0, valueAt<uint16_t>(at + 6) / 65535.0};
	case VK_FORMAT_D16_UNORM: return {valueAt<uint16_t>(at) / 65535.0};
	case VK_FORMAT_D24_UNORM_S8_UINT: return {(valueAt<uint32_t>(at) & 0xFFFFFF) / 16777215.0};
	case VK_FORMAT_D32_SFLOAT:
	case VK_FORMAT_D32_SFLOAT_S8_UINT: return {valueAt<float>(at)};
	default: ADD_FAILURE() << "VkFormat " << format << " is not decoded here"; return {};
	}
}

TEST_F(CopyingSession, EveryFormatsTexelsAreThereWhenItsWorkIsDone)
{
	openxr::VulkanDevice drawing(openxr::VulkanInstanceApi(vulkan->getInstanceProcAddr(), vulkan->instance), vulkan->binding);
	size_t formats = 0;
	for (const int64_t offered : gpu::swapchainFormats(device)) {
		const auto format = VkFormat(offered);
		const gpu::ImageSpec spec{
			.format = int32_t(format), .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT, .width = 37, .height = 21, .arrayLayers = 2};
		const gpu::CopyLayout layout = gpu::copyLayoutOf(spec);
		const UniqueFd memory = ipc::makeSharedMemory("test", layout.size);
		const ipc::Mapping mapping = ipc::mapReadOnly(memory.get(), layout.size);
		std::array<UniqueFd, 1> sent{UniqueFd(::dup(memory.get()))};
		openxr::VulkanCopiedImages drawn(drawing, spec, {ipc::Sharing::copies, sent, layout.size, 0});
		XrSwapchainImageVulkanKHR image{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR};
		drawn.describe(std::array{reinterpret_cast<XrSwapchainImageBaseHeader *>(&image)});
		for (const float value : {0.25f, 0.5f}) { // the second time it has been the application's before
			drawn.takeOver(0);
			vulkan->clear(image.image, value, format);
			const auto work = drawn.handOver(0);
			ASSERT_EQ(work->wait(10 * second), openxr::Completion::Outcome::done);
			for (uint32_t layer = 0; layer < 2; ++layer)
				for (uint32_t texel = 0; texel < spec.width * spec.height; ++texel) {
					const auto *at =
						static_cast<const std::byte *>(mapping.address()) + layer * layout.layerPitch + texel * gpu::bytesPerTexel(format);
					const Texel found = texelAt(at, format);
					ASSERT_NEAR(found.value, value, 0.005) << "VkFormat " << format << ", layer " << layer << ", texel " << texel;
					ASSERT_EQ(found.alpha, 1) << "VkFormat " << format << ", layer " << layer << ", texel " << texel;
				}
		}
		++formats;
	}
	EXPECT_GE(formats, 10u) << "that this device can share";
}

TEST_F(CopyingSession, AnImageIsGivenOnceForEveryRelease)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrSwapchain chain = swapchain();
	const Projection projection(chain, local);
	std::vector<std::pair<uint32_t, uint32_t>> shown; ///< image, release
	for (uint64_t frame = 1; frame <= 8; ++frame) {
		const XrTime time = beginFrame();
		if (frame != 3) draw(chain); // the third shows what the second did
		ASSERT_EQ(application.endFrame(session, time, {projection.header()}), XR_SUCCESS);
		const auto record = service.waitFor([&](const auto &r) { return r.submissions.size() == frame; });
		const ipc::SubImage &image = record.submissions.back().layers[0].views[1].image;
		shown.emplace_back(image.image, image.release);
		const ipc::Mapping texels = ipc::mapReadOnly(copies[image.image].get(), 4);
		EXPECT_EQ(*static_cast<const uint8_t *>(texels.address()), 188) << "0.5, encoded: it is there when the submission is";
	}
	EXPECT_EQ(shown[2], shown[1]);
	EXPECT_EQ(shown[0].second, 1u);
	for (size_t i = 3; i < shown.size(); ++i)
		for (size_t before = 0; before < i; ++before) EXPECT_NE(shown[i], shown[before]) << "another content has another name";
}

/// The service says it is the same device, and the memory says it is not.
struct DisbelievingSession : VulkanSession {
	DisbelievingSession() : VulkanSession(ipc::Sharing::memory, [](ipc::SessionCreated &created) { created.probePattern[5] ^= 1; }) {}
};
struct BelievingSession : VulkanSession {
	BelievingSession() : VulkanSession(ipc::Sharing::memory, [](ipc::SessionCreated &) {}) {}
};

TEST_F(DisbelievingSession, AsksForCopiesWhereTheProbeReadsOtherwise)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const XrSwapchain chain = swapchain();
	EXPECT_EQ(service.record().swapchains.back().sharing, ipc::Sharing::copies);
	draw(chain);
}

TEST_F(BelievingSession, SharesWhereTheProbeReadsAsTheServiceSays)
{
	ASSERT_EQ(application.begin(session), XR_SUCCESS);
	const XrSwapchain chain = swapchain();
	EXPECT_EQ(service.record().swapchains.back().sharing, ipc::Sharing::memory);
	draw(chain);
}

} // namespace
} // namespace arift
