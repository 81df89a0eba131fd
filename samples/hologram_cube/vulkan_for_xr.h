// A Vulkan instance and device made through the runtime (XR_KHR_vulkan_enable2): it adds the extensions that it needs to share images.
#pragma once
#include "xr_helpers.h"
#include <algorithm>
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

struct Vulkan {
	vk::raii::Context context;
	vk::raii::Instance instance;
	vk::raii::PhysicalDevice physicalDevice;
	uint32_t queueFamily;
	vk::raii::Device device;

	Vulkan(XrInstance xr, XrSystemId system)
		: instance(createVulkanInstance(xr, system)),
		  physicalDevice(findGpu(xr, system)),
		  queueFamily(findQueueFamily()),
		  device(createDevice(xr, system))
	{
	}

private:
	vk::raii::Instance createVulkanInstance(XrInstance xr, XrSystemId system)
	{
		XrGraphicsRequirementsVulkan2KHR needs{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
		check(load<PFN_xrGetVulkanGraphicsRequirements2KHR>(xr, "xrGetVulkanGraphicsRequirements2KHR")(xr, system, &needs),
			  "xrGetVulkanGraphicsRequirements2KHR");
		const uint32_t version =
			VK_MAKE_API_VERSION(0, XR_VERSION_MAJOR(needs.minApiVersionSupported), XR_VERSION_MINOR(needs.minApiVersionSupported), 0);
		const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
											.apiVersion = std::max(version, VK_API_VERSION_1_1)};
		const VkInstanceCreateInfo vulkanInfo{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
		XrVulkanInstanceCreateInfoKHR info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
		info.systemId = system;
		info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
		info.vulkanCreateInfo = &vulkanInfo;
		VkInstance created;
		VkResult result;
		check(load<PFN_xrCreateVulkanInstanceKHR>(xr, "xrCreateVulkanInstanceKHR")(xr, &info, &created, &result),
			  "xrCreateVulkanInstanceKHR");
		if (result != VK_SUCCESS) throw std::runtime_error("no Vulkan instance: " + vk::to_string(vk::Result(result)));
		return {context, created};
	}
	vk::raii::PhysicalDevice findGpu(XrInstance xr, XrSystemId system)
	{
		const XrVulkanGraphicsDeviceGetInfoKHR info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR, nullptr, system, *instance};
		VkPhysicalDevice gpu;
		check(load<PFN_xrGetVulkanGraphicsDevice2KHR>(xr, "xrGetVulkanGraphicsDevice2KHR")(xr, &info, &gpu),
			  "xrGetVulkanGraphicsDevice2KHR");
		return {instance, gpu};
	}
	uint32_t findQueueFamily() const
	{
		const auto families = physicalDevice.getQueueFamilyProperties();
		const auto draws = [](const auto &family) { return bool(family.queueFlags & vk::QueueFlagBits::eGraphics); };
		const auto found = std::ranges::find_if(families, draws);
		if (found == families.end()) throw std::runtime_error("the headset's GPU cannot draw");
		return uint32_t(found - families.begin());
	}
	vk::raii::Device createDevice(XrInstance xr, XrSystemId system) const
	{
		const float priority = 1;
		const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
											.queueFamilyIndex = queueFamily,
											.queueCount = 1,
											.pQueuePriorities = &priority};
		const VkDeviceCreateInfo vulkanInfo{
			.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
		XrVulkanDeviceCreateInfoKHR info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
		info.systemId = system;
		info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
		info.vulkanPhysicalDevice = *physicalDevice;
		info.vulkanCreateInfo = &vulkanInfo;
		VkDevice created;
		VkResult result;
		check(load<PFN_xrCreateVulkanDeviceKHR>(xr, "xrCreateVulkanDeviceKHR")(xr, &info, &created, &result), "xrCreateVulkanDeviceKHR");
		if (result != VK_SUCCESS) throw std::runtime_error("no Vulkan device: " + vk::to_string(vk::Result(result)));
		return {physicalDevice, created};
	}
};
