// Which formats swapchains may have: what the service's device can share and the application's can draw in.
#pragma once
#include <cstdint>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace arift::gpu
{

/// VkFormats, the runtime's favourite first; only those that `device` can share with every usage an application may ask for.
/// `query`: vkGetPhysicalDeviceImageFormatProperties2 of its instance.
std::vector<int64_t> swapchainFormats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query);
/// The same without sharing.
std::vector<int64_t> drawableFormats(VkPhysicalDevice device, PFN_vkGetPhysicalDeviceImageFormatProperties2 query);

} // namespace arift::gpu
