#include "runtime/compositor/pipelines.h"
#include "shaders/panel.frag.h"
#include "shaders/panel.vert.h"
#include "shaders/panel_blocks.h"
#include "shaders/surface.frag.h"
#include "shaders/surface.vert.h"
#include "shaders/surface_cube.frag.h"
#include "shaders/surface_deep.frag.h"
#include "shaders/surface_deep.vert.h"
#include <array>
#include <sys/resource.h>
#include <unistd.h>

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;
using Type = vk::DescriptorType;

vk::raii::RenderPass makeRenderPass(const gpu::Device::Handles &gpu, vk::Format format)
{
	const vk::AttachmentDescription colour{{},
										   format,
										   vk::SampleCountFlagBits::e1,
										   vk::AttachmentLoadOp::eLoad,
										   vk::AttachmentStoreOp::eStore,
										   vk::AttachmentLoadOp::eDontCare,
										   vk::AttachmentStoreOp::eDontCare,
										   Layout::eTransferSrcOptimal,
										   Layout::eTransferSrcOptimal};
	const vk::AttachmentReference reference{0, Layout::eColorAttachmentOptimal};
	const vk::SubpassDescription subpass{{}, vk::PipelineBindPoint::eGraphics, {}, reference};
	// The image is copied from before and after it is drawn.
	const auto drawn = Access::eColorAttachmentWrite | Access::eColorAttachmentRead;
	const std::array dependencies{
		vk::SubpassDependency{VK_SUBPASS_EXTERNAL, 0, Stage::eTransfer, Stage::eColorAttachmentOutput, Access::eTransferRead, drawn},
		vk::SubpassDependency{0, VK_SUBPASS_EXTERNAL, Stage::eColorAttachmentOutput, Stage::eTransfer, Access::eColorAttachmentWrite,
							  Access::eTransferRead}};
	return {gpu.device, vk::RenderPassCreateInfo{{}, colour, subpass, dependencies}};
}

template <size_t count> vk::raii::DescriptorSetLayout makeSetLayout(const gpu::Device::Handles &gpu, std::array<Type, count> types)
{
	std::array<vk::DescriptorSetLayoutBinding, count> bindings;
	for (uint32_t i = 0; i < count; ++i) {
		const bool block = types[i] == Type::eUniformBuffer || types[i] == Type::eUniformBufferDynamic;
		bindings[i] = {i, types[i], 1, block ? vk::ShaderStageFlagBits::eVertex : vk::ShaderStageFlagBits::eFragment};
	}
	return {gpu.device, {{}, bindings}};
}

vk::raii::PipelineLayout makeLayout(const gpu::Device::Handles &gpu, const std::array<vk::DescriptorSetLayout, 4> &sets)
{
	const vk::PushConstantRange layerBlock{vk::ShaderStageFlagBits::eVertex, 0, sizeof(shaders::LayerBlock)};
	return {gpu.device, {{}, sets, layerBlock}};
}

/// In the order of the vertex shader's constant ids.
struct VertexConstants {
	float clipPerPixelX, clipPerPixelY, lensVectorPerPixel;
};

/// In the order of the fragment shader's constant ids.
struct Constants {
	int32_t distortionCoefficients, cameraCoefficients;
	VkBool32 tangential;
	int32_t background;
	VkBool32 encoded;
	int32_t layer;
	VkBool32 throughLens, redItself, layerEncoded;
	PanelNumbers numbers;
	int32_t look;
	VkBool32 keyed;
	int32_t surface; ///< surface.frag's alone
};

Constants constantsFor(const PanelOptics &optics, const ViewGeometry &geometry, const PipelineKey &key)
{
	return {int32_t(optics.shaderLens.coefficients),
			int32_t(optics.cameraCoefficients),
			optics.tangential,
			int32_t(key.background),
			key.encoded,
			int32_t(key.layer),
			key.throughLens,
			optics.redItself,
			key.layerEncoded,
			numbersFor(optics, geometry, key.camera),
			int32_t(key.look),
			key.keyed,
			int32_t(key.surface)};
}

/// Constants are words: the entry of every id.
template <typename Words> auto entriesOf()
{
	std::array<vk::SpecializationMapEntry, sizeof(Words) / 4> entries;
	for (uint32_t i = 0; i < entries.size(); ++i) entries[i] = vk::SpecializationMapEntry{i, 4 * i, 4};
	return entries;
}

