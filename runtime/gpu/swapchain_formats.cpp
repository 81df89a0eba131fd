#include "runtime/gpu/swapchain_formats.h"
#include "runtime/gpu/image_spec.h"
#include <array>

namespace arift::gpu
{

namespace
{

// Encoded formats first: an application that takes the first one gets its colours right. What engines ask for by name follows.
constexpr std::array candidates{VK_FORMAT_R8G8B8A8_SRGB,
								VK_FORMAT_B8G8R8A8_SRGB,
								VK_FORMAT_R16G16B16A16_SFLOAT,
								VK_FORMAT_A2B10G10R10_UNORM_PACK32,
								VK_FORMAT_R16G16B16A16_UNORM,
								VK_FORMAT_R8G8B8A8_UNORM,
								VK_FORMAT_B8G8R8A8_UNORM,
								VK_FORMAT_D32_SFLOAT,
								VK_FORMAT_D24_UNORM_S8_UINT,
								VK_FORMAT_D32_SFLOAT_S8_UINT,
								VK_FORMAT_D16_UNORM};

bool canUse(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query, VkFormat format, bool isShared)
{
	const VkPhysicalDeviceExternalImageFormatInfo shared{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_IMAGE_FORMAT_INFO, nullptr,
														 sharedHandleType};
	const VkImageUsageFlags attachment =
		isDepth(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
	const VkPhysicalDeviceImageFormatInfo2 info{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2,
												.pNext = isShared ? &shared : nullptr,
												.format = format,
												.type = VK_IMAGE_TYPE_2D,
												.tiling = VK_IMAGE_TILING_OPTIMAL,
												.usage = attachment | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
														 VK_IMAGE_USAGE_TRANSFER_DST_BIT,
												.flags = createFlagsOf(format)};
	VkExternalImageFormatProperties external{VK_STRUCTURE_TYPE_EXTERNAL_IMAGE_FORMAT_PROPERTIES, nullptr, {}};
	VkImageFormatProperties2 found{VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2, isShared ? &external : nullptr, {}};
	if (query(device, &info, &found) != VK_SUCCESS) return false;
	constexpr VkExternalMemoryFeatureFlags needed = VK_EXTERNAL_MEMORY_FEATURE_EXPORTABLE_BIT | VK_EXTERNAL_MEMORY_FEATURE_IMPORTABLE_BIT;
	return !isShared || (external.externalMemoryProperties.externalMemoryFeatures & needed) == needed;
}

std::vector<int64_t> formats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query, bool isShared)
{
	std::vector<int64_t> all;
	for (const VkFormat format : candidates)
		if (canUse(device, query, format, isShared)) all.push_back(format);
	return all;
}

} // namespace

std::vector<int64_t> swapchainFormats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query)
{
	return formats(device, query, true);
}

std::vector<int64_t> drawableFormats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query)
{
	return formats(device, query, false);
}

} // namespace arift::gpu
