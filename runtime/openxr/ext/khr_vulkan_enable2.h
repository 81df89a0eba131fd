// XR_KHR_vulkan_enable2: the runtime makes the application's Vulkan instance and device, adding the extensions it needs.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

void createVulkanInstance(Instance &instance, const XrVulkanInstanceCreateInfoKHR &info, VkInstance &vkInstance, VkResult &result);
void createVulkanDevice(Instance &instance, const XrVulkanDeviceCreateInfoKHR &info, VkDevice &device, VkResult &result);
void getVulkanGraphicsDevice2(Instance &instance, const XrVulkanGraphicsDeviceGetInfoKHR &info, VkPhysicalDevice &device);

} // namespace arift::openxr
