#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"
#include <cstring>
#include <random>

namespace arift::gpu
{

MemoryProbe makeMemoryProbe(Device &device)
{
	const Device::Handles &gpu = device.handles();
	const std::array<vk::MemoryPropertyFlags, 1> wishes{vk::MemoryPropertyFlagBits::eHostVisible |
														vk::MemoryPropertyFlagBits::eHostCoherent};
	MemoryProbe probe;
	probe.size = 4096;
	probe.typeIndex = gpu.memoryType(~0u, wishes);
	std::random_device random;
	for (uint8_t &byte : probe.pattern) byte = uint8_t(random());
	const vk::ExportMemoryAllocateInfo exported{vk::ExternalMemoryHandleTypeFlagBits::eOpaqueFd};
	const vk::raii::DeviceMemory memory(gpu.device, {probe.size, probe.typeIndex, &exported});
	std::memcpy(memory.mapMemory(0, VK_WHOLE_SIZE), probe.pattern.data(), probe.pattern.size());
	memory.unmapMemory();
	probe.memory = UniqueFd(gpu.device.getMemoryFdKHR({*memory, vk::ExternalMemoryHandleTypeFlagBits::eOpaqueFd}));
	return probe;
}

} // namespace arift::gpu
