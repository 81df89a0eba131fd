// Vulkan's functions as this library calls them: found through the application's loader, never linked.
#pragma once
#include "runtime/openxr/error.h"

namespace arift::openxr
{

#define ARIFT_VK_INSTANCE_FUNCTIONS(X)                                                                                                     \
	X(EnumeratePhysicalDevices)                                                                                                            \
	X(EnumerateDeviceExtensionProperties)                                                                                                  \
	X(GetPhysicalDeviceProperties)                                                                                                         \
	X(GetPhysicalDeviceImageFormatProperties)                                                                                              \
	X(GetPhysicalDeviceMemoryProperties)                                                                                                   \
	X(GetPhysicalDeviceQueueFamilyProperties)                                                                                              \
	X(GetDeviceProcAddr)                                                                                                                   \
	X(CreateDevice)                                                                                                                        \
	X(DestroyInstance)

#define ARIFT_VK_DEVICE_FUNCTIONS(X)                                                                                                       \
	X(GetDeviceQueue)                                                                                                                      \
	X(QueueSubmit)                                                                                                                         \
	X(CreateFence)                                                                                                                         \
	X(DestroyFence)                                                                                                                        \
	X(ResetFences)                                                                                                                         \
	X(GetFenceStatus)                                                                                                                      \
	X(WaitForFences)                                                                                                                       \
	X(CreateImage)                                                                                                                         \
	X(DestroyImage)                                                                                                                        \
	X(GetImageMemoryRequirements)                                                                                                          \
	X(AllocateMemory)                                                                                                                      \
	X(FreeMemory)                                                                                                                          \
	X(MapMemory)                                                                                                                           \
	X(UnmapMemory)                                                                                                                         \
	X(CreateBuffer)                                                                                                                        \
	X(DestroyBuffer)                                                                                                                       \
	X(GetBufferMemoryRequirements)                                                                                                         \
	X(BindBufferMemory)                                                                                                                    \
	X(BindImageMemory)                                                                                                                     \
	X(CreateCommandPool)                                                                                                                   \
	X(DestroyCommandPool)                                                                                                                  \
	X(AllocateCommandBuffers)                                                                                                              \
	X(BeginCommandBuffer)                                                                                                                  \
	X(EndCommandBuffer)                                                                                                                    \
	X(CmdCopyImageToBuffer)                                                                                                                \
	X(CmdPipelineBarrier)

#define ARIFT_MEMBER(name) PFN_vk##name name;
struct VulkanInstanceApi {
	ARIFT_VK_INSTANCE_FUNCTIONS(ARIFT_MEMBER)
	/// Of Vulkan 1.1 or VK_KHR_get_physical_device_properties2; null where the application's instance has neither.
	PFN_vkGetPhysicalDeviceProperties2 GetPhysicalDeviceProperties2;
	PFN_vkGetPhysicalDeviceImageFormatProperties2 GetPhysicalDeviceImageFormatProperties2;
	/// Throws XR_ERROR_GRAPHICS_DEVICE_INVALID.
	VulkanInstanceApi(PFN_vkGetInstanceProcAddr loader, VkInstance instance);
};
struct VulkanDeviceApi {
	ARIFT_VK_DEVICE_FUNCTIONS(ARIFT_MEMBER)
	/// Throws XR_ERROR_GRAPHICS_DEVICE_INVALID.
	VulkanDeviceApi(PFN_vkGetDeviceProcAddr loader, VkDevice device);
};
#undef ARIFT_MEMBER

/// Throws XR_ERROR_RUNTIME_FAILURE that names the call.
void requireSuccess(VkResult result, const char *call);

} // namespace arift::openxr
