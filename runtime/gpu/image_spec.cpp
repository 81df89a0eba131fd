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

bool canLieInRows(uint32_t deviceType, const ImageSpec &spec)
{
	return deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && !isDepth(VkFormat(spec.format)) && !isCube(spec) && spec.samples == 1;
}

VkImageLayout boundaryLayout(VkFormat format)
{
	return isDepth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkFormat storedFormat(VkFormat format)
{
	switch (format) {
	case VK_FORMAT_R8G8B8A8_SRGB: return VK_FORMAT_R8G8B8A8_UNORM;
	case VK_FORMAT_B8G8R8A8_SRGB: return VK_FORMAT_B8G8R8A8_UNORM;
	default: return format;
	}
}

size_t bytesPerTexel(VkFormat format)
{
	switch (format) {
	case VK_FORMAT_R8G8B8A8_SRGB:
	case VK_FORMAT_B8G8R8A8_SRGB:
	case VK_FORMAT_R8G8B8A8_UNORM:
	case VK_FORMAT_B8G8R8A8_UNORM:
	case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
	case VK_FORMAT_D32_SFLOAT:
	case VK_FORMAT_D32_SFLOAT_S8_UINT:
	case VK_FORMAT_D24_UNORM_S8_UINT: return 4;
	case VK_FORMAT_D16_UNORM: return 2;
	case VK_FORMAT_R16G16B16A16_SFLOAT:
	case VK_FORMAT_R16G16B16A16_UNORM: return 8;
	default: return 0;
	}
}

CopyLayout copyLayoutOf(const ImageSpec &spec)
{
	CopyLayout layout;
	layout.rowPitch = spec.width * bytesPerTexel(VkFormat(spec.format));
	layout.layerSize = layout.rowPitch * spec.height;
	layout.layerPitch = (layout.layerSize + 15) / 16 * 16;
	layout.size = layout.layerPitch * spec.arrayLayers;
	return layout;
}

VkImageAspectFlags copiedAspectOf(VkFormat format) { return isDepth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT; }

VkImageCreateFlags createFlagsOf(VkFormat format)
{
	return storedFormat(format) == format ? 0 : VkImageCreateFlags(VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT);
}

VkImageCreateInfo imageCreateInfo(const ImageSpec &spec, VkExternalMemoryImageCreateInfo &external)
{
	// What the service does with every image (clears new ones, samples all), and what the boundary layout demands.
	const VkImageUsageFlags attachment =
		isDepth(VkFormat(spec.format)) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
	const VkImageUsageFlags ours = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | attachment;
	const auto format = VkFormat(spec.format);
	external = {.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO, .pNext = nullptr, .handleTypes = sharedHandleType};
	return {
		.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
		.pNext = &external,
		.flags = spec.createFlags | createFlagsOf(format),
		.imageType = VK_IMAGE_TYPE_2D,
		.format = format,
		.extent = {spec.width, spec.height, 1},
		.mipLevels = spec.mipLevels,
		.arrayLayers = spec.arrayLayers,
		.samples = VkSampleCountFlagBits(spec.samples),
		.tiling = spec.inRows ? VK_IMAGE_TILING_LINEAR : VK_IMAGE_TILING_OPTIMAL,
		.usage = spec.usage | ours,
		.sharingMode = VK_SHARING_MODE_EXCLUSIVE,
		.queueFamilyIndexCount = 0,
		.pQueueFamilyIndices = nullptr,
		.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
	};
}

} // namespace arift::gpu
