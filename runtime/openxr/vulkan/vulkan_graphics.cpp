#include "runtime/openxr/vulkan/vulkan_graphics.h"
#include "runtime/gpu/swapchain_formats.h"
#include "runtime/openxr/vulkan/vulkan_copied_images.h"
#include "runtime/openxr/vulkan/vulkan_images.h"
#include <algorithm>
#include <cstring>

namespace arift::openxr
{
namespace
{

std::vector<int64_t> drawableFormats(const VulkanInstanceApi &vulkan, VkPhysicalDevice device)
{
	if (!vulkan.GetPhysicalDeviceImageFormatProperties2)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the VkInstance was made without the extensions that sharing images needs");
	return gpu::drawableFormats(device, vulkan.GetPhysicalDeviceImageFormatProperties2);
}

VkImageUsageFlags usageOf(XrSwapchainUsageFlags flags)
{
	struct Pair {
		XrSwapchainUsageFlags xr;
		VkImageUsageFlags vulkan;
	};
	constexpr Pair pairs[] = {
		{XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
		{XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
		{XR_SWAPCHAIN_USAGE_UNORDERED_ACCESS_BIT, VK_IMAGE_USAGE_STORAGE_BIT},
		{XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
		{XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT},
		{XR_SWAPCHAIN_USAGE_SAMPLED_BIT, VK_IMAGE_USAGE_SAMPLED_BIT},
		{XR_SWAPCHAIN_USAGE_INPUT_ATTACHMENT_BIT_KHR, VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT},
	};
	XrSwapchainUsageFlags left = flags & ~XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT;
	VkImageUsageFlags usage = 0;
	for (const Pair &pair : pairs)
		if (left & pair.xr) {
			usage |= pair.vulkan;
			left &= ~pair.xr;
		}
	if (left) throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "usageFlags has the bits {:#x} that are not supported", left);
	return usage;
}

const XrGraphicsBindingVulkanKHR &requireBinding(const XrGraphicsBindingVulkanKHR &binding)
{
	if (!binding.instance || !binding.physicalDevice || !binding.device)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding has a null VkInstance, VkPhysicalDevice or VkDevice");
	return binding;
}

/// A command buffer's fence.
class FenceCompletion final : public Completion
{
public:
	FenceCompletion(std::shared_ptr<FencePool> pool, VkFence fence) : pool_(std::move(pool)), fence_(fence) {}
	~FenceCompletion() override { pool_->giveBack(fence_); }
	Outcome wait(XrDuration limit) const override { return pool_->wait(fence_, limit); }

private:
	std::shared_ptr<FencePool> pool_;
	VkFence fence_;
};

} // namespace

FencePool::~FencePool()
{
	const auto idle = idle_.lock();
	for (const VkFence fence : *idle) {
		wait(fence, second); // one that is still pending may not be destroyed
		vulkan_.DestroyFence(device_, fence, nullptr);
	}
}

VkFence FencePool::take()
{
	{
		auto idle = idle_.lock();
		const auto done = std::ranges::find_if(*idle, [&](VkFence fence) { return vulkan_.GetFenceStatus(device_, fence) == VK_SUCCESS; });
		if (done != idle->end()) {
			const VkFence fence = *done;
			requireSuccess(vulkan_.ResetFences(device_, 1, &fence), "vkResetFences");
			idle->erase(done);
			return fence;
		}
	}
	const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
	VkFence fence = VK_NULL_HANDLE;
	requireSuccess(vulkan_.CreateFence(device_, &info, nullptr, &fence), "vkCreateFence");
	return fence;
}

Completion::Outcome FencePool::wait(VkFence fence, XrDuration limit) const
{
	switch (vulkan_.WaitForFences(device_, 1, &fence, VK_TRUE, uint64_t(limit))) {
	case VK_SUCCESS: return Completion::Outcome::done;
	case VK_TIMEOUT: return Completion::Outcome::notYet;
	default: return Completion::Outcome::failed;
	}
}

VulkanDevice::VulkanDevice(const VulkanInstanceApi &instanceApi, const XrGraphicsBindingVulkanKHR &binding)
	: vulkan(instanceApi.GetDeviceProcAddr, binding.device), device(binding.device), queueFamily(binding.queueFamilyIndex)
{
	instanceApi.GetPhysicalDeviceMemoryProperties(binding.physicalDevice, &memory_);
	uint32_t familyCount = 0;
	instanceApi.GetPhysicalDeviceQueueFamilyProperties(binding.physicalDevice, &familyCount, nullptr);
	if (queueFamily >= familyCount)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "queue family {} is not below {}", queueFamily, familyCount);
	vulkan.GetDeviceQueue(device, queueFamily, binding.queueIndex, &queue_);
	if (!queue_) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the device has no queue {} of family {}", binding.queueIndex, queueFamily);
	fences_ = std::make_shared<FencePool>(vulkan, device);
}

std::shared_ptr<Completion> VulkanDevice::submit(VkCommandBuffer commands)
{
	const VkFence fence = fences_->take();
	const VkSubmitInfo info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
	const VkResult result = vulkan.QueueSubmit(queue_, 1, &info, fence);
	if (result != VK_SUCCESS) {
		vulkan.DestroyFence(device, fence, nullptr);
		requireSuccess(result, "vkQueueSubmit");
	}
	return std::make_shared<FenceCompletion>(fences_, fence);
}

std::optional<uint32_t> VulkanDevice::memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) const
{
	for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type)
		if ((allowed >> type & 1) && (memory_.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
	return std::nullopt;
}

VulkanGraphics::VulkanGraphics(const VulkanInstanceApi &instanceApi, const XrGraphicsBindingVulkanKHR &binding)
	: instanceApi_(instanceApi),
	  physicalDevice_(requireBinding(binding).physicalDevice),
	  id_(identify(instanceApi_, physicalDevice_)),
	  formats_(drawableFormats(instanceApi_, physicalDevice_)),
	  device_(instanceApi_, binding)
{
}

bool VulkanGraphics::sees(const MemoryProbe &probe) const
{
	const VulkanDeviceApi &vulkan = device_.vulkan;
	if (probe.typeIndex >= 32 || !device_.memoryType(1u << probe.typeIndex, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) return false;
	const VkImportMemoryFdInfoKHR import{VK_STRUCTURE_TYPE_IMPORT_MEMORY_FD_INFO_KHR, nullptr, gpu::sharedHandleType, probe.memory.get()};
	const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &import, probe.size, probe.typeIndex};
	VkDeviceMemory memory = VK_NULL_HANDLE;
	if (vulkan.AllocateMemory(device_.device, &info, nullptr, &memory) != VK_SUCCESS) return false;
	probe.memory.release(); // Vulkan's now
	void *bytes = nullptr;
	const bool isMapped = vulkan.MapMemory(device_.device, memory, 0, VK_WHOLE_SIZE, 0, &bytes) == VK_SUCCESS;
	const bool isSame =
		isMapped && probe.pattern.size() <= probe.size && std::memcmp(bytes, probe.pattern.data(), probe.pattern.size()) == 0;
	if (isMapped) vulkan.UnmapMemory(device_.device, memory);
	vulkan.FreeMemory(device_.device, memory, nullptr);
	return isSame;
}

std::vector<int64_t> VulkanGraphics::formatsOf(std::span<const int32_t> vulkan) const
{
	std::vector<int64_t> drawable;
	std::ranges::copy_if(vulkan, std::back_inserter(drawable),
						 [&](int32_t format) { return std::ranges::find(formats_, format) != formats_.end(); });
	return drawable;
}

gpu::ImageSpec VulkanGraphics::specOf(const XrSwapchainCreateInfo &info, ipc::Sharing sharing) const
{
	gpu::ImageSpec spec;
	spec.format = int32_t(info.format);
	spec.usage = usageOf(info.usageFlags);
	if (info.usageFlags & XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT) spec.createFlags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
	if (info.faceCount == 6) spec.createFlags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
	spec.width = info.width;
	spec.height = info.height;
	spec.arrayLayers = info.arraySize * info.faceCount;
	spec.mipLevels = info.mipCount;
	spec.samples = info.sampleCount;
	spec.inRows = sharing == ipc::Sharing::memory && gpu::canLieInRows(id_.deviceType, spec) ? 1 : 0;
	VkExternalMemoryImageCreateInfo external;
	const VkImageCreateInfo create = gpu::imageCreateInfo(spec, external);
	VkImageFormatProperties limits{};
	const VkResult result = instanceApi_.GetPhysicalDeviceImageFormatProperties(physicalDevice_, create.format, create.imageType,
																				create.tiling, create.usage, create.flags, &limits);
	const bool fits = spec.width <= limits.maxExtent.width && spec.height <= limits.maxExtent.height &&
					  spec.arrayLayers <= limits.maxArrayLayers && spec.mipLevels <= limits.maxMipLevels;
	if (result != VK_SUCCESS || !fits)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "the device has no image of VkFormat {}, usage {:#x}, {}x{}, {} layers, {} levels",
					spec.format, create.usage, spec.width, spec.height, spec.arrayLayers, spec.mipLevels);
	return spec;
}

std::unique_ptr<SwapchainImages> VulkanGraphics::import(const gpu::ImageSpec &spec, const SharedMemory &memory)
{
	if (memory.sharing == ipc::Sharing::copies) return std::make_unique<VulkanCopiedImages>(device_, spec, memory);
	return std::make_unique<VulkanImages>(device_, spec, memory);
}

} // namespace arift::openxr