vk::PipelineColorBlendAttachmentState blendState(Blend blend)
{
	using Component = vk::ColorComponentFlagBits;
	using Factor = vk::BlendFactor;
	const auto all = Component::eR | Component::eG | Component::eB | Component::eA;
	const auto state = [&](Factor colour, Factor keptColour, Factor alpha, Factor keptAlpha) {
		return vk::PipelineColorBlendAttachmentState{true, colour, keptColour, vk::BlendOp::eAdd, alpha, keptAlpha, vk::BlendOp::eAdd, all};
	};
	switch (blend) {
	case Blend::replace: break;
	case Blend::clear: return state(Factor::eZero, Factor::eZero, Factor::eZero, Factor::eZero);
	// Every colour has an alpha of its own: the second output of the shader.
	case Blend::over: return state(Factor::eOne, Factor::eOneMinusSrc1Color, Factor::eOne, Factor::eOneMinusSrc1Alpha);
	case Blend::add: return state(Factor::eOne, Factor::eOne, Factor::eZero, Factor::eOne);
	case Blend::under: return state(Factor::eOneMinusDstAlpha, Factor::eOne, Factor::eOne, Factor::eZero);
	}
	return {false, Factor::eOne, Factor::eZero, vk::BlendOp::eAdd, Factor::eOne, Factor::eZero, vk::BlendOp::eAdd, all};
}

/// What can lie behind layers.
std::vector<PipelineKey> backdrops(const PanelOptics &optics)
{
	std::vector<PipelineKey> keys{{.background = Background::pattern}, {.background = Background::unseen}};
	for (uint32_t camera = 0; camera < optics.cameras.size(); ++camera)
		keys.push_back({.background = Background::camera, .camera = camera});
	return keys;
}

} // namespace

std::vector<PipelineKey> usualKeys(const PanelOptics &optics)
{
	std::vector<PipelineKey> keys{{}, {.blend = Blend::clear}};
	for (PipelineKey key : backdrops(optics)) {
		keys.push_back(key);
		// A layer over everything is drawn with what is behind it.
		if (key.background != Background::pattern) {
			keys.push_back(key);
			keys.back().layer = Cover::fully;
			keys.back().layerEncoded = true;
		}
		keys.push_back(key);
		keys.back().blend = Blend::under;
		// As a layer: what the cameras do not see is the same picture's fill.
		for (const Look look : {Look::faded, Look::styled}) {
			if (key.background == Background::unseen) break;
			keys.push_back(key);
			keys.back().blend = Blend::over;
			keys.back().look = look;
		}
	}
	for (const Cover cover : {Cover::fully, Cover::opaque}) keys.push_back({.layer = cover, .layerEncoded = true});
	for (const Cover cover : {Cover::fully, Cover::partly}) keys.push_back({.blend = Blend::over, .layer = cover, .layerEncoded = true});
	keys.push_back({.blend = Blend::over, .layer = Cover::partly, .layerEncoded = true, .keyed = true});
	// Layers that are not plain are drawn over what is there.
	for (const Surface surface : {Surface::flat, Surface::cylinder, Surface::sphere, Surface::cube})
		keys.push_back({.blend = Blend::over, .layer = Cover::partly, .surface = surface});
	return keys;
}

class Pipelines::Factory
{
public:
	Factory(const gpu::Device::Handles &gpu, const PanelOptics &optics, vk::PipelineLayout layout, vk::RenderPass renderPass)
		: gpu_(gpu), optics_(optics), layout_(layout), renderPass_(renderPass)
	{
	}

