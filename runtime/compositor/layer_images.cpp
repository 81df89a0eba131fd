#include "runtime/compositor/layer_images.h"

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

/// Every layer, the largest mip level alone: views are near their size on the panel.
constexpr vk::ImageSubresourceRange sampled{vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
constexpr vk::ImageSubresourceRange whole{vk::ImageAspectFlagBits::eColor, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};

vk::raii::DescriptorPool poolForOneSet(const gpu::Device::Handles &gpu)
{
	const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
	return {gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size}};
}

vk::raii::DescriptorSet allocate(const gpu::Device::Handles &gpu, const vk::raii::DescriptorPool &pool, vk::DescriptorSetLayout layout)
{
	return std::move(vk::raii::DescriptorSets(gpu.device, {*pool, layout}).front());
}

} // namespace

LayerImages::LayerImages(gpu::Device::Handles &gpu, vk::DescriptorSetLayout layout, vk::Sampler sampler)
	: gpu_(gpu), layout_(layout), sampler_(sampler)
{
}

void LayerImages::add(uint64_t key, VkImage image, const gpu::ImageSpec &spec)
{
	const auto format = VkFormat(spec.format);
	if (gpu::isDepth(format) || spec.samples != 1) return;
	vk::raii::ImageView view(gpu_.device, {{}, image, vk::ImageViewType::e2DArray, vk::Format(format), {}, sampled});
	vk::raii::DescriptorPool pool = poolForOneSet(gpu_);
	vk::raii::DescriptorSet set = allocate(gpu_, pool, layout_);
	const vk::DescriptorImageInfo texture{sampler_, *view, Layout::eShaderReadOnlyOptimal};
	gpu_.device.updateDescriptorSets(vk::WriteDescriptorSet{*set, 0, 0, vk::DescriptorType::eCombinedImageSampler, texture}, {});
	images_.insert_or_assign(key, Entry{image, spec, std::move(view), std::move(pool), std::move(set)});
}

const LayerImages::Entry *LayerImages::find(uint64_t key) const
{
	const auto found = images_.find(key);
	return found == images_.end() ? nullptr : &found->second;
}

void LayerImages::acquire(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const
{
	std::vector<vk::ImageMemoryBarrier> barriers;
	for (const Entry *entry : entries)
		barriers.push_back({{},
							Access::eShaderRead,
							Layout(gpu::boundaryLayout(VkFormat(entry->spec.format))),
							Layout::eShaderReadOnlyOptimal,
							VK_QUEUE_FAMILY_EXTERNAL,
							gpu_.queueFamily,
							entry->image,
							whole});
	if (!barriers.empty()) commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eFragmentShader, {}, {}, {}, barriers);
}

void LayerImages::release(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const
{
	std::vector<vk::ImageMemoryBarrier> barriers;
	for (const Entry *entry : entries)
		barriers.push_back({{},
							{},
							Layout::eShaderReadOnlyOptimal,
							Layout(gpu::boundaryLayout(VkFormat(entry->spec.format))),
							gpu_.queueFamily,
							VK_QUEUE_FAMILY_EXTERNAL,
							entry->image,
							whole});
	if (!barriers.empty()) commands.pipelineBarrier(Stage::eFragmentShader, Stage::eBottomOfPipe, {}, {}, {}, barriers);
}

} // namespace arift
