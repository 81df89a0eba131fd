#include "runtime/openxr/ext/khr_vulkan_enable.h"
#include "runtime/openxr/vulkan/vulkan_graphics.h"
#include <dlfcn.h>

namespace arift::openxr
{
namespace
{

std::string joined(const std::vector<const char *> &names)
{
	std::string text;
	for (const char *name : names) text += text.empty() ? name : fmt::format(" {}", name);
	return text;
}

/// A Vulkan instance for one question about the devices; the application has none to ask yet.
class BriefInstance
{
public:
	explicit BriefInstance(PFN_vkGetInstanceProcAddr loader) : instance_(create(loader)), api(loader, instance_) {}
	~BriefInstance() { api.DestroyInstance(instance_, nullptr); }
	BriefInstance(const BriefInstance &) = delete;
	VkInstance get() const { return instance_; }

private:
	static VkInstance create(PFN_vkGetInstanceProcAddr loader)
	{
		const auto createInstance = reinterpret_cast<PFN_vkCreateInstance>(loader(nullptr, "vkCreateInstance"));
		if (!createInstance) throw Error(XR_ERROR_RUNTIME_FAILURE, "Vulkan has no vkCreateInstance");
		const auto extensions = neededInstanceExtensions(loader);
		const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
										.enabledExtensionCount = uint32_t(extensions.size()),
										.ppEnabledExtensionNames = extensions.data()};
		VkInstance instance = VK_NULL_HANDLE;
		requireSuccess(createInstance(&info, nullptr, &instance), "vkCreateInstance");
		return instance;
	}
	VkInstance instance_;

public:
	const VulkanInstanceApi api;
};

} // namespace

PFN_vkGetInstanceProcAddr vulkanLoaderOf(Instance &instance)
{
	if (const auto loader = instance.vulkanLoader.load()) return loader;
	void *library = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL); // stays open: the application's objects are its own
	if (!library) throw Error(XR_ERROR_RUNTIME_FAILURE, "Vulkan cannot be opened: {}", ::dlerror());
	const auto loader = reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library, "vkGetInstanceProcAddr"));
	if (!loader) throw Error(XR_ERROR_RUNTIME_FAILURE, "libvulkan.so.1 has no vkGetInstanceProcAddr");
	instance.vulkanLoader = loader;
	return loader;
}

std::unique_ptr<Graphics> makeVulkanGraphics(Instance &instance, const XrGraphicsBindingVulkanKHR &binding)
{
	if (!instance.vulkanRequirementsKnown)
		throw Error(XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING, "the Vulkan graphics requirements were not asked for");
	if (!binding.instance) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding has no VkInstance");
	const VulkanInstanceApi api(vulkanLoaderOf(instance), binding.instance);
	if (binding.physicalDevice != choosePhysicalDevice(api, binding.instance, instance.service.welcome()))
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the VkPhysicalDevice is not the one the runtime named");
	return std::make_unique<VulkanGraphics>(api, binding);
}

XrResult getVulkanInstanceExtensions(Instance &instance, XrSystemId system, OutputArray<char> buffer)
{
	instance.requireSystem(system);
	return assignText(buffer, joined(neededInstanceExtensions(vulkanLoaderOf(instance))));
}

XrResult getVulkanDeviceExtensions(Instance &instance, XrSystemId system, OutputArray<char> buffer)
{
	instance.requireSystem(system);
	const BriefInstance vulkan(vulkanLoaderOf(instance));
	const VkPhysicalDevice device = choosePhysicalDevice(vulkan.api, vulkan.get(), instance.service.welcome());
	return assignText(buffer, joined(neededDeviceExtensions(vulkan.api, device)));
}

void getVulkanGraphicsDevice(Instance &instance, XrSystemId system, VkInstance vkInstance, VkPhysicalDevice &device)
{
	instance.requireSystem(system);
	if (!vkInstance) throw Error(XR_ERROR_VALIDATION_FAILURE, "the VkInstance is null");
	device = choosePhysicalDevice(VulkanInstanceApi(vulkanLoaderOf(instance), vkInstance), vkInstance, instance.service.welcome());
}

void getVulkanGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsVulkanKHR &requirements)
{
	instance.requireSystem(system);
	requirements.minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
	requirements.maxApiVersionSupported = XR_MAKE_VERSION(1, 0x3ff, 0xfff);
	instance.vulkanRequirementsKnown = true;
}

} // namespace arift::openxr
