#include "runtime/compositor/pipelines.h"
#include "runtime/base/log.h"
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

vk::raii::RenderPass makeRenderPass(const gpu::Device::Handles &gpu, vk::Format format, vk::AttachmentLoadOp depthAtFirst)
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
	const vk::AttachmentDescription depth{{},
										  depthFormat,
										  vk::SampleCountFlagBits::e1,
										  depthAtFirst,
										  vk::AttachmentStoreOp::eDontCare,
										  vk::AttachmentLoadOp::eDontCare,
										  vk::AttachmentStoreOp::eDontCare,
										  Layout::eUndefined,
										  Layout::eDepthStencilAttachmentOptimal};
	const std::array attachments{colour, depth};
	const vk::AttachmentReference colourReference{0, Layout::eColorAttachmentOptimal};
	const vk::AttachmentReference depthReference{1, Layout::eDepthStencilAttachmentOptimal};
	const vk::SubpassDescription subpass{{}, vk::PipelineBindPoint::eGraphics, {}, colourReference, {}, &depthReference};
	// The image is copied from before and after it is drawn.
	const auto drawn = Access::eColorAttachmentWrite | Access::eColorAttachmentRead;
	const auto tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
	const auto tested = Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;
	const std::array dependencies{
		vk::SubpassDependency{VK_SUBPASS_EXTERNAL, 0, Stage::eTransfer, Stage::eColorAttachmentOutput, Access::eTransferRead, drawn},
		vk::SubpassDependency{VK_SUBPASS_EXTERNAL, 0, tests, tests, Access::eDepthStencilAttachmentWrite, tested},
		vk::SubpassDependency{0, VK_SUBPASS_EXTERNAL, Stage::eColorAttachmentOutput, Stage::eTransfer, Access::eColorAttachmentWrite,
							  Access::eTransferRead}};
	return {gpu.device, vk::RenderPassCreateInfo{{}, attachments, subpass, dependencies}};
}

template <size_t count> vk::raii::DescriptorSetLayout makeSetLayout(const gpu::Device::Handles &gpu, std::array<Type, count> types)
{
	std::array<vk::DescriptorSetLayoutBinding, count> bindings;
	for (uint32_t i = 0; i < count; ++i) {
		// A layer's key is read by fragments, too: too much for what the stages hand on.
		vk::ShaderStageFlags stages = vk::ShaderStageFlagBits::eFragment;
		if (types[i] == Type::eUniformBuffer) stages = vk::ShaderStageFlagBits::eVertex;
		if (types[i] == Type::eUniformBufferDynamic) stages |= vk::ShaderStageFlagBits::eVertex;
		bindings[i] = {i, types[i], 1, stages};
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
	int32_t surface, depth; ///< these three: surface.frag's alone
	VkBool32 keptByAlphaBelow;
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
			int32_t(key.surface),
			int32_t(key.depth),
			key.byAlphaBelow.keptColor != ByAlphaBelow::no || key.byAlphaBelow.keptAlpha != ByAlphaBelow::no};
}

/// Constants are words: the entry of every id.
template <typename Words> auto entriesOf()
{
	std::array<vk::SpecializationMapEntry, sizeof(Words) / 4> entries;
	for (uint32_t i = 0; i < entries.size(); ++i) entries[i] = vk::SpecializationMapEntry{i, 4 * i, 4};
	return entries;
}

vk::BlendFactor factorOf(ByAlphaBelow by, vk::BlendFactor usual)
{
	if (by == ByAlphaBelow::no) return usual;
	return by == ByAlphaBelow::alpha ? vk::BlendFactor::eDstAlpha : vk::BlendFactor::eOneMinusDstAlpha;
}

/// What is near is large in the depth image.
vk::CompareOp compareOfNearness(VkCompareOp ofDistance)
{
	switch (ofDistance) {
	case VK_COMPARE_OP_LESS: return vk::CompareOp::eGreater;
	case VK_COMPARE_OP_LESS_OR_EQUAL: return vk::CompareOp::eGreaterOrEqual;
	case VK_COMPARE_OP_GREATER: return vk::CompareOp::eLess;
	case VK_COMPARE_OP_GREATER_OR_EQUAL: return vk::CompareOp::eLessOrEqual;
	default: return vk::CompareOp(ofDistance);
	}
}

