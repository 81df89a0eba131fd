// XR_KHR_vulkan_enable: the application makes its Vulkan instance and device itself, with the extensions it is told.
#pragma once
#include "runtime/openxr/graphics.h"
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

/// The binding of either Vulkan extension. Throws XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING or XR_ERROR_GRAPHICS_DEVICE_INVALID.
std::unique_ptr<Graphics> makeVulkanGraphics(Instance &instance, const XrGraphicsBindingVulkanKHR &binding);
/// The loader the application gave to xrCreateVulkanInstanceKHR, or else the system's, which is opened when it is first needed.
PFN_vkGetInstanceProcAddr vulkanLoaderOf(Instance &instance);

XrResult getVulkanInstanceExtensions(Instance &instance, XrSystemId system, OutputArray<char> buffer);
XrResult getVulkanDeviceExtensions(Instance &instance, XrSystemId system, OutputArray<char> buffer);
void getVulkanGraphicsDevice(Instance &instance, XrSystemId system, VkInstance vkInstance, VkPhysicalDevice &device);
void getVulkanGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsVulkanKHR &requirements);

} // namespace arift::openxr
