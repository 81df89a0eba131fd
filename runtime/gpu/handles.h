// The vulkan.hpp objects inside Device, for those that draw. Include it in .cpp files only: it is expensive.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/gpu/device.h"
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <vulkan/vulkan_raii.hpp>

namespace arift::gpu
{

/// Every level and layer of a colour image.
inline constexpr vk::ImageSubresourceRange wholeColour{vk::ImageAspectFlagBits::eColor, 0, VK_REMAINING_MIP_LEVELS, 0,
													   VK_REMAINING_ARRAY_LAYERS};

/// Declared in the order in which they are made; destroyed the other way round.
struct Device::Handles {
	explicit Handles(const std::vector<const char *> &surfaceExtensions);
	Handles(const Handles &) = delete;

	std::atomic<uint64_t> validationMessages{0};
	vk::raii::Context context;
	vk::raii::Instance instance;
	std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
	vk::raii::PhysicalDevice physical;
	uint32_t queueFamily = 0;
	bool canPresent = false; ///< VK_KHR_swapchain is enabled
	vk::raii::Device device;
	Guarded<vk::raii::Queue> queue;
	DeviceIdentity identity;
	/// How long a wait for the GPU may last before the device counts as lost: a software renderer compiles in its first draw.
	std::chrono::nanoseconds patience{};

	/// A memory type among `allowed` with every flag of the first of `wishes` that any has. Throws std::runtime_error if none has.
	uint32_t memoryType(uint32_t allowed, std::span<const vk::MemoryPropertyFlags> wishes) const;
	/// Submits and waits, at most `patience`; throws std::runtime_error beyond. `fence` is unsignalled before and after.
	void submitAndWait(const vk::raii::CommandBuffer &commands, const vk::raii::Fence &fence);
	/// Records, submits and waits: for set-up, not for frames.
	void runOnce(const std::function<void(const vk::raii::CommandBuffer &)> &record);
};

/// Device memory bound to an image or a buffer of its own.
struct Image {
	Image(const Device::Handles &gpu, const vk::ImageCreateInfo &info);
	vk::raii::Image image;
	vk::raii::DeviceMemory memory;
};
struct Buffer {
	/// Host-visible and coherent, mapped as long as it lives; cached where the CPU reads it back.
	Buffer(const Device::Handles &gpu, vk::DeviceSize size, vk::BufferUsageFlags usage);
	vk::raii::Buffer buffer;
	vk::raii::DeviceMemory memory;
	std::span<std::byte> bytes;
};

} // namespace arift::gpu
