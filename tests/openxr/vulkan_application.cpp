#include "tests/openxr/vulkan_application.h"
#include <cstring>

namespace arift
{
namespace
{

constexpr const char *validationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
									const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
	++*static_cast<int *>(user);
	ADD_FAILURE() << data->pMessage;
	return VK_FALSE;
}

} // namespace

VulkanApplication::VulkanApplication(std::vector<const char *> extensions)
	: application((extensions.push_back("XR_KHR_vulkan_enable2"), extensions)), loader_(::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL))
{
	getInstanceProcAddr_ = reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(loader_, "vkGetInstanceProcAddr"));
	const XrSystemId system = application.system();
	XrGraphicsRequirementsVulkan2KHR requirements{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
	EXPECT_EQ(application.get<PFN_xrGetVulkanGraphicsRequirements2KHR>("xrGetVulkanGraphicsRequirements2KHR")(application.instance, system,
																											  &requirements),
			  XR_SUCCESS);
	makeInstance(system);
	listen();
	makeDevice(system);
}

VulkanApplication::~VulkanApplication()
{
	vulkan<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
	vulkan<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(device, pool_, nullptr);
	vulkan<PFN_vkDestroyDevice>("vkDestroyDevice")(device, nullptr);
	if (messenger_) vulkan<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance, messenger_, nullptr);
	vulkan<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, nullptr);
	::dlclose(loader_);
}

void VulkanApplication::makeInstance(XrSystemId system)
{
	uint32_t count = 0;
	const auto enumerate = vulkan<PFN_vkEnumerateInstanceLayerProperties>("vkEnumerateInstanceLayerProperties");
	enumerate(&count, nullptr);
	std::vector<VkLayerProperties> layers(count);
	enumerate(&count, layers.data());
	for (const VkLayerProperties &layer : layers) validates_ |= std::strcmp(layer.layerName, validationLayer) == 0;
	const char *extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
	const VkApplicationInfo about{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_1};
	const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
									.pApplicationInfo = &about,
									.enabledLayerCount = validates_ ? 1u : 0u,
									.ppEnabledLayerNames = &validationLayer,
									.enabledExtensionCount = validates_ ? 1u : 0u,
									.ppEnabledExtensionNames = &extension};
	const XrVulkanInstanceCreateInfoKHR create{.type = XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR,
											   .systemId = system,
											   .pfnGetInstanceProcAddr = getInstanceProcAddr_,
											   .vulkanCreateInfo = &info};
	VkResult result = VK_ERROR_UNKNOWN;
	EXPECT_EQ(
		application.get<PFN_xrCreateVulkanInstanceKHR>("xrCreateVulkanInstanceKHR")(application.instance, &create, &instance, &result),
		XR_SUCCESS);
	EXPECT_EQ(result, VK_SUCCESS);
}

void VulkanApplication::listen()
{
	if (!validates_) return;
	const VkDebugUtilsMessengerCreateInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
												  .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT |
																	 VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
												  .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
												  .pfnUserCallback = hear,
												  .pUserData = &complaints_};
	vulkan<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(instance, &info, nullptr, &messenger_);
}

void VulkanApplication::makeDevice(XrSystemId system)
{
	const XrVulkanGraphicsDeviceGetInfoKHR get{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR, nullptr, system, instance};
	EXPECT_EQ(application.get<PFN_xrGetVulkanGraphicsDevice2KHR>("xrGetVulkanGraphicsDevice2KHR")(application.instance, &get, &physical),
			  XR_SUCCESS);
	const float priority = 1;
	const VkDeviceQueueCreateInfo queue{
		.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
	const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
	const XrVulkanDeviceCreateInfoKHR create{.type = XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR,
											 .systemId = system,
											 .pfnGetInstanceProcAddr = getInstanceProcAddr_,
											 .vulkanPhysicalDevice = physical,
											 .vulkanCreateInfo = &info};
	VkResult result = VK_ERROR_UNKNOWN;
	EXPECT_EQ(application.get<PFN_xrCreateVulkanDeviceKHR>("xrCreateVulkanDeviceKHR")(application.instance, &create, &device, &result),
			  XR_SUCCESS);
	EXPECT_EQ(result, VK_SUCCESS);
	binding.instance = instance;
	binding.physicalDevice = physical;
	binding.device = device;
	vulkan<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, 0, 0, &queue_);
	const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
	vulkan<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device, &pool, nullptr, &pool_);
}

void VulkanApplication::clear(VkImage image, float value, VkFormat format)
{
	const VkCommandBufferAllocateInfo allocate{
		.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool_, .commandBufferCount = 1};
	VkCommandBuffer commands = VK_NULL_HANDLE;
	vulkan<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(device, &allocate, &commands);
	const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
	vulkan<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &begin);
	const bool isDepth = gpu::isDepth(format);
	const VkAccessFlags attachment = isDepth ? VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT : VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
	const VkPipelineStageFlags stage = isDepth ? VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT : VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
	const VkImageSubresourceRange all{gpu::aspectOf(format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
	VkImageMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
								 .srcAccessMask = attachment,
								 .dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
								 .oldLayout = gpu::boundaryLayout(format),
								 .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
								 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
								 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
								 .image = image,
								 .subresourceRange = all};
	const auto pipelineBarrier = vulkan<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier");
	pipelineBarrier(commands, stage, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
	const VkClearColorValue colour{{value, 0, 0, 1}};
	const VkClearDepthStencilValue depth{value, 0};
	constexpr VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
	if (isDepth)
		vulkan<PFN_vkCmdClearDepthStencilImage>("vkCmdClearDepthStencilImage")(commands, image, layout, &depth, 1, &all);
	else
		vulkan<PFN_vkCmdClearColorImage>("vkCmdClearColorImage")(commands, image, layout, &colour, 1, &all);
	std::swap(barrier.srcAccessMask, barrier.dstAccessMask);
	std::swap(barrier.oldLayout, barrier.newLayout);
	pipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
	vulkan<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands);
	const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
	vulkan<PFN_vkQueueSubmit>("vkQueueSubmit")(queue_, 1, &submit, VK_NULL_HANDLE);
}

} // namespace arift
