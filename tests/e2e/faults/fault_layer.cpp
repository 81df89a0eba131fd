// A Vulkan layer that fails as drivers do. Files in the folder $ARIFT_FAULTS say how; those marked (once) are taken away when they have
// worked: device_lost (once; that device stays lost), no_memory, out_of_date (once), suboptimal (once), surface_lost (once).
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace
{

struct Instance {
	PFN_vkGetInstanceProcAddr next = nullptr;
	VkInstance handle = VK_NULL_HANDLE;
};
struct Device {
	PFN_vkGetDeviceProcAddr next = nullptr;
	VkDevice handle = VK_NULL_HANDLE;
	bool lost = false;
	template <typename Pfn> Pfn get(const char *name) const { return reinterpret_cast<Pfn>(next(handle, name)); }
};

std::mutex mutex;
std::map<void *, Instance> instances;
std::map<void *, Device> devices; // of queues as well: a queue has its device's dispatch table

void *tableOf(const void *handle) { return *static_cast<void *const *>(handle); }

Device deviceOf(const void *handle)
{
	std::lock_guard lock(mutex);
	return devices[tableOf(handle)];
}

std::string fileFor(const char *fault)
{
	const char *folder = std::getenv("ARIFT_FAULTS");
	return std::string(folder ? folder : "/nonexistent") + "/" + fault;
}
bool isAsked(const char *fault) { return ::access(fileFor(fault).c_str(), F_OK) == 0; }
bool takeOnce(const char *fault) { return ::unlink(fileFor(fault).c_str()) == 0; }

/// Whether the device is lost, now or since earlier.
bool isLost(const void *handle)
{
	const bool now = takeOnce("device_lost");
	std::lock_guard lock(mutex);
	Device &device = devices[tableOf(handle)];
	device.lost |= now;
	return device.lost;
}

template <typename Info> Info *linkOf(const void *next, VkStructureType type)
{
	for (auto *info = static_cast<Info *>(const_cast<void *>(next)); info; info = static_cast<Info *>(const_cast<void *>(info->pNext)))
		if (info->sType == type && info->function == VK_LAYER_LINK_INFO) return info;
	return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo *info, const VkAllocationCallbacks *allocator,
											  VkInstance *instance)
{
	auto *link = linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
	if (!link) return VK_ERROR_INITIALIZATION_FAILED;
	const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
	link->u.pLayerInfo = link->u.pLayerInfo->pNext;
	const VkResult result = reinterpret_cast<PFN_vkCreateInstance>(next(VK_NULL_HANDLE, "vkCreateInstance"))(info, allocator, instance);
	std::lock_guard lock(mutex);
	if (result == VK_SUCCESS) instances[tableOf(*instance)] = {next, *instance};
	return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
											const VkAllocationCallbacks *allocator, VkDevice *device)
{
	auto *link = linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
	if (!link) return VK_ERROR_INITIALIZATION_FAILED;
	const auto nextInstance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
	const auto nextDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
	link->u.pLayerInfo = link->u.pLayerInfo->pNext;
	VkInstance instance = VK_NULL_HANDLE;
	{
		std::lock_guard lock(mutex);
		instance = instances[tableOf(physical)].handle;
	}
	const VkResult result =
		reinterpret_cast<PFN_vkCreateDevice>(nextInstance(instance, "vkCreateDevice"))(physical, info, allocator, device);
	std::lock_guard lock(mutex);
	if (result == VK_SUCCESS) devices[tableOf(*device)] = {nextDevice, *device};
	return result;
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, uint32_t count, const VkSubmitInfo *submits, VkFence fence)
{
	if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
	return deviceOf(queue).get<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, uint32_t count, const VkFence *fences, VkBool32 all, uint64_t timeout)
{
	if (isLost(device)) return VK_ERROR_DEVICE_LOST;
	return deviceOf(device).get<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo *info, const VkAllocationCallbacks *allocator,
											  VkDeviceMemory *memory)
{
	if (isAsked("no_memory")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
	return deviceOf(device).get<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, allocator, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL acquireNextImage(VkDevice device, VkSwapchainKHR swapchain, uint64_t timeout, VkSemaphore semaphore,
												VkFence fence, uint32_t *index)
{
	if (takeOnce("out_of_date")) return VK_ERROR_OUT_OF_DATE_KHR;
	if (takeOnce("surface_lost")) return VK_ERROR_SURFACE_LOST_KHR;
	return deviceOf(device).get<PFN_vkAcquireNextImageKHR>("vkAcquireNextImageKHR")(device, swapchain, timeout, semaphore, fence, index);
}

VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR *info)
{
	const VkResult result = deviceOf(queue).get<PFN_vkQueuePresentKHR>("vkQueuePresentKHR")(queue, info);
	return result == VK_SUCCESS && takeOnce("suboptimal") ? VK_SUBOPTIMAL_KHR : result;
}

PFN_vkVoidFunction ours(const char *name)
{
	const std::pair<const char *, PFN_vkVoidFunction> all[] = {
		{"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
		{"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
		{"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(queueSubmit)},
		{"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(waitForFences)},
		{"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocateMemory)},
		{"vkAcquireNextImageKHR", reinterpret_cast<PFN_vkVoidFunction>(acquireNextImage)},
		{"vkQueuePresentKHR", reinterpret_cast<PFN_vkVoidFunction>(queuePresent)},
	};
	for (const auto &[known, function] : all)
		if (std::strcmp(known, name) == 0) return function;
	return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char *name)
{
	if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
	const Device found = deviceOf(device);
	const PFN_vkVoidFunction below = found.next(device, name);
	const PFN_vkVoidFunction function = ours(name);
	return below && function ? function : below;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char *name)
{
	if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(getInstanceProcAddr);
	if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
	if (const PFN_vkVoidFunction function = ours(name)) return function;
	if (!instance) return nullptr;
	std::lock_guard lock(mutex);
	return instances[tableOf(instance)].next(instance, name);
}

} // namespace

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *layer)
{
	layer->loaderLayerInterfaceVersion = 2;
	layer->pfnGetInstanceProcAddr = getInstanceProcAddr;
	layer->pfnGetDeviceProcAddr = getDeviceProcAddr;
	layer->pfnGetPhysicalDeviceProcAddr = nullptr;
	return VK_SUCCESS;
}
