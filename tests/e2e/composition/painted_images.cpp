#include "tests/e2e/composition/painted_images.h"
#include <cstring>

namespace arift::e2e
{

namespace
{

using Layout = vk::ImageLayout;

uint32_t facesOf(const Image &image) { return image.isCube ? 6 : 1; }

Swapchain createSwapchain(XrSession session, const Image &image)
{
	XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
	info.usageFlags = XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
	info.format = VK_FORMAT_R8G8B8A8_SRGB;
	info.sampleCount = info.mipCount = 1;
	info.faceCount = facesOf(image);
	info.width = uint32_t(image.width);
	info.height = uint32_t(image.height);
	info.arraySize = uint32_t(image.arrayLayers);
	Swapchain swapchain;
	check(xrCreateSwapchain(session, &info, &swapchain.value), "xrCreateSwapchain");
	return swapchain;
}

std::vector<uint8_t> texelsOf(const Image &image)
{
	std::vector<uint8_t> bytes;
	for (int layer = 0; layer < image.arrayLayers * int(facesOf(image)); ++layer)
		for (int row = 0; row < image.height; ++row)
			for (int column = 0; column < image.width; ++column) {
				const auto texel = texelOf(image, column, row, layer);
				bytes.insert(bytes.end(), texel.begin(), texel.end());
			}
	return bytes;
}

/// Memory that a GPU copies from.
class Staging
{
public:
	Staging(const Vulkan &vulkan, const std::vector<uint8_t> &bytes)
		: buffer(vulkan.device, {.size = bytes.size(), .usage = vk::BufferUsageFlagBits::eTransferSrc}),
		  memory_(vulkan.device, {.allocationSize = buffer.getMemoryRequirements().size, .memoryTypeIndex = visibleType(vulkan)})
	{
		buffer.bindMemory(*memory_, 0);
		void *mapped = memory_.mapMemory(0, bytes.size());
		std::memcpy(mapped, bytes.data(), bytes.size());
		memory_.unmapMemory();
	}
	vk::raii::Buffer buffer;

private:
	uint32_t visibleType(const Vulkan &vulkan) const
	{
		using Property = vk::MemoryPropertyFlagBits;
		const auto types = vulkan.physicalDevice.getMemoryProperties();
		const uint32_t allowed = buffer.getMemoryRequirements().memoryTypeBits;
		const vk::MemoryPropertyFlags wanted = Property::eHostVisible | Property::eHostCoherent;
		for (uint32_t type = 0; type < types.memoryTypeCount; ++type)
			if ((allowed >> type & 1) && (types.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
		throw std::runtime_error("no memory that both see");
	}
	vk::raii::DeviceMemory memory_;
};

} // namespace

PaintedImages::PaintedImages(const Vulkan &vulkan, const vk::raii::Queue &queue, XrSession session, const Image &image)
	: image_(image), swapchain_(createSwapchain(session, image))
{
	const auto images =
		enumerate("xrEnumerateSwapchainImages", XrSwapchainImageVulkan2KHR{XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR},
				  [&](uint32_t capacity, uint32_t *count, XrSwapchainImageVulkan2KHR *all) {
					  return xrEnumerateSwapchainImages(swapchain_, capacity, count, reinterpret_cast<XrSwapchainImageBaseHeader *>(all));
				  });
	uint32_t index = 0;
	check(xrAcquireSwapchainImage(swapchain_, nullptr, &index), "xrAcquireSwapchainImage");
	const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
	check(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
	paint(vulkan, queue, images[index].image);
	check(xrReleaseSwapchainImage(swapchain_, nullptr), "xrReleaseSwapchainImage");
}

void PaintedImages::paint(const Vulkan &vulkan, const vk::raii::Queue &queue, VkImage target) const
{
	const Staging staging(vulkan, texelsOf(image_));
	const vk::raii::CommandPool pool(vulkan.device, {.queueFamilyIndex = vulkan.queueFamily});
	const vk::raii::CommandBuffers buffers(vulkan.device, {.commandPool = *pool, .commandBufferCount = 1});
	const vk::raii::CommandBuffer &commands = buffers[0];
	const auto change = [&](Layout from, Layout to) {
		commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, {}, {},
								 vk::ImageMemoryBarrier{.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
														.dstAccessMask = vk::AccessFlagBits::eMemoryWrite,
														.oldLayout = from,
														.newLayout = to,
														.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
														.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
														.image = target,
														.subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor,
																			 .levelCount = 1,
																			 .layerCount = VK_REMAINING_ARRAY_LAYERS}});
	};
	commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	change(Layout::eColorAttachmentOptimal, Layout::eTransferDstOptimal);
	commands.copyBufferToImage(*staging.buffer, target, Layout::eTransferDstOptimal,
							   vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor,
																		.layerCount = uint32_t(image_.arrayLayers) * facesOf(image_)},
												   .imageExtent = {uint32_t(image_.width), uint32_t(image_.height), 1}});
	change(Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
	commands.end();
	queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands}, {});
	queue.waitIdle();
}

XrSwapchainSubImage PaintedImages::subImage(const Part &part) const
{
	const bool whole = part.width == 0;
	const XrExtent2Di extent = whole ? XrExtent2Di{image_.width, image_.height} : XrExtent2Di{part.width, part.height};
	return {swapchain_, {{part.column, part.row}, extent}, uint32_t(part.arrayLayer)};
}

} // namespace arift::e2e
