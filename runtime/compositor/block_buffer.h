// Blocks of numbers where shaders find them.
#pragma once
#include "runtime/gpu/handles.h"
#include <cstring>
#include <span>

namespace arift
{

/// Blocks of one kind in a uniform buffer, each at an offset the device allows.
template <typename Block> class BlockBuffer
{
public:
	BlockBuffer(const gpu::Device::Handles &gpu, size_t capacity)
		: stride_(aligned(sizeof(Block), gpu.physical.getProperties().limits.minUniformBufferOffsetAlignment)),
		  buffer_(gpu, stride_ * capacity, vk::BufferUsageFlagBits::eUniformBuffer)
	{
	}
	void write(std::span<const Block> blocks)
	{
		for (size_t i = 0; i < blocks.size(); ++i) std::memcpy(buffer_.bytes.data() + i * stride_, &blocks[i], sizeof(Block));
	}
	uint32_t offset(uint32_t index) const { return uint32_t(index * stride_); }
	vk::Buffer buffer() const { return *buffer_.buffer; }

private:
	static size_t aligned(size_t size, size_t alignment) { return (size + alignment - 1) / alignment * alignment; }
	size_t stride_;
	gpu::Buffer buffer_;
};

/// Blocks of which one is bound at a time, by its offset. Room for `capacity` of them: what is more is left out by whoever draws.
template <typename Block> class DynamicBlocks
{
public:
	DynamicBlocks(const gpu::Device::Handles &gpu, vk::DescriptorSetLayout layout, size_t capacity)
		: blocks_(gpu, capacity),
		  pool_(gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size}),
		  sets_(gpu.device, {*pool_, layout})
	{
		const vk::DescriptorBufferInfo block{blocks_.buffer(), 0, sizeof(Block)};
		gpu.device.updateDescriptorSets(vk::WriteDescriptorSet{*sets_.front(), 0, 0, vk::DescriptorType::eUniformBufferDynamic, {}, block},
										{});
	}
	void write(std::span<const Block> blocks) { blocks_.write(blocks); }
	void bind(const vk::raii::CommandBuffer &commands, vk::PipelineLayout layout, uint32_t set, uint32_t index) const
	{
		commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, set, *sets_.front(), blocks_.offset(index));
	}

private:
	static constexpr vk::DescriptorPoolSize size{vk::DescriptorType::eUniformBufferDynamic, 1};
	BlockBuffer<Block> blocks_;
	vk::raii::DescriptorPool pool_;
	vk::raii::DescriptorSets sets_;
};

} // namespace arift
