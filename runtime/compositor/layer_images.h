// Applications' images as the renderer samples them.
#pragma once
#include "runtime/gpu/handles.h"
#include <unordered_map>

namespace arift
{

class LayerImages
{
public:
	/// Every image gets a descriptor set of `layout`.
	LayerImages(gpu::Device::Handles &gpu, vk::DescriptorSetLayout layout, vk::Sampler sampler);

	void add(uint64_t key, VkImage image, const gpu::ImageSpec &spec);
	void remove(uint64_t key) { images_.erase(key); }

	struct Entry {
		vk::Image image;
		gpu::ImageSpec spec;
		vk::raii::ImageView view;
		vk::raii::DescriptorPool pool;
		vk::raii::DescriptorSet set;
	};
	/// Null: unknown, or nothing that can be sampled (depth).
	const Entry *find(uint64_t key) const;

	/// Takes the images over from their application for sampling, and gives them back.
	void acquire(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const;
	void release(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const;

private:
	gpu::Device::Handles &gpu_;
	vk::DescriptorSetLayout layout_;
	vk::Sampler sampler_;
	std::unordered_map<uint64_t, Entry> images_;
};

} // namespace arift
