// A swapchain's images where the application's device cannot share memory with the service's: images of its own, each copied into a memfd
// when it is released.
#pragma once
#include "runtime/ipc/shared_memory.h"
#include "runtime/openxr/vulkan/vulkan_graphics.h"

namespace arift::openxr
{

class VulkanCopiedImages final : public SwapchainImages
{
public:
	/// Throws XR_ERROR_OUT_OF_MEMORY or XR_ERROR_RUNTIME_FAILURE.
	VulkanCopiedImages(VulkanDevice &device, const gpu::ImageSpec &spec, const SharedMemory &memory);
	~VulkanCopiedImages() override;
	void describe(std::span<XrSwapchainImageBaseHeader *const> elements) const override;
	void takeOver(uint32_t image) override;
	std::shared_ptr<Completion> handOver(uint32_t image) override;
	size_t elementSize() const override { return sizeof(XrSwapchainImageVulkanKHR); }

private:
	class Image;
	/// An image, where it is read back to, and what is recorded once.
	struct Entry {
		std::shared_ptr<Image> image;
		VkCommandBuffer enter = VK_NULL_HANDLE;    ///< the first time: into the boundary layout
		VkCommandBuffer readBack = VK_NULL_HANDLE; ///< out of the boundary layout and into it again
		bool entered = false;
		std::shared_ptr<Completion> lastWork; ///< of ours on the application's queue
	};
	enum class Step { enter, beforeReading, afterReading };
	void record(Entry &entry, const gpu::ImageSpec &spec) const;
	void change(const Entry &entry, VkCommandBuffer commands, const gpu::ImageSpec &spec, Step step) const;

	VulkanDevice &device_;
	VkCommandPool pool_ = VK_NULL_HANDLE;
	std::vector<Entry> entries_;
};

} // namespace arift::openxr
