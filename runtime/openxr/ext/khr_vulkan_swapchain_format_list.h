// XR_KHR_vulkan_swapchain_format_list: an application that says which formats it will see an image as. An image that is mutable is made for
// every format that fits it, so what the list allows is allowed without it.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

/// Throws XR_ERROR_VALIDATION_FAILURE for a list that is none.
inline void requireFormatList(const Instance &instance, const XrSwapchainCreateInfo &info)
{
	if (!instance.has(Extension::KHR_vulkan_swapchain_format_list)) return;
	const auto *list = findInChain<XrVulkanSwapchainFormatListCreateInfoKHR>(info.next);
	if (!list || list->viewFormatCount == 0) return;
	if (!list->viewFormats)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "viewFormats is null but viewFormatCount is {}", list->viewFormatCount);
	for (uint32_t i = 0; i < list->viewFormatCount; ++i)
		if (list->viewFormats[i] == VK_FORMAT_UNDEFINED) throw Error(XR_ERROR_VALIDATION_FAILURE, "viewFormats[{}] is undefined", i);
}

} // namespace arift::openxr
