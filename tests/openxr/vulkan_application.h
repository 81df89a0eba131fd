// A Vulkan application's instance, device and queue, made through XR_KHR_vulkan_enable2, with the validation layer where it is installed.
#pragma once
#include "runtime/gpu/image_spec.h"
#include "runtime/openxr/vulkan/vulkan_api.h"
#include "tests/openxr/application.h"
#include <memory>

namespace arift
{

class VulkanApplication
{
public:
	/// `extensions`: besides XR_KHR_vulkan_enable2.
	explicit VulkanApplication(std::vector<const char *> extensions = {});
	~VulkanApplication();
	VulkanApplication(const VulkanApplication &) = delete;

	/// Fills the image with opaque red, or with that depth, as an application would: from the layout it is handed over in, and back to it.
	void clear(VkImage image, float value, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB);
	PFN_vkGetInstanceProcAddr getInstanceProcAddr() const { return getInstanceProcAddr_; }
	/// Messages of the validation layer so far.
	int complaints() const { return complaints_; }

	Application application;
	VkInstance instance = VK_NULL_HANDLE;
	VkPhysicalDevice physical = VK_NULL_HANDLE;
	VkDevice device = VK_NULL_HANDLE;
	XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};

private:
	template <typename Pfn> Pfn vulkan(const char *name) const { return reinterpret_cast<Pfn>(getInstanceProcAddr_(instance, name)); }
	void makeInstance(XrSystemId system);
	void makeDevice(XrSystemId system);
	void listen();

	void *loader_;
	PFN_vkGetInstanceProcAddr getInstanceProcAddr_;
	bool validates_ = false;
	int complaints_ = 0;
	VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
	VkQueue queue_ = VK_NULL_HANDLE;
	VkCommandPool pool_ = VK_NULL_HANDLE;
};

} // namespace arift
