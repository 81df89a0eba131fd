#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"
#include "runtime/gpu/swapchain_formats.h"

namespace arift::gpu
{

Device::Device(std::vector<const char *> surfaceExtensions) : handles_(std::make_unique<Handles>(surfaceExtensions)) {}

Device::~Device() = default;

const DeviceIdentity &Device::identity() const { return handles_->identity; }

uint64_t Device::validationMessages() const { return handles_->validationMessages; }

std::vector<int64_t> swapchainFormats(Device &device)
{
	const vk::raii::PhysicalDevice &physical = device.handles().physical;
	return swapchainFormats(*physical, physical.getDispatcher()->vkGetPhysicalDeviceImageFormatProperties2);
}

} // namespace arift::gpu
