// A swapchain's images in the application's Vulkan device: the service's memory, imported, with the barriers at the boundary recorded once.
#pragma once
#include "runtime/openxr/vulkan/vulkan_graphics.h"

namespace arift::openxr
{

/// How long (real time) the end of a swapchain waits for the work on it.
constexpr XrDuration endLimit = second;
constexpr VkAccessFlags everyAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
/// SwapchainImages::describe for images that are `images`.
void describeImages(std::span<XrSwapchainImageBaseHeader *const> elements, const std::vector<VkImage> &images);
/// Begins commands that may be submitted again before they have run: an image may be released without being shown.
void beginCommands(const VulkanDeviceApi &vulkan, VkCommandBuffer commands);

class VulkanImages final : public SwapchainImages
{
public:
	/// Throws XR_ERROR_RUNTIME_FAILURE where this driver cannot import what the service's exported.
	VulkanImages(VulkanDevice &device, const gpu::ImageSpec &spec, const SharedMemory &memory);
	~VulkanImages() override;
	void describe(std::span<XrSwapchainImageBaseHeader *const> elements) const override;
	void takeOver(uint32_t image) override;
	std::shared_ptr<Completion> handOver(uint32_t image) override;
	size_t elementSize() const override { return sizeof(XrSwapchainImageVulkanKHR); }

private:
	struct Image {
		VkImage image = VK_NULL_HANDLE;
		VkDeviceMemory memory = VK_NULL_HANDLE;
		VkCommandBuffer enter = VK_NULL_HANDLE;    ///< the first time: nothing of it is known to this device yet
		VkCommandBuffer takeOver = VK_NULL_HANDLE; ///< from the compositor
		VkCommandBuffer handOver = VK_NULL_HANDLE; ///< to the compositor
		bool entered = false;
		std::shared_ptr<Completion> lastWork; ///< of ours on the application's queue
	};
	void importMemory(Image &image, const gpu::ImageSpec &spec, UniqueFd &fd, const SharedMemory &memory);
	void recordBarriers(Image &image, VkFormat format);
	void record(VkCommandBuffer commands, const VkImageMemoryBarrier &barrier, bool isHandOver) const;
	void release() noexcept;

	VulkanDevice &device_;
	VkCommandPool pool_ = VK_NULL_HANDLE;
	std::vector<Image> images_;
};

} // namespace arift::openxr
