// Which formats images can be shared in. Both processes ask their driver the same question: the library offers what the service makes.
#pragma once
#include <cstdint>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace arift::gpu
{

/// VkFormats, the runtime's favourite first; only those that `device` can share with every usage an application may ask for.
/// `query`: vkGetPhysicalDeviceImageFormatProperties2 of its instance.
std::vector<int64_t> swapchainFormats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query);

} // namespace arift::gpu
