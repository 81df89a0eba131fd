#include "runtime/gpu/handles.h"
#include "runtime/base/error.h"
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace arift::gpu
{

namespace
{

using namespace std::chrono_literals;

VKAPI_ATTR VkBool32 VKAPI_CALL countMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
											const VkDebugUtilsMessengerCallbackDataEXT *data, void *counter)
{
	static_cast<std::atomic<uint64_t> *>(counter)->fetch_add(1);
	log::error("vulkan: {}", data->pMessage);
	return VK_FALSE;
}

bool validationWanted()
{
	const char *value = std::getenv("ARIFT_VULKAN_VALIDATION");
	return value && std::strcmp(value, "1") == 0;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(std::atomic<uint64_t> &counter)
{
	using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
	using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
	return {{}, Severity::eWarning | Severity::eError, Type::eValidation | Type::ePerformance, &countMessage, &counter};
}

vk::raii::Instance makeInstance(const vk::raii::Context &context, std::vector<const char *> extensions, std::atomic<uint64_t> &counter)
{
	const vk::ApplicationInfo application{"arift-service", 1, "ARift", 1, VK_API_VERSION_1_1};
	std::vector<const char *> layers;
	auto messenger = messengerInfo(counter);
	const std::array checks{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
	const vk::ValidationFeaturesEXT features{checks, {}, &messenger};
	const void *chain = nullptr;
	if (validationWanted()) {
		layers.push_back("VK_LAYER_KHRONOS_validation");
		extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
		extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
		chain = &features;
	}
	try {
		return {context, vk::InstanceCreateInfo{{}, &application, layers, extensions, chain}};
	} catch (const vk::SystemError &e) {
		throw std::runtime_error(
			fmt::format("no Vulkan instance could be made ({}){}", e.what(),
						validationWanted() ? "; ARIFT_VULKAN_VALIDATION=1 needs the package vulkan-validationlayers" : ""));
	}
}

bool has(const std::vector<vk::ExtensionProperties> &extensions, const char *name)
{
	for (const auto &extension : extensions)
		if (std::strcmp(extension.extensionName, name) == 0) return true;
	return false;
}

std::optional<uint32_t> graphicsFamily(const vk::raii::PhysicalDevice &physical)
{
	const auto families = physical.getQueueFamilyProperties();
	for (uint32_t i = 0; i < families.size(); ++i)
		if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) return i;
	return std::nullopt;
}

/// Empty if the device will do, else the reason why it will not.
std::string unfit(const vk::raii::PhysicalDevice &physical)
{
	if (physical.getProperties().apiVersion < VK_API_VERSION_1_1) return "Vulkan 1.1 is missing";
	if (!graphicsFamily(physical)) return "no graphics queue";
	if (!physical.getFeatures().dualSrcBlend) return "dualSrcBlend is missing";
	if (!has(physical.enumerateDeviceExtensionProperties(), VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME))
		return "VK_KHR_external_memory_fd is missing";
	return {};
}

int rank(vk::PhysicalDeviceType type)
{
	switch (type) {
	case vk::PhysicalDeviceType::eDiscreteGpu: return 4;
	case vk::PhysicalDeviceType::eIntegratedGpu: return 3;
	case vk::PhysicalDeviceType::eVirtualGpu: return 2;
	default: return 1;
	}
}

vk::raii::PhysicalDevice choose(const vk::raii::Instance &instance)
{
	std::optional<vk::raii::PhysicalDevice> best;
	std::string reasons;
	for (auto &physical : vk::raii::PhysicalDevices(instance)) {
		const auto properties = physical.getProperties();
		const std::string reason = unfit(physical);
		if (!reason.empty())
			reasons += fmt::format("; {}: {}", properties.deviceName.data(), reason);
		else if (!best || rank(properties.deviceType) > rank(best->getProperties().deviceType))
			best = std::move(physical);
	}
	if (!best) throw std::runtime_error("no Vulkan device will do" + (reasons.empty() ? ": none is there" : reasons));
	return std::move(*best);
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice &physical, uint32_t family, bool present)
{
	std::vector<const char *> extensions{VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME};
	if (present) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
	const float priority = 1;
	const vk::DeviceQueueCreateInfo queue{{}, family, 1, &priority};
	vk::PhysicalDeviceFeatures features;
	features.dualSrcBlend = true;
	return {physical, vk::DeviceCreateInfo{{}, queue, {}, extensions, &features}};
}

DeviceIdentity identify(const vk::raii::PhysicalDevice &physical)
{
	const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceIDProperties>();
	const auto &properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
	const auto &ids = chain.get<vk::PhysicalDeviceIDProperties>();
	return {ids.deviceUUID, ids.driverUUID, uint32_t(properties.deviceType), properties.deviceName.data()};
}

} // namespace

Device::Handles::Handles(const std::vector<const char *> &surfaceExtensions)
	: instance(makeInstance(context, surfaceExtensions, validationMessages)),
	  physical(choose(instance)),
	  queueFamily(graphicsFamily(physical).value()),
	  canPresent(!surfaceExtensions.empty() && has(physical.enumerateDeviceExtensionProperties(), VK_KHR_SWAPCHAIN_EXTENSION_NAME)),
	  device(makeDevice(physical, queueFamily, canPresent)),
	  queue(device.getQueue(queueFamily, 0)),
	  identity(identify(physical)),
	  patience(identity.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ? 120s : 1s)
{
	if (validationWanted()) messenger.emplace(instance, messengerInfo(validationMessages));
}

uint32_t Device::Handles::memoryType(uint32_t allowed, std::span<const vk::MemoryPropertyFlags> wishes) const
{
	const auto memory = physical.getMemoryProperties();
	for (const auto wish : wishes)
		for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
			if (allowed >> i & 1 && (memory.memoryTypes[i].propertyFlags & wish) == wish) return i;
	throw std::runtime_error("the device has no memory of the kind an image or buffer needs");
}

void Device::Handles::submitAndWait(const vk::raii::CommandBuffer &commands, const vk::raii::Fence &fence)
{
	queue.lock()->submit(vk::SubmitInfo{{}, {}, *commands}, *fence);
	if (device.waitForFences(*fence, true, uint64_t(patience.count())) != vk::Result::eSuccess) {
		log::error("the GPU did not finish within {} ms", patience / 1ms);
		// What unwinding destroys must not be in use any more. The kernel resets a GPU that hangs; one that still works after that can
		// only be left by ending the process, whose parent starts it anew.
		if (device.waitForFences(*fence, true, uint64_t(patience.count())) != vk::Result::eSuccess) {
			log::error("the GPU hangs: this process ends");
			std::_Exit(exitAfterFault);
		}
		throw std::runtime_error(fmt::format("the GPU did not finish within {} ms", patience / 1ms));
	}
	device.resetFences(*fence);
}

void Device::Handles::runOnce(const std::function<void(const vk::raii::CommandBuffer &)> &record)
{
	const vk::raii::CommandPool pool(device, {vk::CommandPoolCreateFlagBits::eTransient, queueFamily});
	const vk::raii::CommandBuffers commands(device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
	const vk::raii::Fence fence(device, vk::FenceCreateInfo{});
	commands[0].begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	record(commands[0]);
	commands[0].end();
	submitAndWait(commands[0], fence);
}

namespace
{

using Memory = vk::MemoryPropertyFlagBits;

vk::raii::DeviceMemory allocate(const Device::Handles &gpu, const vk::MemoryRequirements &needs,
								std::span<const vk::MemoryPropertyFlags> wishes)
{
	return {gpu.device, {needs.size, gpu.memoryType(needs.memoryTypeBits, wishes)}};
}

constexpr std::array<vk::MemoryPropertyFlags, 2> onDevice{Memory::eDeviceLocal, vk::MemoryPropertyFlags{}};
constexpr std::array<vk::MemoryPropertyFlags, 2> onHost{Memory::eHostVisible | Memory::eHostCoherent | Memory::eHostCached,
														Memory::eHostVisible | Memory::eHostCoherent};

} // namespace

Image::Image(const Device::Handles &gpu, const vk::ImageCreateInfo &info)
	: image(gpu.device, info), memory(allocate(gpu, image.getMemoryRequirements(), onDevice))
{
	image.bindMemory(*memory, 0);
}

Buffer::Buffer(const Device::Handles &gpu, vk::DeviceSize size, vk::BufferUsageFlags usage)
	: buffer(gpu.device, vk::BufferCreateInfo{{}, size, usage}), memory(allocate(gpu, buffer.getMemoryRequirements(), onHost))
{
	buffer.bindMemory(*memory, 0);
	bytes = {static_cast<std::byte *>(memory.mapMemory(0, VK_WHOLE_SIZE)), size_t(size)};
}

} // namespace arift::gpu
