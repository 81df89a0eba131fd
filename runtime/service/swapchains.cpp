#include "runtime/service/swapchains.h"
#include "runtime/compositor/compositor.h"
#include <algorithm>
#include <atomic>

namespace arift
{

namespace
{

std::atomic<uint32_t> nextSwapchain{1};

constexpr VkImageUsageFlags knownUsage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
										 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
										 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
constexpr VkImageCreateFlags knownFlags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;

void checkSpec(gpu::Device &device, const gpu::ImageSpec &spec)
{
	const std::vector<int64_t> formats = gpu::swapchainFormats(device);
	if (std::ranges::find(formats, int64_t(spec.format)) == formats.end())
		throw Refused(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED,
					  fmt::format("the service's GPU cannot share images of VkFormat {}", spec.format));
	if (spec.usage == 0 || (spec.usage & ~knownUsage) || (spec.createFlags & ~knownFlags))
		throw Refused(XR_ERROR_FEATURE_UNSUPPORTED,
					  fmt::format("image usage {:#x} with flags {:#x} cannot be shared", spec.usage, spec.createFlags));
	if (spec.inRows > (gpu::canLieInRows(device.identity().deviceType, spec) ? 1u : 0u))
		throw Refused(XR_ERROR_FEATURE_UNSUPPORTED, "the service's images do not lie in rows");
	if ((spec.createFlags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) && (spec.width != spec.height || spec.arrayLayers % 6 != 0))
		throw Refused(XR_ERROR_VALIDATION_FAILURE, "a cube map needs six square faces");
}

} // namespace

Swapchains::~Swapchains() { destroyAll(); }

Swapchains::Made Swapchains::make(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount)
{
	checkSpec(device, spec);
	if (swapchains_.lock()->size() >= Quota::swapchains)
		throw Refused(XR_ERROR_LIMIT_REACHED, fmt::format("a client may have {} swapchains", uint32_t(Quota::swapchains)));
	// Before any of it is taken.
	if (bytes() + gpu::SharedImage::memorySizeOf(device, spec) * imageCount > Quota::imageBytes)
		throw Refused(XR_ERROR_OUT_OF_MEMORY, fmt::format("a client's images may take {} MiB", Quota::imageBytes >> 20));
	std::vector<std::shared_ptr<gpu::SharedImage>> images;
	Made made;
	for (uint32_t i = 0; i < imageCount; ++i)
		made.memory.push_back(images.emplace_back(std::make_shared<gpu::SharedImage>(device, spec))->exportMemory());
	made.swapchain = nextSwapchain++;
	made.memorySize = images.front()->memorySize();
	made.memoryTypeIndex = images.front()->memoryTypeIndex();
	for (uint32_t i = 0; i < imageCount; ++i)
		compositor_->addImage(imageKey(made.swapchain, i), images[i]->image(), spec, images[i], images[i]->rows());
	swapchains_.update([&](auto &all) {
		all[made.swapchain] = {{spec.width, spec.height, spec.arrayLayers, imageCount}, made.memorySize * imageCount};
	});
	return made;
}

bool Swapchains::destroy(uint32_t swapchain)
{
	std::optional<Swapchain> gone;
	if (const auto alive = swapchains_.lock(); alive->contains(swapchain)) gone = alive->at(swapchain);
	if (!gone) return false;
	destroyed_.update([&](auto &destroyed) {
		destroyed[swapchain] = gone->shape;
		if (destroyed.size() > Quota::swapchains) destroyed.erase(destroyed.begin());
	});
	swapchains_.lock()->erase(swapchain);
	for (uint32_t i = 0; i < gone->shape.imageCount; ++i) compositor_->removeImage(imageKey(swapchain, i));
	return true;
}

void Swapchains::destroyAll()
{
	for (;;) {
		const uint32_t swapchain = [&] {
			const auto all = swapchains_.lock();
			return all->empty() ? 0 : all->begin()->first;
		}();
		if (swapchain == 0) return;
		destroy(swapchain);
	}
}

std::optional<SwapchainShape> Swapchains::find(uint32_t swapchain)
{
	if (const auto all = swapchains_.lock(); all->contains(swapchain)) return all->at(swapchain).shape;
	if (const auto destroyed = destroyed_.lock(); destroyed->contains(swapchain)) return destroyed->at(swapchain);
	return std::nullopt;
}

uint64_t Swapchains::bytes()
{
	const auto all = swapchains_.lock();
	uint64_t sum = 0;
	for (const auto &[number, swapchain] : *all) sum += swapchain.bytes;
	return sum;
}

} // namespace arift
