// A session's Vulkan binding: the application's device and queue. The queue is used only where XR_KHR_vulkan_enable2's "Concurrency" allows
// it: in xrAcquireSwapchainImage and xrReleaseSwapchainImage.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/graphics.h"
#include "runtime/openxr/vulkan/physical_device.h"
#include <optional>

namespace arift::openxr
{

/// Fences for work on one device, used again and again. Thread-safe.
class FencePool
{
public:
	FencePool(const VulkanDeviceApi &vulkan, VkDevice device) : vulkan_(vulkan), device_(device) {}
	~FencePool();
	FencePool(const FencePool &) = delete;

	/// An unsignalled fence.
	VkFence take();
	/// A fence nobody waits for any more; it may not be signalled yet.
	void giveBack(VkFence fence) { idle_.lock()->push_back(fence); }
	Completion::Outcome wait(VkFence fence, XrDuration limit) const;

private:
	const VulkanDeviceApi &vulkan_;
	VkDevice device_;
	Guarded<std::vector<VkFence>> idle_;
};

/// The device, as its swapchains use it.
class VulkanDevice
{
public:
	/// Throws XR_ERROR_GRAPHICS_DEVICE_INVALID.
	VulkanDevice(const VulkanInstanceApi &instanceApi, const XrGraphicsBindingVulkanKHR &binding);
	/// Submits one command buffer to the application's queue.
	std::shared_ptr<Completion> submit(VkCommandBuffer commands);

	/// A memory type among `allowed` with every flag of `wanted`; nothing where none has.
	std::optional<uint32_t> memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) const;

	const VulkanDeviceApi vulkan;
	const VkDevice device;
	const uint32_t queueFamily;

private:
	VkPhysicalDeviceMemoryProperties memory_{};
	VkQueue queue_ = VK_NULL_HANDLE;
	std::shared_ptr<FencePool> fences_;
};

class VulkanGraphics final : public Graphics
{
public:
	VulkanGraphics(const VulkanInstanceApi &instanceApi, const XrGraphicsBindingVulkanKHR &binding);
	std::array<uint8_t, 16> deviceUuid() const override { return id_.deviceUuid; }
	std::array<uint8_t, 16> driverUuid() const override { return id_.driverUuid; }
	std::vector<int64_t> formatsOf(std::span<const int32_t> vulkan) const override;
	bool sees(const MemoryProbe &probe) const override;
	gpu::ImageSpec specOf(const XrSwapchainCreateInfo &info, ipc::Sharing sharing) const override;
	std::unique_ptr<SwapchainImages> import(const gpu::ImageSpec &spec, const SharedMemory &memory) override;

private:
	const VulkanInstanceApi instanceApi_;
	const VkPhysicalDevice physicalDevice_;
	const PhysicalDeviceId id_;
	const std::vector<int64_t> formats_;
	VulkanDevice device_;
};

} // namespace arift::openxr
