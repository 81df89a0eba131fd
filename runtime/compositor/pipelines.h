// The renderer's pipelines, made when they are asked for: at once, or by a thread of their own.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/compositor/panel_inputs.h"
#include "runtime/compositor/panel_optics.h"
#include "runtime/gpu/handles.h"
#include <compare>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <thread>

namespace arift
{

/// The shader's `background` constant.
enum class Background : uint32_t { none, pattern, camera, unseen };

/// How the cameras' image is drawn: as what lies behind layers, or as a passthrough layer over what is there.
enum class Look : uint32_t { backdrop, faded, styled };

struct PipelineKey {
	Blend blend = Blend::replace;
	Background background = Background::none;
	uint32_t camera = 0;  ///< whose lens; 0 without a camera
	bool encoded = false; ///< the camera's values are sRGB encoded
	Cover layer = Cover::none;
	bool layerEncoded = false; ///< the layer's texels are sRGB encoded
	bool throughLens = true;
	Look look = Look::backdrop;
	bool keyed = false;                                    ///< a colour of the layer stands for what is behind it
	Surface surface = Surface::none;                       ///< what the layer lies on, where surface.frag draws it
	auto operator<=>(const PipelineKey &) const = default; // NOLINT(modernize-use-nullptr): its zero is no pointer
};

/// What is drawn day after day: both cameras with linear values, layers of sRGB encoded texels, through the lens.
std::vector<PipelineKey> usualKeys(const PanelOptics &optics);

/// What draws deep surfaces.
constexpr PipelineKey deepKey(bool throughLens)
{
	return {.blend = Blend::over, .layer = Cover::partly, .throughLens = throughLens, .surface = Surface::deep};
}

class Pipelines
{
public:
	/// All of them must outlive it.
	Pipelines(const gpu::Device::Handles &gpu, vk::Format format, const PanelOptics &optics);
	~Pipelines();
	Pipelines(const Pipelines &) = delete;
	vk::RenderPass renderPass() const { return *renderPass_; }
	vk::PipelineLayout layout() const { return *layout_; }
	/// Set 0: eye block, camera image, angle table. Set 1: layer image. Set 2: surface block, at a dynamic offset. Set 3: depth
	/// image, of a deep surface alone. Push constants: layer block. surface.frag uses no push constants, panel.frag no set 2.
	vk::DescriptorSetLayout eyeSetLayout() const { return *eyeSetLayout_; }
	vk::DescriptorSetLayout layerSetLayout() const { return *layerSetLayout_; }
	vk::DescriptorSetLayout surfaceSetLayout() const { return *surfaceSetLayout_; }
	/// Made here and now if it has not been. Throws vk::SystemError where it cannot be.
	vk::Pipeline at(const PipelineKey &key);
	/// Null as long as it is being made, which begins when it is first asked for, unless at() has made it. Throws as at().
	vk::Pipeline find(const PipelineKey &key);

private:
	struct Other {
		vk::raii::Pipeline pipeline{nullptr};
		std::exception_ptr failure;

		vk::Pipeline get() const;
	};
	/// Those that find() was asked for; what is wanted is made in this order.
	struct Others {
		std::map<PipelineKey, Other> pipelines;
		std::deque<PipelineKey> wanted;
	};
	class Factory;
	void makeOthers(const std::stop_token &stop);

	vk::raii::RenderPass renderPass_;
	vk::raii::DescriptorSetLayout eyeSetLayout_, layerSetLayout_, surfaceSetLayout_;
	vk::raii::PipelineLayout layout_;
	std::unique_ptr<const Factory> factory_;
	std::map<PipelineKey, vk::raii::Pipeline> made_; ///< by at()
	Guarded<Others> others_;
	std::jthread makesOthers_;
};

} // namespace arift
