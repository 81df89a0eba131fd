#include "runtime/compositor/layer_images.h"

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

vk::ImageSubresourceRange wholeOf(const gpu::ImageSpec &spec)
{
	vk::ImageSubresourceRange whole = gpu::wholeColour;
	whole.aspectMask = vk::ImageAspectFlags(gpu::aspectOf(VkFormat(spec.format)));
	return whole;
}

vk::raii::DescriptorPool poolFor(const gpu::Device::Handles &gpu, uint32_t sets)
{
	const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, sets};
	return {gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, size}};
}

/// One array layer or one cube, its largest mip level alone: views are near their size on the panel. A cube's texels are decoded when they
/// are sampled: its faces' edges are the sampler's.
vk::raii::ImageView viewOf(const gpu::Device::Handles &gpu, VkImage image, const gpu::ImageSpec &spec, uint32_t layer)
{
	if (gpu::isCube(spec))
		return {gpu.device,
				{{}, image, vk::ImageViewType::eCube, vk::Format(spec.format), {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 6 * layer, 6}}};
	const auto format = vk::Format(gpu::storedFormat(VkFormat(spec.format)));
	const auto aspect = vk::ImageAspectFlags(gpu::copiedAspectOf(VkFormat(spec.format))); // not the stencil
	return {gpu.device, {{}, image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, layer, 1}}};
}

bool hasAlphaLast(VkFormat format)
{
	const VkFormat stored = gpu::storedFormat(format);
	return stored == VK_FORMAT_R8G8B8A8_UNORM || stored == VK_FORMAT_B8G8R8A8_UNORM;
}

std::vector<Occupancy> occupancyOf(const gpu::ImageSpec &spec, const gpu::ImageRows &rows)
{
	std::vector<Occupancy> occupancy;
	const size_t texel = gpu::bytesPerTexel(VkFormat(spec.format));
	if (rows.first && texel > 0 && !gpu::isCube(spec))
		for (uint32_t layer = 0; layer < spec.arrayLayers; ++layer)
			occupancy.emplace_back(Occupancy::Texels{.first = rows.first + layer * rows.layerPitch,
													 .rowPitch = rows.rowPitch,
													 .bytesPerTexel = texel,
													 .alphaLast = hasAlphaLast(VkFormat(spec.format)),
													 .width = spec.width,
													 .height = spec.height});
	return occupancy;
}

} // namespace

LayerImages::LayerImages(gpu::Device::Handles &gpu, vk::DescriptorSetLayout layout, vk::Sampler sampler, vk::Sampler depthSampler)
	: gpu_(gpu), layout_(layout), sampler_(sampler), depthSampler_(depthSampler)
{
}

void LayerImages::add(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows)
{
	// Of several samples, or a cube of depths: no layer shows that.
	if (spec.samples != 1 || (gpu::isCube(spec) && gpu::isDepth(VkFormat(spec.format)))) return;
	const uint32_t count = gpu::arraySize(spec);
	Entry entry{image, spec, {}, poolFor(gpu_, count), {}, occupancyOf(spec, rows)};
	const std::vector layouts(count, layout_);
	vk::raii::DescriptorSets sets(gpu_.device, {*entry.pool, layouts});
	entry.sets.assign(std::make_move_iterator(sets.begin()), std::make_move_iterator(sets.end()));
	for (uint32_t layer = 0; layer < count; ++layer) {
		const auto &view = entry.views.emplace_back(viewOf(gpu_, image, spec, layer));
		const vk::Sampler sampler = gpu::isDepth(VkFormat(spec.format)) ? depthSampler_ : sampler_;
		const vk::DescriptorImageInfo texture{sampler, *view, Layout::eShaderReadOnlyOptimal};
		gpu_.device.updateDescriptorSets(
			vk::WriteDescriptorSet{*entry.sets[layer], 0, 0, vk::DescriptorType::eCombinedImageSampler, texture}, {});
	}
	images_.insert_or_assign(key, std::move(entry));
}

const LayerImages::Entry *LayerImages::find(uint64_t key) const
{
	const auto found = images_.find(key);
	return found == images_.end() ? nullptr : &found->second;
}

std::optional<KnownImage> LayerImages::find(const LayerTexture &texture)
{
	const auto found = images_.find(texture.image);
	if (found == images_.end()) return std::nullopt;
	Entry &entry = found->second;
	if (texture.arrayIndex >= entry.occupancy.size()) return KnownImage{&entry.spec};
	if (texture.content == 0 || texture.content != entry.content)
		for (Occupancy &layer : entry.occupancy) layer.forget();
	entry.content = texture.content;
	return KnownImage{&entry.spec, &entry.occupancy[texture.arrayIndex]};
}

void LayerImages::acquire(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const
{
	FrameVector<vk::ImageMemoryBarrier> barriers;
	for (const Entry *entry : entries)
		barriers.push_back({{},
							Access::eShaderRead,
							Layout(gpu::boundaryLayout(VkFormat(entry->spec.format))),
							Layout::eShaderReadOnlyOptimal,
							VK_QUEUE_FAMILY_EXTERNAL,
							gpu_.queueFamily,
							entry->image,
							wholeOf(entry->spec)});
	if (!barriers.empty()) commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eFragmentShader, {}, {}, {}, barriers);
}

void LayerImages::release(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const
{
	FrameVector<vk::ImageMemoryBarrier> barriers;
	for (const Entry *entry : entries)
		barriers.push_back({{},
							{},
							Layout::eShaderReadOnlyOptimal,
							Layout(gpu::boundaryLayout(VkFormat(entry->spec.format))),
							gpu_.queueFamily,
							VK_QUEUE_FAMILY_EXTERNAL,
							entry->image,
							wholeOf(entry->spec)});
	if (!barriers.empty()) commands.pipelineBarrier(Stage::eFragmentShader, Stage::eBottomOfPipe, {}, {}, {}, barriers);
}

} // namespace arift
