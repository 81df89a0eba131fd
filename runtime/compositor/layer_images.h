// Applications' images as the renderer samples them.
#pragma once
#include "runtime/compositor/drawing.h"
#include "runtime/gpu/handles.h"
#include <unordered_map>

namespace arift
{

class LayerImages
{
public:
	/// Every array layer of every image, or every cube, gets a descriptor set of `layout`.
	LayerImages(gpu::Device::Handles &gpu, vk::DescriptorSetLayout layout, vk::Sampler sampler, vk::Sampler depthSampler);

	/// `rows`: where a CPU finds the texels, if anywhere; they are looked at by find() alone.
	void add(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows);
	void remove(uint64_t key) { images_.erase(key); }

	struct Entry {
		vk::Image image;
		gpu::ImageSpec spec;
		std::vector<vk::raii::ImageView> views;
		vk::raii::DescriptorPool pool;
		std::vector<vk::raii::DescriptorSet> sets; ///< by array layer
		std::vector<Occupancy> occupancy;          ///< by array layer; empty where the image does not lie in rows
		uint64_t content = 0;                      ///< LayerTexture::content of what the occupancies know
	};
	/// Null: unknown, or nothing that can be sampled.
	const Entry *find(uint64_t key) const;
	/// What a layer shows, with what is known of its content.
	std::optional<KnownImage> find(const LayerTexture &texture);

	/// Takes the images over from their application for sampling, and gives them back.
	void acquire(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const;
	void release(const vk::raii::CommandBuffer &commands, std::span<const Entry *const> entries) const;

private:
	gpu::Device::Handles &gpu_;
	vk::DescriptorSetLayout layout_;
	vk::Sampler sampler_, depthSampler_;
	std::unordered_map<uint64_t, Entry> images_;
};

} // namespace arift
