#include "runtime/service/swapchains.h"
#include "runtime/compositor/compositor.h"
#include "runtime/service/copied_images.h"
#include <algorithm>
#include <atomic>
#include <set>
#include <tuple>

namespace arift
{

namespace
{

std::atomic<uint32_t> nextSwapchain{1};

constexpr VkImageUsageFlags knownUsage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
										 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
										 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
constexpr VkImageCreateFlags knownFlags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;

void checkSpec(gpu::Device &device, const gpu::ImageSpec &spec, ipc::Sharing sharing)
{
	const std::vector<int64_t> formats = gpu::swapchainFormats(device);
	if (std::ranges::find(formats, int64_t(spec.format)) == formats.end())
		throw Refused(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED,
					  fmt::format("the service's GPU cannot share images of VkFormat {}", spec.format));
	if (spec.usage == 0 || (spec.usage & ~knownUsage) || (spec.createFlags & ~knownFlags))
		throw Refused(XR_ERROR_FEATURE_UNSUPPORTED,
					  fmt::format("image usage {:#x} with flags {:#x} cannot be shared", spec.usage, spec.createFlags));
	if (sharing == ipc::Sharing::copies && (spec.samples != 1 || spec.inRows))
		throw Refused(XR_ERROR_FEATURE_UNSUPPORTED, fmt::format("an image of {} samples cannot be copied", spec.samples));
	if (spec.inRows > (gpu::canLieInRows(device.identity().deviceType, spec) ? 1u : 0u))
		throw Refused(XR_ERROR_FEATURE_UNSUPPORTED, "the service's images do not lie in rows");
	if (gpu::isCube(spec) && (spec.width != spec.height || spec.arrayLayers % 6 != 0))
		throw Refused(XR_ERROR_VALIDATION_FAILURE, "a cube map needs six square faces");
}

} // namespace

SwapchainShape Swapchains::Swapchain::shape() const
{
	return {about.spec.width, about.spec.height, gpu::arraySize(about.spec), about.imageCount, gpu::kindOf(about.spec)};
}

Swapchains::~Swapchains() { destroyAll(); }

Swapchains::Made Swapchains::make(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount, ipc::Sharing sharing)
{
	checkSpec(device, spec, sharing);
	if (swapchains_.lock()->size() >= Quota::swapchains)
		throw Refused(XR_ERROR_LIMIT_REACHED, fmt::format("a client may have {} swapchains", uint32_t(Quota::swapchains)));
	return sharing == ipc::Sharing::copies ? copy(device, spec, imageCount) : share(device, spec, imageCount);
}

/// Before any of it is taken.
void Swapchains::requireQuota(uint64_t wanted)
{
	if (bytes() + wanted > Quota::imageBytes)
		throw Refused(XR_ERROR_OUT_OF_MEMORY, fmt::format("a client's images may take {} MiB", Quota::imageBytes >> 20));
}

void Swapchains::tellCompositor(uint32_t swapchain, uint32_t image, const std::shared_ptr<gpu::SharedImage> &shared)
{
	compositor_->addImage(imageKey(swapchain, image), shared->image(), shared->spec(), shared, shared->rows());
}

Swapchains::Made Swapchains::share(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount)
{
	const uint64_t bytes = gpu::SharedImage::memorySizeOf(device, spec) * imageCount;
	requireQuota(bytes);
	std::vector<std::shared_ptr<gpu::SharedImage>> images;
	Made made{.swapchain = nextSwapchain++};
	for (uint32_t i = 0; i < imageCount; ++i)
		made.memory.push_back(images.emplace_back(std::make_shared<gpu::SharedImage>(device, spec))->exportMemory());
	made.memorySize = images.front()->memorySize();
	made.memoryTypeIndex = images.front()->memoryTypeIndex();
	for (uint32_t i = 0; i < imageCount; ++i) tellCompositor(made.swapchain, i, images[i]);
	swapchains_.update([&](auto &all) { all[made.swapchain] = {{spec, imageCount, ipc::Sharing::memory}, bytes, nullptr}; });
	return made;
}

Swapchains::Made Swapchains::copy(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t imageCount)
{
	const uint64_t bytes = CopiedImages::sizeOf(device, spec, imageCount);
	requireQuota(bytes);
	const auto copies = std::make_shared<CopiedImages>(device, spec, imageCount);
	Made made{.swapchain = nextSwapchain++, .memorySize = gpu::copyLayoutOf(spec).size, .memory = copies->takeMemory()};
	for (uint32_t i = 0; i < imageCount; ++i) tellCompositor(made.swapchain, i, copies->image(i));
	swapchains_.update([&](auto &all) { all[made.swapchain] = {{spec, imageCount, ipc::Sharing::copies}, bytes, copies}; });
	return made;
}

void Swapchains::fetch(const ipc::SubImage &image)
{
	std::shared_ptr<CopiedImages> copies;
	if (const auto all = swapchains_.lock(); all->contains(image.swapchain)) copies = all->at(image.swapchain).copies;
	if (copies) copies->fetch(image.image, image.arrayIndex, image.release);
}

void Swapchains::fetch(const ipc::Submission &submission)
{
	std::set<std::tuple<uint32_t, uint32_t, uint32_t>> fetched; // whatever a client says of releases: each once
	const auto fetchOnce = [&](const ipc::SubImage &image) {
		if (fetched.emplace(image.swapchain, image.image, image.arrayIndex).second) fetch(image);
	};
	for (uint32_t i = 0; i < submission.layerCount; ++i) {
		const ipc::Layer &layer = submission.layers[i];
		if (layer.type == ipc::LayerType::passthrough) continue;
		fetchOnce(layer.views[0].image);
		if (layer.type != ipc::LayerType::projection) continue;
		fetchOnce(layer.views[1].image);
		for (const ipc::LayerView &view : layer.views)
			if (view.depth.image.swapchain != 0) fetchOnce(view.depth.image);
	}
}

std::vector<Swapchains::About> Swapchains::abouts()
{
	std::vector<About> abouts;
	const auto all = swapchains_.lock();
	for (const auto &[number, swapchain] : *all) abouts.push_back(swapchain.about);
	return abouts;
}

bool Swapchains::destroy(uint32_t swapchain)
{
	std::optional<Swapchain> gone;
	if (const auto alive = swapchains_.lock(); alive->contains(swapchain)) gone = alive->at(swapchain);
	if (!gone) return false;
	destroyed_.update([&](auto &destroyed) {
		destroyed[swapchain] = gone->shape();
		if (destroyed.size() > Quota::swapchains) destroyed.erase(destroyed.begin());
	});
	swapchains_.lock()->erase(swapchain);
	for (uint32_t i = 0; i < gone->about.imageCount; ++i) compositor_->removeImage(imageKey(swapchain, i));
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
	if (const auto all = swapchains_.lock(); all->contains(swapchain)) return all->at(swapchain).shape();
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
