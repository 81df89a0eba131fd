#include "runtime/openxr/vulkan/physical_device.h"
#include <algorithm>
#include <cstring>

namespace arift::openxr
{
namespace
{

constexpr std::array instanceExtensions{VK_KHR_GET_PHYSICAL_DEVICE_PROPERTIES_2_EXTENSION_NAME,
										VK_KHR_EXTERNAL_MEMORY_CAPABILITIES_EXTENSION_NAME};
constexpr std::array deviceExtensions{VK_KHR_EXTERNAL_MEMORY_EXTENSION_NAME, VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME,
									  VK_KHR_GET_MEMORY_REQUIREMENTS_2_EXTENSION_NAME, VK_KHR_DEDICATED_ALLOCATION_EXTENSION_NAME};

bool contains(const std::vector<const char *> &names, const char *name)
{
	return std::ranges::any_of(names, [&](const char *other) { return std::strcmp(name, other) == 0; });
}

/// Vulkan's own two-call idiom; enumerate(count, elements) returns a VkResult.
template <typename Element, typename Enumerate> std::vector<Element> listOf(const char *call, Enumerate enumerate)
{
	uint32_t count = 0;
	requireSuccess(enumerate(&count, nullptr), call);
	std::vector<Element> elements(count);
	requireSuccess(enumerate(&count, elements.data()), call);
	elements.resize(count);
	return elements;
}

template <size_t size>
std::vector<const char *> presentOnes(const std::array<const char *, size> &wanted, const std::vector<VkExtensionProperties> &present)
{
	std::vector<const char *> names;
	for (const char *name : wanted)
		if (std::ranges::any_of(present, [&](const VkExtensionProperties &p) { return std::strcmp(p.extensionName, name) == 0; }))
			names.push_back(name);
	return names;
}

} // namespace

PhysicalDeviceId identify(const VulkanInstanceApi &vulkan, VkPhysicalDevice device)
{
	PhysicalDeviceId id;
	VkPhysicalDeviceIDProperties uuids{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
	VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &uuids};
	if (vulkan.GetPhysicalDeviceProperties2)
		vulkan.GetPhysicalDeviceProperties2(device, &properties);
	else
		vulkan.GetPhysicalDeviceProperties(device, &properties.properties);
	std::ranges::copy(uuids.deviceUUID, id.deviceUuid.begin());
	std::ranges::copy(uuids.driverUUID, id.driverUuid.begin());
	id.deviceType = properties.properties.deviceType;
	return id;
}

VkPhysicalDevice choosePhysicalDevice(const VulkanInstanceApi &vulkan, VkInstance instance, const ipc::Welcome &welcome)
{
	const auto devices = listOf<VkPhysicalDevice>("vkEnumeratePhysicalDevices", [&](uint32_t *count, VkPhysicalDevice *elements) {
		return vulkan.EnumeratePhysicalDevices(instance, count, elements);
	});
	if (devices.empty()) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "Vulkan has no device");
	const auto own = std::ranges::find_if(devices, [&](VkPhysicalDevice device) {
		const PhysicalDeviceId id = identify(vulkan, device);
		return id.driverUuid == welcome.driverUuid && id.deviceUuid == welcome.deviceUuid;
	});
	return own != devices.end() ? *own : devices.front();
}

std::vector<const char *> neededInstanceExtensions(PFN_vkGetInstanceProcAddr loader)
{
	const auto enumerate =
		reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(loader(nullptr, "vkEnumerateInstanceExtensionProperties"));
	if (!enumerate) throw Error(XR_ERROR_RUNTIME_FAILURE, "Vulkan has no vkEnumerateInstanceExtensionProperties");
	return presentOnes(instanceExtensions, listOf<VkExtensionProperties>("vkEnumerateInstanceExtensionProperties",
																		 [&](uint32_t *count, VkExtensionProperties *elements) {
																			 return enumerate(nullptr, count, elements);
																		 }));
}

std::vector<const char *> neededDeviceExtensions(const VulkanInstanceApi &vulkan, VkPhysicalDevice device)
{
	return presentOnes(deviceExtensions, listOf<VkExtensionProperties>(
											 "vkEnumerateDeviceExtensionProperties", [&](uint32_t *count, VkExtensionProperties *elements) {
												 return vulkan.EnumerateDeviceExtensionProperties(device, nullptr, count, elements);
											 }));
}

std::vector<const char *> unionOf(const char *const *wanted, uint32_t count, const std::vector<const char *> &needed)
{
	std::vector<const char *> all(wanted, wanted + count);
	for (const char *name : needed)
		if (!contains(all, name)) all.push_back(name);
	return all;
}

} // namespace arift::openxr
