#include "runtime/service/copied_images.h"

namespace arift
{

namespace
{

/// What the service's own image must be: the application's use of it is not the service's.
gpu::ImageSpec shownPart(const gpu::Device &device, gpu::ImageSpec spec)
{
	spec.usage = 0;
	spec.createFlags &= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
	spec.mipLevels = 1;
	spec.inRows = gpu::canLieInRows(device.identity().deviceType, spec) ? 1 : 0;
	return spec;
}

} // namespace

CopiedImages::CopiedImages(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t count) : layout_(gpu::copyLayoutOf(spec))
{
	for (uint32_t i = 0; i < count; ++i) {
		Image &image = images_.emplace_back();
		image.image = std::make_shared<gpu::SharedImage>(device, shownPart(device, spec));
		image.memory = ipc::makeSharedMemory("arift-image", layout_.size);
		image.mapping = ipc::mapReadOnly(image.memory.get(), layout_.size);
		image.fetched.resize(spec.arrayLayers, 0);
	}
}

uint64_t CopiedImages::sizeOf(gpu::Device &device, const gpu::ImageSpec &spec, uint32_t count)
{
	return (gpu::SharedImage::memorySizeOf(device, shownPart(device, spec)) + gpu::copyLayoutOf(spec).size) * count;
}

std::vector<UniqueFd> CopiedImages::takeMemory()
{
	std::vector<UniqueFd> memory;
	for (Image &image : images_) memory.push_back(std::move(image.memory));
	return memory;
}

void CopiedImages::fetch(uint32_t index, uint32_t arrayLayer, uint32_t release)
{
	Image &image = images_[index];
	uint32_t &fetched = image.fetched[arrayLayer];
	if (release != 0 && release == fetched) return;
	const auto *texels = static_cast<const std::byte *>(image.mapping.address()) + arrayLayer * layout_.layerPitch;
	image.image->write(arrayLayer, {texels, layout_.layerSize});
	fetched = release;
}

} // namespace arift
