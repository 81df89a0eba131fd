// What the library makes of an application's Vulkan, with a Vulkan that is a table of functions.
#include "runtime/openxr/vulkan/vulkan_graphics.h"
#include <cstring>
#include <gtest/gtest.h>

namespace arift::openxr
{
namespace
{

using Uuid = std::array<uint8_t, 16>;
struct Gpu {
	Uuid device, driver;
};
std::vector<Gpu> gpus; ///< a VkPhysicalDevice is an index here, counted from 1
VkResult fenceResult = VK_SUCCESS;

VkPhysicalDevice deviceNumber(size_t number) { return reinterpret_cast<VkPhysicalDevice>(number); }

VKAPI_ATTR VkResult VKAPI_CALL enumeratePhysicalDevices(VkInstance, uint32_t *count, VkPhysicalDevice *devices)
{
	for (size_t i = 0; devices && i < gpus.size(); ++i) devices[i] = deviceNumber(i + 1);
	*count = uint32_t(gpus.size());
	return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL getPhysicalDeviceProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2 *properties)
{
	const Gpu &gpu = gpus[reinterpret_cast<size_t>(device) - 1];
	auto &uuids = *static_cast<VkPhysicalDeviceIDProperties *>(properties->pNext);
	std::ranges::copy(gpu.device, uuids.deviceUUID);
	std::ranges::copy(gpu.driver, uuids.driverUUID);
	properties->properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice, uint32_t, const VkFence *, VkBool32, uint64_t) { return fenceResult; }

VKAPI_ATTR void VKAPI_CALL unused() { ADD_FAILURE() << "a function the test does not provide"; }

PFN_vkVoidFunction functionNamed(const char *name)
{
	const std::string_view wanted = name;
	if (wanted == "vkEnumeratePhysicalDevices") return reinterpret_cast<PFN_vkVoidFunction>(enumeratePhysicalDevices);
	if (wanted == "vkGetPhysicalDeviceProperties2KHR") return reinterpret_cast<PFN_vkVoidFunction>(getPhysicalDeviceProperties2);
	if (wanted == "vkWaitForFences") return reinterpret_cast<PFN_vkVoidFunction>(waitForFences);
	if (wanted == "vkGetPhysicalDeviceProperties2") return nullptr; // an instance of Vulkan 1.0 with the extension
	return unused;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL ofInstance(VkInstance, const char *name) { return functionNamed(name); }
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL ofDevice(VkDevice, const char *name) { return functionNamed(name); }

TEST(PhysicalDevice, IsTheServicesOwnOrTheFirst)
{
	const Uuid one{1}, two{2}, driver{9}, otherDriver{8};
	const VulkanInstanceApi vulkan(ofInstance, nullptr);
	ipc::Welcome welcome;
	welcome.deviceUuid = two;
	welcome.driverUuid = driver;
	welcome.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
	gpus = {{two, otherDriver}, {one, driver}, {two, driver}};
	EXPECT_EQ(choosePhysicalDevice(vulkan, nullptr, welcome), deviceNumber(3));
	gpus.pop_back();
	EXPECT_EQ(choosePhysicalDevice(vulkan, nullptr, welcome), deviceNumber(1)) << "the service takes none but its own: none is better";
	gpus.clear();
	EXPECT_THROW(choosePhysicalDevice(vulkan, nullptr, welcome), Error);
}

TEST(Fence, ALostDeviceIsNotWorkThatTakesItsTime)
{
	const VulkanDeviceApi vulkan(ofDevice, nullptr);
	const FencePool pool(vulkan, nullptr);
	using Outcome = Completion::Outcome;
	for (const auto &[result, outcome] :
		 {std::pair(VK_SUCCESS, Outcome::done), std::pair(VK_TIMEOUT, Outcome::notYet), std::pair(VK_ERROR_DEVICE_LOST, Outcome::failed),
		  std::pair(VK_ERROR_OUT_OF_HOST_MEMORY, Outcome::failed)}) {
		fenceResult = result;
		EXPECT_EQ(pool.wait(VK_NULL_HANDLE, 0), outcome) << "VkResult " << result;
	}
}

} // namespace
} // namespace arift::openxr
