#include "runtime/gpu/image_spec.h"

namespace arift::gpu
{

bool isDepth(VkFormat format) { return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT; }

VkImageLayout boundaryLayout(VkFormat format)
{
	return isDepth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkImageCreateInfo imageCreateInfo(const ImageSpec &spec, VkExternalMemoryImageCreateInfo &external)
{
	// What the service does with every image: it clears new ones and samples the ones with colour.
	const VkImageUsageFlags ours = VK_IMAGE_USAGE_TRANSFER_DST_BIT | (isDepth(VkFormat(spec.format)) ? 0 : VK_IMAGE_USAGE_SAMPLED_BIT);
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