	vk::raii::Pipeline make(const PipelineKey &key) const
	{
		const ViewGeometry geometry = key.throughLens ? panelGeometry(optics_) : eyesGeometry(optics_);
		const VertexConstants size{2.0f / float(geometry.width), 2.0f / float(geometry.height), float(geometry.eyes[0].perPixel.x)};
		const Constants constants = constantsFor(optics_, geometry, key);
		const auto sizeEntries = entriesOf<VertexConstants>();
		const auto entries = entriesOf<Constants>();
		const vk::SpecializationInfo bySize{uint32_t(sizeEntries.size()), sizeEntries.data(), sizeof size, &size};
		const vk::SpecializationInfo byOptics{uint32_t(entries.size()), entries.data(), sizeof constants, &constants};
		const std::array stages{
			vk::PipelineShaderStageCreateInfo{{}, vk::ShaderStageFlagBits::eVertex, vertexOf(key.surface), "main", &bySize},
			vk::PipelineShaderStageCreateInfo{{}, vk::ShaderStageFlagBits::eFragment, fragmentOf(key.surface), "main", &byOptics}};
		const vk::VertexInputBindingDescription binding{0, 2 * sizeof(int16_t)};
		const vk::VertexInputAttributeDescription attribute{0, 0, vk::Format::eR16G16Sint, 0};
		const vk::PipelineVertexInputStateCreateInfo input{{}, binding, attribute};
		const vk::PipelineInputAssemblyStateCreateInfo assembly{{}, vk::PrimitiveTopology::eTriangleList};
		const vk::PipelineViewportStateCreateInfo viewport{{}, 1, nullptr, 1, nullptr};
		const vk::PipelineRasterizationStateCreateInfo raster{
			{}, false, false, vk::PolygonMode::eFill, vk::CullModeFlagBits::eNone, vk::FrontFace::eClockwise, false, 0, 0, 0, 1};
		const vk::PipelineMultisampleStateCreateInfo samples;
		const auto attachment = blendState(key.blend);
		const vk::PipelineColorBlendStateCreateInfo blending{{}, false, {}, attachment};
		const std::array dynamics{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
		const vk::PipelineDynamicStateCreateInfo dynamic{{}, dynamics};
		return {gpu_.device,
				cache_,
				{{}, stages, &input, &assembly, nullptr, &viewport, &raster, &samples, nullptr, &blending, &dynamic, layout_, renderPass_}};
	}

private:
	template <size_t words> vk::raii::ShaderModule module(const uint32_t (&code)[words]) const
	{
		return {gpu_.device, vk::ShaderModuleCreateInfo{{}, sizeof code, code}};
	}
	vk::ShaderModule vertexOf(Surface surface) const
	{
		if (surface == Surface::none) return *vertex_;
		return surface == Surface::deep ? *deepVertex_ : *surfaceVertex_;
	}
	vk::ShaderModule fragmentOf(Surface surface) const
	{
		if (surface == Surface::none) return *fragment_;
		if (surface == Surface::deep) return *deepFragment_;
		return surface == Surface::cube ? *cubeFragment_ : *surfaceFragment_;
	}

	const gpu::Device::Handles &gpu_;
	const PanelOptics &optics_;
	vk::PipelineLayout layout_;
	vk::RenderPass renderPass_;
	vk::raii::ShaderModule vertex_ = module(panelVertexShader), fragment_ = module(panelFragmentShader);
	vk::raii::ShaderModule surfaceVertex_ = module(surfaceVertexShader), surfaceFragment_ = module(surfaceFragmentShader);
	vk::raii::ShaderModule cubeFragment_ = module(cubeFragmentShader);
	vk::raii::ShaderModule deepVertex_ = module(deepVertexShader), deepFragment_ = module(deepFragmentShader);
	vk::raii::PipelineCache cache_{gpu_.device, vk::PipelineCacheCreateInfo{}};
};

Pipelines::Pipelines(const gpu::Device::Handles &gpu, vk::Format format, const PanelOptics &optics)
	: renderPass_(makeRenderPass(gpu, format)),
	  eyeSetLayout_(makeSetLayout(gpu, std::array{Type::eUniformBuffer, Type::eCombinedImageSampler, Type::eCombinedImageSampler})),
	  layerSetLayout_(makeSetLayout(gpu, std::array{Type::eCombinedImageSampler})),
	  surfaceSetLayout_(makeSetLayout(gpu, std::array{Type::eUniformBufferDynamic})),
	  layout_(makeLayout(gpu, {*eyeSetLayout_, *layerSetLayout_, *surfaceSetLayout_, *layerSetLayout_})),
	  factory_(std::make_unique<const Factory>(gpu, optics, *layout_, *renderPass_)),
	  makesOthers_([this](const std::stop_token &stop) { makeOthers(stop); })
{
}

Pipelines::~Pipelines() = default;

/// Images are shown meanwhile: the thread leaves the processors to them.
void Pipelines::makeOthers(const std::stop_token &stop)
{
	::setpriority(PRIO_PROCESS, id_t(::gettid()), 19);
	for (;;) {
		PipelineKey key;
		{
			auto others = others_.lock();
			if (!others.wait(stop, [](const Others &now) { return !now.wanted.empty(); })) return;
			key = others->wanted.front();
			others->wanted.pop_front();
		}
		Other made;
		try {
			made.pipeline = factory_->make(key);
		} catch (...) {
			made.failure = std::current_exception();
		}
		others_.update([&](Others &others) { others.pipelines.at(key) = std::move(made); });
	}
}

vk::Pipeline Pipelines::Other::get() const
{
	if (failure) std::rethrow_exception(failure);
	return *pipeline;
}

vk::Pipeline Pipelines::find(const PipelineKey &key)
{
	const auto made = made_.find(key);
	if (made != made_.end()) return *made->second;
	{
		const auto others = others_.lock();
		const auto other = others->pipelines.find(key);
		if (other != others->pipelines.end()) return other->second.get();
	}
	others_.update([&](Others &others) {
		others.pipelines[key];
		others.wanted.push_back(key);
	});
	return nullptr;
}

vk::Pipeline Pipelines::at(const PipelineKey &key)
{
	const auto made = made_.find(key);
	return made != made_.end() ? *made->second : *made_.emplace(key, factory_->make(key)).first->second;
}

} // namespace arift
