// What a session needs of the application's graphics API. One implementation per API.
#pragma once
#include "runtime/base/unique_fd.h"
#include "runtime/gpu/image_spec.h"
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include <array>
#include <memory>
#include <span>
#include <vector>

namespace arift::openxr
{

/// Work on the application's GPU that ends some time.
class Completion
{
public:
	enum class Outcome {
		done,
		notYet,
		failed ///< it never will be: the device is lost
	};
	virtual ~Completion() = default;
	/// How the work stands when it is finished or `limit` of real time has passed. Any thread.
	virtual Outcome wait(XrDuration limit) const = 0;
	/// In xrEndFrame, in the application's thread: waits, within a limit, for work that other threads cannot wait for. After it wait()
	/// knows.
	virtual void settle() {}
};

/// The images of one swapchain in the application's graphics API. Destroying them waits, within a limit, for the work on them.
class SwapchainImages
{
public:
	virtual ~SwapchainImages() = default;
	/// Throws XR_ERROR_VALIDATION_FAILURE for elements of another API's type.
	virtual void describe(std::span<XrSwapchainImageBaseHeader *const> elements) const = 0;
	/// In xrAcquireSwapchainImage: the compositor is done with the image, it becomes the application's.
	virtual void takeOver(uint32_t image) = 0;
	/// In xrReleaseSwapchainImage: the image is the compositor's when what is returned is finished.
	virtual std::shared_ptr<Completion> handOver(uint32_t image) = 0;
	/// Size of one of the elements that xrEnumerateSwapchainImages fills.
	virtual size_t elementSize() const = 0;
};

/// Memory the service allocated for a swapchain's images, as SwapchainCreated tells.
struct SharedMemory {
	ipc::Sharing sharing = ipc::Sharing::memory;
	std::span<UniqueFd> fds; ///< one per image: opaque, or a memfd to copy into
	uint64_t size = 0;       ///< bytes of each
	uint32_t typeIndex = 0;
};

/// Memory that the service says begins with a pattern.
struct MemoryProbe {
	UniqueFd &memory;
	uint64_t size = 0;
	uint32_t typeIndex = 0;
	std::span<const uint8_t> pattern;
};

class Graphics
{
public:
	virtual ~Graphics() = default;
	virtual std::array<uint8_t, 16> deviceUuid() const = 0;
	virtual std::array<uint8_t, 16> driverUuid() const = 0;
	/// Whether the first row of an image is its lowest, and rectangles are measured from below: so it is with OpenGL.
	virtual bool rowsGoUp() const { return false; }
	/// Whether what depth images hold comes to the service where images are copied.
	virtual bool copiesDepth() const { return true; }
	/// Of the formats that the service says swapchains may have (VkFormats, its favourite first) those that the application's device can
	/// draw in, as the numbers of the application's API.
	virtual std::vector<int64_t> formatsOf(std::span<const int32_t> vulkan) const = 0;
	/// Whether the application's device sees the probe's pattern where the service wrote it. An API that cannot look has the UUIDs alone.
	virtual bool sees(const MemoryProbe &) const { return true; }
	/// What the service is to make for a swapchain, its format one of formatsOf(). Throws XR_ERROR_FEATURE_UNSUPPORTED.
	virtual gpu::ImageSpec specOf(const XrSwapchainCreateInfo &info, ipc::Sharing sharing) const = 0;
	/// The images in the application's device; where they are copied, images of its own that are copied into `memory` when handed over.
	virtual std::unique_ptr<SwapchainImages> import(const gpu::ImageSpec &spec, const SharedMemory &memory) = 0;
};

} // namespace arift::openxr
