#include "runtime/gpu/image_spec.h"

namespace arift::gpu
{

bool isDepth(VkFormat format) { return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT; }

VkImageAspectFlags aspectOf(VkFormat format)
{
	if (!isDepth(format)) return VK_IMAGE_ASPECT_COLOR_BIT;
	if (format == VK_FORMAT_S8_UINT) return VK_IMAGE_ASPECT_STENCIL_BIT;
	const bool hasStencil = format >= VK_FORMAT_D16_UNORM_S8_UINT;
	return hasStencil ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
}

VkImageLayout boundaryLayout(VkFormat format)
{
	return isDepth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkImageCreateInfo imageCreateInfo(const ImageSpec &spec, VkExternalMemoryImageCreateInfo &external)
{
	// What the service does with every image (clears new ones, samples those with colour), and what the boundary layout demands.
	const bool depth = isDepth(VkFormat(spec.format));
	const VkImageUsageFlags ours =
		VK_IMAGE_USAGE_TRANSFER_DST_BIT |
		(depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
	external = {.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO, .pNext = nullptr, .handleTypes = sharedHandleType};
	return {
		.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
		.pNext = &external,
		.flags = spec.createFlags,
		.imageType = VK_IMAGE_TYPE_2D,
		.format = VkFormat(spec.format),
		.extent = {spec.width, spec.height, 1},
		.mipLevels = spec.mipLevels,
		.arrayLayers = spec.arrayLayers,
		.samples = VkSampleCountFlagBits(spec.samples),
		.tiling = VK_IMAGE_TILING_OPTIMAL,
		.usage = spec.usage | ours,
		.sharingMode = VK_SHARING_MODE_EXCLUSIVE,
		.queueFamilyIndexCount = 0,
		.pQueueFamilyIndices = nullptr,
		.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
	};
}

} // namespace arift::gpu
