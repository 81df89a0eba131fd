#include "runtime/openxr/vulkan/vulkan_images.h"

namespace arift::openxr
{

void describeImages(std::span<XrSwapchainImageBaseHeader *const> elements, const std::vector<VkImage> &images)
{
	for (const XrSwapchainImageBaseHeader *element : elements)
		if (element->type != XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR)
			throw Error(XR_ERROR_VALIDATION_FAILURE, "an element's type is {}, not XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR", int(element->type));
	for (size_t i = 0; i < elements.size(); ++i) reinterpret_cast<XrSwapchainImageVulkanKHR *>(elements[i])->image = images[i];
}

void beginCommands(const VulkanDeviceApi &vulkan, VkCommandBuffer commands)
{
	const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
										.pNext = nullptr,
										.flags = VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT,
										.pInheritanceInfo = nullptr};
	requireSuccess(vulkan.BeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

VulkanImages::VulkanImages(VulkanDevice &device, const gpu::ImageSpec &spec, const SharedMemory &memory)
	: device_(device), images_(memory.fds.size())
{
	try {
		const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = device_.queueFamily};
		requireSuccess(device_.vulkan.CreateCommandPool(device_.device, &info, nullptr, &pool_), "vkCreateCommandPool");
		for (size_t i = 0; i < images_.size(); ++i) {
			importMemory(images_[i], spec, memory.fds[i], memory);
			recordBarriers(images_[i], VkFormat(spec.format));
		}
	} catch (...) {
		release();
		throw;
	}
}

VulkanImages::~VulkanImages()
{
	for (const Image &image : images_)
		if (image.lastWork && image.lastWork->wait(endLimit) == Completion::Outcome::notYet) {
			log::error("the application's GPU still works on a swapchain {} s after its last use; its images are left alone",
					   inSeconds(endLimit));
			return;
		}
	release();
}

void VulkanImages::release() noexcept
{
	const VulkanDeviceApi &vulkan = device_.vulkan;
	for (const Image &image : images_) {
		vulkan.DestroyImage(device_.device, image.image, nullptr);
		vulkan.FreeMemory(device_.device, image.memory, nullptr);
	}
	vulkan.DestroyCommandPool(device_.device, pool_, nullptr);
}

void VulkanImages::importMemory(Image &image, const gpu::ImageSpec &spec, UniqueFd &fd, const SharedMemory &memory)
{
	const VulkanDeviceApi &vulkan = device_.vulkan;
	VkExternalMemoryImageCreateInfo external;
	const VkImageCreateInfo info = gpu::imageCreateInfo(spec, external);
	requireSuccess(vulkan.CreateImage(device_.device, &info, nullptr, &image.image), "vkCreateImage");
	VkMemoryRequirements requirements{};
	vulkan.GetImageMemoryRequirements(device_.device, image.image, &requirements);
	if (requirements.size > memory.size || !(requirements.memoryTypeBits & 1u << memory.typeIndex))
		throw Error(XR_ERROR_RUNTIME_FAILURE,
					"the service's image ({} bytes of memory type {}) is not one of this driver's ({} bytes of types {:#x})", memory.size,
					memory.typeIndex, requirements.size, requirements.memoryTypeBits);
	const VkMemoryDedicatedAllocateInfo dedicated{
		.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, .pNext = nullptr, .image = image.image, .buffer = VK_NULL_HANDLE};
	const VkImportMemoryFdInfoKHR import{
		.sType = VK_STRUCTURE_TYPE_IMPORT_MEMORY_FD_INFO_KHR, .pNext = &dedicated, .handleType = gpu::sharedHandleType, .fd = fd.get()};
	const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &import, memory.size, memory.typeIndex};
	requireSuccess(vulkan.AllocateMemory(device_.device, &allocate, nullptr, &image.memory),
				   "vkAllocateMemory (import of the service's image)");
	fd.release(); // Vulkan's now
	requireSuccess(vulkan.BindImageMemory(device_.device, image.image, image.memory, 0), "vkBindImageMemory");
}

void VulkanImages::recordBarriers(Image &image, VkFormat format)
{
	const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
										   .pNext = nullptr,
										   .commandPool = pool_,
										   .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
										   .commandBufferCount = 3};
	std::array<VkCommandBuffer, 3> commands{};
	requireSuccess(device_.vulkan.AllocateCommandBuffers(device_.device, &info, commands.data()), "vkAllocateCommandBuffers");
	image.enter = commands[0];
	image.takeOver = commands[1];
	image.handOver = commands[2];
	const VkImageLayout layout = gpu::boundaryLayout(format);
	VkImageMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
								 .pNext = nullptr,
								 .srcAccessMask = 0,
								 .dstAccessMask = everyAccess,
								 .oldLayout = layout,
								 .newLayout = layout,
								 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_EXTERNAL,
								 .dstQueueFamilyIndex = device_.queueFamily,
								 .image = image.image,
								 .subresourceRange = {gpu::aspectOf(format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
	record(image.takeOver, barrier, false);
	// An image nothing was drawn into has no contents to keep, and this device has not seen it in any layout yet.
	VkImageMemoryBarrier enter = barrier;
	enter.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
	enter.srcQueueFamilyIndex = enter.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	record(image.enter, enter, false);
	std::swap(barrier.srcAccessMask, barrier.dstAccessMask);
	std::swap(barrier.srcQueueFamilyIndex, barrier.dstQueueFamilyIndex);
	record(image.handOver, barrier, true);
}

void VulkanImages::record(VkCommandBuffer commands, const VkImageMemoryBarrier &barrier, bool isHandOver) const
{
	const VulkanDeviceApi &vulkan = device_.vulkan;
	beginCommands(vulkan, commands);
	const VkPipelineStageFlags before = isHandOver ? VK_PIPELINE_STAGE_ALL_COMMANDS_BIT : VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT;
	const VkPipelineStageFlags after = isHandOver ? VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT : VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
	vulkan.CmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
	requireSuccess(vulkan.EndCommandBuffer(commands), "vkEndCommandBuffer");
}

void VulkanImages::describe(std::span<XrSwapchainImageBaseHeader *const> elements) const
{
	std::vector<VkImage> images;
	for (const Image &image : images_) images.push_back(image.image);
	describeImages(elements, images);
}

void VulkanImages::takeOver(uint32_t index)
{
	Image &image = images_[index];
	image.lastWork = device_.submit(image.entered ? image.takeOver : image.enter);
	image.entered = true;
}

std::shared_ptr<Completion> VulkanImages::handOver(uint32_t index)
{
	Image &image = images_[index];
	image.lastWork = device_.submit(image.handOver);
	return image.lastWork;
}

} // namespace arift::openxr
