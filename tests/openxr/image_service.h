// A service that hands out real images, or memory to copy them into, for sessions that draw.
#pragma once
#include "runtime/gpu/device.h"
#include "tests/openxr/fake_service.h"
#include <algorithm>

namespace arift
{

class ImageService
{
public:
	/// `sharing`: what it grants. `probe`: changes what it says of its probe; none without.
	explicit ImageService(ipc::Sharing sharing = ipc::Sharing::memory, std::function<void(ipc::SessionCreated &)> probe = {})
	{
		service.setGrant([this, sharing, probe = std::move(probe)](ipc::SessionCreated &created) {
			created.sharing = sharing;
			const std::vector<int64_t> formats = gpu::swapchainFormats(device);
			std::ranges::copy(formats, created.formats.begin());
			if (!probe) return UniqueFd();
			gpu::MemoryProbe made = gpu::makeMemoryProbe(device);
			created.probeSize = made.size;
			created.probeTypeIndex = made.typeIndex;
			created.probePattern = made.pattern;
			probe(created);
			return std::move(made.memory);
		});
	}

	gpu::Device device;
	std::vector<gpu::SharedImage> images;
	std::vector<UniqueFd> copies; ///< memory of images that are copied, in the order in which they were asked for
	FakeService service{welcome(), [this](const ipc::CreateSwapchain &create, ipc::SwapchainCreated &created) {
							std::vector<UniqueFd> fds;
							for (uint32_t i = 0; i < create.imageCount; ++i) fds.push_back(makeImage(create, created));
							return fds;
						}};

private:
	ipc::Welcome welcome() const
	{
		ipc::Welcome welcome = FakeService::usualWelcome();
		welcome.deviceUuid = device.identity().deviceUuid;
		welcome.driverUuid = device.identity().driverUuid;
		welcome.deviceType = device.identity().deviceType;
		return welcome;
	}
	UniqueFd makeImage(const ipc::CreateSwapchain &create, ipc::SwapchainCreated &created)
	{
		if (create.sharing == ipc::Sharing::copies) {
			created.memorySize = gpu::copyLayoutOf(create.spec).size;
			return UniqueFd(::dup(copies.emplace_back(ipc::makeSharedMemory("test", created.memorySize)).get()));
		}
		const gpu::SharedImage &image = images.emplace_back(device, create.spec);
		created.memorySize = image.memorySize();
		created.memoryTypeIndex = image.memoryTypeIndex();
		return image.exportMemory();
	}
};

} // namespace arift