vk::PipelineDepthStencilStateCreateInfo depthState(const PipelineKey &key)
{
	if (key.depth != Depth::tested) return {};
	return {{}, true, key.writesDepth, compareOfNearness(key.compare)};
}

vk::PipelineColorBlendAttachmentState blendState(const PipelineKey &key)
{
	using Component = vk::ColorComponentFlagBits;
	using Factor = vk::BlendFactor;
	const auto all = Component::eR | Component::eG | Component::eB | Component::eA;
	const auto state = [&](Factor colour, Factor keptColour, Factor alpha, Factor keptAlpha) {
		return vk::PipelineColorBlendAttachmentState{true, colour, keptColour, vk::BlendOp::eAdd, alpha, keptAlpha, vk::BlendOp::eAdd, all};
	};
	const auto &[sourceColor, keptColor, sourceAlpha, keptAlpha] = key.byAlphaBelow;
	switch (key.blend) {
	case Blend::replace: break;
	case Blend::clear: return state(Factor::eZero, Factor::eZero, Factor::eZero, Factor::eZero);
	// Every colour has an alpha of its own: the second output of the shader.
	case Blend::over:
		return state(factorOf(sourceColor, Factor::eOne), factorOf(keptColor, Factor::eOneMinusSrc1Color),
					 factorOf(sourceAlpha, Factor::eOne), factorOf(keptAlpha, Factor::eOneMinusSrc1Alpha));
	case Blend::add: return state(Factor::eOne, Factor::eOne, Factor::eZero, Factor::eOne);
	case Blend::under: return state(Factor::eOneMinusDstAlpha, Factor::eOne, Factor::eOne, Factor::eZero);
	}
	return {false, Factor::eOne, Factor::eZero, vk::BlendOp::eAdd, Factor::eOne, Factor::eZero, vk::BlendOp::eAdd, all};
}

} // namespace

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
		const vk::PipelineDepthStencilStateCreateInfo depth = depthState(key);
		const auto attachment = blendState(key);
		const vk::PipelineColorBlendStateCreateInfo blending{{}, false, {}, attachment};
		const std::array dynamics{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
		const vk::PipelineDynamicStateCreateInfo dynamic{{}, dynamics};
		return {gpu_.device,
				cache_,
				{{}, stages, &input, &assembly, nullptr, &viewport, &raster, &samples, &depth, &blending, &dynamic, layout_, renderPass_}};
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
	: renderPass_(makeRenderPass(gpu, format, vk::AttachmentLoadOp::eDontCare)),
	  testingRenderPass_(makeRenderPass(gpu, format, vk::AttachmentLoadOp::eClear)),
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
		try {
			vk::raii::Pipeline made = factory_->make(key);
			others_.update([&](Others &others) { others.pipelines.at(key) = std::move(made); });
		} catch (const std::exception &problem) {
			log::warning("layers of one kind are left out, because the GPU cannot draw them: {}", problem.what());
		}
	}
}

vk::Pipeline Pipelines::find(const PipelineKey &key)
{
	const auto made = made_.find(key);
	if (made != made_.end()) return *made->second;
	{
		const auto others = others_.lock();
		const auto other = others->pipelines.find(key);
		if (other != others->pipelines.end()) return *other->second;
		if (others->pipelines.size() >= mostOthers) return nullptr;
	}
	others_.update([&](Others &others) {
		others.pipelines.emplace(key, nullptr);
		others.wanted.push_back(key);
		if (others.pipelines.size() == mostOthers)
			log::warning("layers have been drawn in {} unusual ways: those drawn in further ones are left out", mostOthers);
	});
	return nullptr;
}

vk::Pipeline Pipelines::at(const PipelineKey &key)
{
	const auto made = made_.find(key);
	return made != made_.end() ? *made->second : *made_.emplace(key, factory_->make(key)).first->second;
}

} // namespace arift
