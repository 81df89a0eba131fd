// XR_KHR_swapchain_usage_input_attachment_bit: swapchain images that a later subpass reads.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

/// Throws XR_ERROR_FEATURE_UNSUPPORTED for the usage where the extension is not enabled.
inline void requireInputAttachmentUsage(const Instance &instance, XrSwapchainUsageFlags usage)
{
	if ((usage & XR_SWAPCHAIN_USAGE_INPUT_ATTACHMENT_BIT_KHR) && !instance.has(Extension::KHR_swapchain_usage_input_attachment_bit))
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "images as input attachments need XR_KHR_swapchain_usage_input_attachment_bit");
}

} // namespace arift::openxr
