#include "runtime/service/passthrough_maps.h"
#include <atomic>

namespace arift
{

namespace
{

constexpr int32_t texels = XR_PASSTHROUGH_COLOR_MAP_MONO_SIZE_FB;
/// Beside the keys of swapchains' images, which count from 0.
std::atomic<uint64_t> nextKey{1ull << 62};

} // namespace

PassthroughMaps::PassthroughMaps(std::shared_ptr<gpu::Device> device, std::shared_ptr<Compositor> compositor)
	: device_(std::move(device)), compositor_(std::move(compositor))
{
}

PassthroughMaps::~PassthroughMaps()
{
	for (uint32_t layer = 0; layer < maps_.size(); ++layer) replace(layer, std::nullopt);
}

std::optional<LayerTexture> PassthroughMaps::make(const ipc::StylePassthrough &style)
{
	if (!style.mapped) return std::nullopt;
	const gpu::ImageSpec spec{.format = VK_FORMAT_R8G8B8A8_UNORM, .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT, .width = texels, .height = 1};
	const auto image = std::make_shared<gpu::SharedImage>(*device_, spec);
	image->write(0, std::as_bytes(std::span(style.map)));
	const LayerTexture texture{.image = nextKey++, .rect = {{0, 0}, {texels, 1}}};
	compositor_->addImage(texture.image, image->image(), spec, image);
	return texture;
}

void PassthroughMaps::replace(uint32_t layer, const std::optional<LayerTexture> &now)
{
	if (maps_[layer]) compositor_->removeImage(maps_[layer]->image);
	maps_[layer] = now;
}

} // namespace arift
