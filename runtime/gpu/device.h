// A Vulkan instance, device and queue made for the service. The only place that chooses a GPU. (vulkan.hpp stays out of this header.)
#pragma once
#include "runtime/base/unique_fd.h"
#include "runtime/gpu/image_spec.h"
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace arift::gpu
{

struct DeviceIdentity {
	std::array<uint8_t, 16> deviceUuid{}, driverUuid{};
	uint32_t deviceType = 0;
	std::string name;
};

class Device
{
public:
	/// `surfaceExtensions`: instance extensions a window target needs, or empty. ARIFT_VULKAN_VALIDATION=1 turns the validation layer
	/// (with synchronisation checks) on; its messages go to the log as errors.
	explicit Device(std::vector<const char *> surfaceExtensions = {});
	~Device();
	Device(const Device &) = delete;

	const DeviceIdentity &identity() const;
	/// Messages the validation layer has sent so far.
	uint64_t validationMessages() const;

	struct Handles; ///< vk::raii objects: runtime/gpu/handles.h, for those that draw
	Handles &handles() { return *handles_; }

private:
	std::unique_ptr<Handles> handles_;
};

/// An image in exportable memory, cleared and left in its boundary layout, owned by VK_QUEUE_FAMILY_EXTERNAL.
class SharedImage
{
public:
	SharedImage(Device &device, const ImageSpec &spec);
	~SharedImage();
	SharedImage(SharedImage &&) noexcept;
	/// Bytes that such an image would take; nothing is allocated.
	static uint64_t memorySizeOf(Device &device, const ImageSpec &spec);
	VkImage image() const;
	const ImageSpec &spec() const;
	ImageRows rows() const;
	uint64_t memorySize() const;
	uint32_t memoryTypeIndex() const;
	/// A new opaque fd of the memory for the application.
	UniqueFd exportMemory() const;
	/// Replaces an array layer's largest mip level with texels of CopyLayout::layerSize bytes, which are read once; done when it returns.
	/// For an image that no application draws into. Throws std::runtime_error where the GPU is lost.
	void write(uint32_t arrayLayer, std::span<const std::byte> texels);

private:
	struct Implementation;
	std::unique_ptr<Implementation> implementation_;
};

/// A little exported memory that begins with a pattern nobody knows: whoever imports it and reads that has the service's memory indeed.
struct MemoryProbe {
	UniqueFd memory;
	uint64_t size = 0;
	uint32_t typeIndex = 0;
	std::array<uint8_t, 32> pattern{};
};
MemoryProbe makeMemoryProbe(Device &device);

/// Formats an application may use, the runtime's favourite first, as VkFormat; only those the device can share with every usage asked for.
std::vector<int64_t> swapchainFormats(Device &device);

} // namespace arift::gpu
