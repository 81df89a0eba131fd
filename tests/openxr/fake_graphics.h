// A session with graphics, made of the library's own classes, on a machine without any: images are numbers, and what the test says fails.
#pragma once
#include "runtime/openxr/space.h"
#include "runtime/openxr/swapchain.h"
#include "runtime/openxr/vulkan/vulkan_images.h"
#include "tests/openxr/fake_service.h"
#include <gtest/gtest.h>

namespace arift::openxr
{

/// What the application's GPU does; shared with everything that stands for it.
struct FakeDevice {
	std::atomic<bool> importFails{false}, submitFails{false};
	std::atomic<Completion::Outcome> outcome{Completion::Outcome::done}; ///< of all work
};

class FakeGraphics final : public Graphics
{
public:
	explicit FakeGraphics(const FakeDevice &device) : device_(device) {}
	std::array<uint8_t, 16> deviceUuid() const override { return {}; }
	std::array<uint8_t, 16> driverUuid() const override { return {}; }
	std::vector<int64_t> formatsOf(std::span<const int32_t> vulkan) const override { return {vulkan.begin(), vulkan.end()}; }
	gpu::ImageSpec specOf(const XrSwapchainCreateInfo &info, ipc::Sharing) const override
	{
		return {.format = int32_t(info.format),
				.createFlags = info.faceCount == 6 ? uint32_t(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0u,
				.width = info.width,
				.height = info.height,
				.arrayLayers = info.arraySize * info.faceCount,
				.mipLevels = info.mipCount};
	}
	std::unique_ptr<SwapchainImages> import(const gpu::ImageSpec &, const SharedMemory &memory) override
	{
		if (device_.importFails) throw Error(XR_ERROR_RUNTIME_FAILURE, "the test lets the import fail");
		return std::make_unique<Images>(device_, uint32_t(memory.fds.size()));
	}

private:
	struct Work final : Completion {
		explicit Work(const FakeDevice &on) : device(on) {}
		Outcome wait(XrDuration) const override { return device.outcome; }
		const FakeDevice &device;
	};
	struct Images final : SwapchainImages {
		Images(const FakeDevice &on, uint32_t count) : device(on)
		{
			for (uintptr_t i = 1; i <= count; ++i) images.push_back(reinterpret_cast<VkImage>(i)); // NOLINT(performance-no-int-to-ptr)
		}
		void describe(std::span<XrSwapchainImageBaseHeader *const> elements) const override { describeImages(elements, images); }
		void takeOver(uint32_t) override
		{
			if (device.submitFails) throw Error(XR_ERROR_RUNTIME_FAILURE, "the test lets the submission fail");
		}
		std::shared_ptr<Completion> handOver(uint32_t image) override
		{
			takeOver(image);
			return std::make_shared<Work>(device);
		}
		size_t elementSize() const override { return sizeof(XrSwapchainImageVulkanKHR); }
		const FakeDevice &device;
		std::vector<VkImage> images;
	};

	const FakeDevice &device_;
};

/// Handles as the application has them, objects as the library has them.
struct FakeSession : testing::Test {
	FakeDevice device;
	FakeService service{FakeService::usualWelcome(), [this](const ipc::CreateSwapchain &create, ipc::SwapchainCreated &) {
							std::vector<UniqueFd> images;
							for (uint32_t i = imagesMissing; i < create.imageCount; ++i) images.emplace_back(::dup(STDERR_FILENO));
							return images;
						}};
	std::atomic<uint32_t> imagesMissing{0}; ///< of those a swapchain is to have
	Instance &instance = handles.at<Instance>(
		handles.insert(std::make_unique<Instance>(InstanceOptions{XR_API_VERSION_1_1, {}, "test application", ""}), nullptr));

	~FakeSession() override { handles.destroy(instance); }

	/// A running session.
	Session &session() const
	{
		const XrSession handle =
			handles.insert(std::make_unique<Session>(instance, std::make_unique<FakeGraphics>(device), nullptr), &instance);
		Session &made = handles.at<Session>(handle);
		made.announce();
		made.begin(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
		return made;
	}
	static XrSwapchainCreateInfo swapchainInfo()
	{
		return {.type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
				.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT,
				.format = VK_FORMAT_R8G8B8A8_SRGB,
				.sampleCount = 1,
				.width = 64,
				.height = 48,
				.faceCount = 1,
				.arraySize = 1,
				.mipCount = 1};
	}
	static Swapchain &swapchain(Session &session)
	{
		return handles.at<Swapchain>(handles.insert(std::make_unique<Swapchain>(session, swapchainInfo()), &session));
	}
	static uint32_t draw(Swapchain &swapchain)
	{
		const uint32_t image = swapchain.acquire();
		EXPECT_TRUE(swapchain.wait(0));
		swapchain.release();
		return image;
	}
};

/// What a call of the library's own functions would return to an application.
template <typename Call> XrResult resultOf(Call call)
{
	try {
		call();
		return XR_SUCCESS;
	} catch (const Error &error) {
		return error.result;
	}
}

} // namespace arift::openxr
