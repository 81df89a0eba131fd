// Which GPU an application must use, and what it must enable there, so that it can share images with the service.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/vulkan/vulkan_api.h"
#include <string>
#include <vector>

namespace arift::openxr
{

struct PhysicalDeviceId {
	std::array<uint8_t, 16> deviceUuid{}, driverUuid{}; ///< zero where the instance cannot say
	uint32_t deviceType = 0;                            ///< VkPhysicalDeviceType
};
PhysicalDeviceId identify(const VulkanInstanceApi &vulkan, VkPhysicalDevice device);

/// The service's own device; else the first, with which it will make no session. Throws XR_ERROR_GRAPHICS_DEVICE_INVALID where there is
/// none.
VkPhysicalDevice choosePhysicalDevice(const VulkanInstanceApi &vulkan, VkInstance instance, const ipc::Welcome &welcome);

/// What the library needs beyond Vulkan 1.0: those of them that are there.
std::vector<const char *> neededInstanceExtensions(PFN_vkGetInstanceProcAddr loader);
std::vector<const char *> neededDeviceExtensions(const VulkanInstanceApi &vulkan, VkPhysicalDevice device);

/// `wanted` and what it lacks of `needed`; texts are not copied.
std::vector<const char *> unionOf(const char *const *wanted, uint32_t count, const std::vector<const char *> &needed);

} // namespace arift::openxr
