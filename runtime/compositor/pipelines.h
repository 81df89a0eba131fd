// The renderer's pipelines, made when they are asked for: at once, or by a thread of their own.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/compositor/pipeline_key.h"
#include "runtime/gpu/handles.h"
#include <deque>
#include <map>
#include <memory>
#include <thread>

namespace arift
{

/// Every Vulkan device that people have draws into it; holds surface.frag's gl_FragDepth.
constexpr vk::Format depthFormat = vk::Format::eD32Sfloat;

class Pipelines
{
public:
	/// All of them must outlive it.
	Pipelines(const gpu::Device::Handles &gpu, vk::Format format, const PanelOptics &optics);
	~Pipelines();
	Pipelines(const Pipelines &) = delete;
	/// Attachments: colour, and a depth image (depthFormat) that is undefined at first, or, where something is tested, infinitely far away:
	/// 0. Both are compatible.
	vk::RenderPass renderPass(bool tests = false) const { return tests ? *testingRenderPass_ : *renderPass_; }
	vk::PipelineLayout layout() const { return *layout_; }
	/// Set 0: eye block, camera image, angle table. Set 1: layer image. Set 2: surface block, at a dynamic offset. Set 3: depth
	/// image, of a deep surface alone. Push constants: layer block. surface.frag uses no push constants, panel.frag no set 2.
	vk::DescriptorSetLayout eyeSetLayout() const { return *eyeSetLayout_; }
	vk::DescriptorSetLayout layerSetLayout() const { return *layerSetLayout_; }
	vk::DescriptorSetLayout surfaceSetLayout() const { return *surfaceSetLayout_; }
	/// Made here and now if it has not been. Throws vk::SystemError where it cannot be.
	vk::Pipeline at(const PipelineKey &key);
	/// Unusual ways to draw a layer that an application may find: more than any needs, and not as many as it can think of.
	static constexpr size_t mostOthers = 256;
	/// Null as long as it is being made, which begins when it is first asked for, unless at() has made it; and for ever where it cannot be
	/// made, or where mostOthers have been asked for.
	vk::Pipeline find(const PipelineKey &key);

private:
	/// Those that find() was asked for; what is wanted is made in this order.
	struct Others {
		std::map<PipelineKey, vk::raii::Pipeline> pipelines;
		std::deque<PipelineKey> wanted;
	};
	class Factory;
	void makeOthers(const std::stop_token &stop);

	vk::raii::RenderPass renderPass_, testingRenderPass_;
	vk::raii::DescriptorSetLayout eyeSetLayout_, layerSetLayout_, surfaceSetLayout_;
	vk::raii::PipelineLayout layout_;
	std::unique_ptr<const Factory> factory_;
	std::map<PipelineKey, vk::raii::Pipeline> made_; ///< by at()
	Guarded<Others> others_;
	std::jthread makesOthers_;
};

} // namespace arift
