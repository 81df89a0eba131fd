#include "runtime/openxr/ext/khr_vulkan_enable2.h"
#include "runtime/openxr/ext/khr_vulkan_enable.h"
#include "runtime/openxr/vulkan/physical_device.h"

namespace arift::openxr
{
namespace
{

/// What both creation structures have in common.
template <typename Info> void requireInfo(const Instance &instance, const Info &info)
{
	instance.requireSystem(info.systemId);
	if (info.createFlags != 0) throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags is {:#x}, not 0", info.createFlags);
	if (!info.pfnGetInstanceProcAddr) throw Error(XR_ERROR_VALIDATION_FAILURE, "pfnGetInstanceProcAddr is null");
	if (!info.vulkanCreateInfo) throw Error(XR_ERROR_VALIDATION_FAILURE, "vulkanCreateInfo is null");
}

} // namespace

void createVulkanInstance(Instance &instance, const XrVulkanInstanceCreateInfoKHR &info, VkInstance &vkInstance, VkResult &result)
{
	requireInfo(instance, info);
	const auto create = reinterpret_cast<PFN_vkCreateInstance>(info.pfnGetInstanceProcAddr(nullptr, "vkCreateInstance"));
	if (!create) throw Error(XR_ERROR_VALIDATION_FAILURE, "pfnGetInstanceProcAddr finds no vkCreateInstance");
	VkInstanceCreateInfo createInfo = *info.vulkanCreateInfo;
	const auto extensions = unionOf(createInfo.ppEnabledExtensionNames, createInfo.enabledExtensionCount,
									neededInstanceExtensions(info.pfnGetInstanceProcAddr));
	createInfo.enabledExtensionCount = uint32_t(extensions.size());
	createInfo.ppEnabledExtensionNames = extensions.data();
	result = create(&createInfo, info.vulkanAllocator, &vkInstance);
	if (result != VK_SUCCESS) return;
	instance.vulkanLoader = info.pfnGetInstanceProcAddr;
	instance.vulkanInstance = vkInstance;
}

void createVulkanDevice(Instance &instance, const XrVulkanDeviceCreateInfoKHR &info, VkDevice &device, VkResult &result)
{
	requireInfo(instance, info);
	if (!info.vulkanPhysicalDevice) throw Error(XR_ERROR_VALIDATION_FAILURE, "vulkanPhysicalDevice is null");
	if (!instance.vulkanInstance)
		throw Error(XR_ERROR_CALL_ORDER_INVALID, "the VkInstance of vulkanPhysicalDevice is not known to the runtime");
	const VulkanInstanceApi api(info.pfnGetInstanceProcAddr, instance.vulkanInstance);
	VkDeviceCreateInfo createInfo = *info.vulkanCreateInfo;
	const auto extensions = unionOf(createInfo.ppEnabledExtensionNames, createInfo.enabledExtensionCount,
									neededDeviceExtensions(api, info.vulkanPhysicalDevice));
	createInfo.enabledExtensionCount = uint32_t(extensions.size());
	createInfo.ppEnabledExtensionNames = extensions.data();
	result = api.CreateDevice(info.vulkanPhysicalDevice, &createInfo, info.vulkanAllocator, &device);
}

void getVulkanGraphicsDevice2(Instance &instance, const XrVulkanGraphicsDeviceGetInfoKHR &info, VkPhysicalDevice &device)
{
	getVulkanGraphicsDevice(instance, info.systemId, info.vulkanInstance, device);
	instance.vulkanInstance = info.vulkanInstance;
}

} // namespace arift::openxr
