// A swapchain's images where the application's GPU cannot share memory with the service's: each lies in a memfd, which the application
// writes and the service reads.
#pragma once
#include "runtime/gpu/device.h"
#include "runtime/ipc/shared_memory.h"
#include <memory>
#include <vector>

namespace arift
{

/// Nothing in the memory is trusted: sizes are the service's own and sealed, texels are read once and mean colours whatever they are.
class CopiedImages
{
public:
	/// Images like `spec`, as far as they are shown, and memory for them. Throws std::runtime_error or std::system_error.
	CopiedImages(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t count);
	/// Bytes that all of it would take; nothing is allocated.
	static uint64_t sizeOf(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t count);

	const std::shared_ptr<gpu::SharedImage> &image(uint32_t index) const { return images_[index].image; }
	/// The memfds, for the application: once.
	std::vector<UniqueFd> takeMemory();
	/// Brings in what the application has written; nothing where it is that of the same `release` still (0: it may be another). Both
	/// indices must be in range. Thread-bound. Throws std::runtime_error where the GPU is lost.
	void fetch(uint32_t image, uint32_t arrayLayer, uint32_t release);

private:
	struct Image {
		std::shared_ptr<gpu::SharedImage> image;
		UniqueFd memory;
		ipc::Mapping mapping;
		std::vector<uint32_t> fetched; ///< by array layer: the release that was brought in last
	};
	const gpu::CopyLayout layout_;
	std::vector<Image> images_;
};

} // namespace arift
