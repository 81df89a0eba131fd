#include "runtime/openxr/vulkan/vulkan_api.h"
#include <string>

namespace arift::openxr
{
namespace
{

template <typename Pfn, typename Loader, typename Owner> Pfn find(Loader loader, Owner owner, const char *name)
{
	const auto function = reinterpret_cast<Pfn>(loader(owner, name));
	if (!function) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the application's Vulkan has no {}", name);
	return function;
}

/// By its name in the core, or as the extension's.
template <typename Pfn> Pfn findIfThere(PFN_vkGetInstanceProcAddr loader, VkInstance owner, const std::string &name)
{
	const PFN_vkVoidFunction core = loader(owner, name.c_str());
	return reinterpret_cast<Pfn>(core ? core : loader(owner, (name + "KHR").c_str()));
}

} // namespace

#define ARIFT_FIND(name) name(find<PFN_vk##name>(loader, owner, "vk" #name)),

VulkanInstanceApi::VulkanInstanceApi(PFN_vkGetInstanceProcAddr loader, VkInstance owner)
	: ARIFT_VK_INSTANCE_FUNCTIONS(ARIFT_FIND)
		  GetPhysicalDeviceProperties2(findIfThere<PFN_vkGetPhysicalDeviceProperties2>(loader, owner, "vkGetPhysicalDeviceProperties2")),
	  GetPhysicalDeviceImageFormatProperties2(
		  findIfThere<PFN_vkGetPhysicalDeviceImageFormatProperties2>(loader, owner, "vkGetPhysicalDeviceImageFormatProperties2"))
{
}

#undef ARIFT_FIND
#define ARIFT_FIND(name) name = find<PFN_vk##name>(loader, owner, "vk" #name);

VulkanDeviceApi::VulkanDeviceApi(PFN_vkGetDeviceProcAddr loader, VkDevice owner) { ARIFT_VK_DEVICE_FUNCTIONS(ARIFT_FIND) }

#undef ARIFT_FIND

void requireSuccess(VkResult result, const char *call)
{
	if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
		throw Error(XR_ERROR_OUT_OF_MEMORY, "{} returned VkResult {}", call, int(result));
	if (result < 0) throw Error(XR_ERROR_RUNTIME_FAILURE, "{} returned VkResult {}", call, int(result));
}

} // namespace arift::openxr
