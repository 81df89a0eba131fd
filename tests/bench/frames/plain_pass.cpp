#include "tests/bench/frames/plain_pass.h"

#include "plain.frag.h"
#include "plain.vert.h"
#include "runtime/gpu/handles.h"
#include <algorithm>
#include <ctime>

namespace arift::bench
{

namespace
{

using Layout = vk::ImageLayout;
using Usage = vk::ImageUsageFlagBits;

constexpr vk::Extent2D extent{1280, 800};
constexpr vk::ImageSubresourceRange whole{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};

struct Picture {
	Picture(const gpu::Device::Handles &gpu, vk::Format format, vk::ImageUsageFlags usage)
		: image(gpu, {{},
					  vk::ImageType::e2D,
					  format,
					  {extent.width, extent.height, 1},
					  1,
					  1,
					  vk::SampleCountFlagBits::e1,
					  vk::ImageTiling::eOptimal,
					  usage}),
		  view(gpu.device, {{}, *image.image, vk::ImageViewType::e2D, format, {}, whole})
	{
	}
	gpu::Image image;
	vk::raii::ImageView view;
};

vk::raii::RenderPass makeRenderPass(const gpu::Device::Handles &gpu)
{
	const vk::AttachmentDescription colour{{},
										   vk::Format::eR8G8B8A8Srgb,
										   vk::SampleCountFlagBits::e1,
										   vk::AttachmentLoadOp::eDontCare,
										   vk::AttachmentStoreOp::eStore,
										   vk::AttachmentLoadOp::eDontCare,
										   vk::AttachmentStoreOp::eDontCare,
										   Layout::eUndefined,
										   Layout::eColorAttachmentOptimal};
	const vk::AttachmentReference reference{0, Layout::eColorAttachmentOptimal};
	const vk::SubpassDescription subpass{{}, vk::PipelineBindPoint::eGraphics, {}, reference};
	return {gpu.device, vk::RenderPassCreateInfo{{}, colour, subpass}};
}

vk::raii::Pipeline makePipeline(const gpu::Device::Handles &gpu, vk::PipelineLayout layout, vk::RenderPass renderPass)
{
	const vk::raii::ShaderModule vertex(gpu.device, vk::ShaderModuleCreateInfo{{}, sizeof plainVertexShader, plainVertexShader});
	const vk::raii::ShaderModule fragment(gpu.device, vk::ShaderModuleCreateInfo{{}, sizeof plainFragmentShader, plainFragmentShader});
	const std::array stages{vk::PipelineShaderStageCreateInfo{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
							vk::PipelineShaderStageCreateInfo{{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}};
	const vk::PipelineVertexInputStateCreateInfo input;
	const vk::PipelineInputAssemblyStateCreateInfo assembly{{}, vk::PrimitiveTopology::eTriangleList};
	const vk::Viewport viewport{0, 0, float(extent.width), float(extent.height), 0, 1};
	const vk::Rect2D scissor{{}, extent};
	const vk::PipelineViewportStateCreateInfo view{{}, viewport, scissor};
	const vk::PipelineRasterizationStateCreateInfo raster{
		{}, false, false, vk::PolygonMode::eFill, vk::CullModeFlagBits::eNone, vk::FrontFace::eClockwise, false, 0, 0, 0, 1};
	const vk::PipelineMultisampleStateCreateInfo samples;
	using Component = vk::ColorComponentFlagBits;
	vk::PipelineColorBlendAttachmentState attachment;
	attachment.colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA;
	const vk::PipelineColorBlendStateCreateInfo blending{{}, false, {}, attachment};
	return {gpu.device,
			nullptr,
			{{}, stages, &input, &assembly, nullptr, &view, &raster, &samples, nullptr, &blending, nullptr, layout, renderPass}};
}

double processMilliseconds()
{
	timespec used{};
	::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
	return double(used.tv_sec) * 1e3 + double(used.tv_nsec) * 1e-6;
}

class PlainPass
{
public:
	explicit PlainPass(gpu::Device::Handles &gpu)
		: gpu_(gpu),
		  source_(gpu, vk::Format::eR8G8B8A8Unorm, Usage::eSampled | Usage::eTransferDst),
		  target_(gpu, vk::Format::eR8G8B8A8Srgb, Usage::eColorAttachment),
		  renderPass_(makeRenderPass(gpu)),
		  framebuffer_(gpu.device, {{}, *renderPass_, *target_.view, extent.width, extent.height, 1}),
		  sampler_(gpu.device, {{}, vk::Filter::eLinear, vk::Filter::eLinear}),
		  binding_{0, vk::DescriptorType::eCombinedImageSampler, 1, vk::ShaderStageFlagBits::eFragment},
		  setLayout_(gpu.device, {{}, binding_}),
		  layout_(gpu.device, {{}, *setLayout_}),
		  pipeline_(makePipeline(gpu, *layout_, *renderPass_)),
		  poolSize_{vk::DescriptorType::eCombinedImageSampler, 1},
		  pool_(gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, poolSize_}),
		  sets_(gpu.device, {*pool_, *setLayout_})
	{
		const vk::DescriptorImageInfo picture{*sampler_, *source_.view, Layout::eGeneral};
		gpu.device.updateDescriptorSets(vk::WriteDescriptorSet{*sets_.front(), 0, 0, vk::DescriptorType::eCombinedImageSampler, picture},
										{});
		gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
			commands.pipelineBarrier(vk::PipelineStageFlagBits::eTopOfPipe, vk::PipelineStageFlagBits::eTransfer, {}, {}, {},
									 vk::ImageMemoryBarrier{{},
															vk::AccessFlagBits::eTransferWrite,
															Layout::eUndefined,
															Layout::eGeneral,
															VK_QUEUE_FAMILY_IGNORED,
															VK_QUEUE_FAMILY_IGNORED,
															*source_.image.image,
															whole});
			commands.clearColorImage(*source_.image.image, Layout::eGeneral, vk::ClearColorValue(std::array{0.2f, 0.4f, 0.6f, 1.0f}),
									 whole);
		});
	}
	void draw()
	{
		gpu_.runOnce([&](const vk::raii::CommandBuffer &commands) {
			commands.beginRenderPass({*renderPass_, *framebuffer_, {{}, extent}, {}}, vk::SubpassContents::eInline);
			commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
			commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *sets_.front(), {});
			commands.draw(3, 1, 0, 0);
			commands.endRenderPass();
		});
	}

private:
	gpu::Device::Handles &gpu_;
	Picture source_, target_;
	vk::raii::RenderPass renderPass_;
	vk::raii::Framebuffer framebuffer_;
	vk::raii::Sampler sampler_;
	vk::DescriptorSetLayoutBinding binding_;
	vk::raii::DescriptorSetLayout setLayout_;
	vk::raii::PipelineLayout layout_;
	vk::raii::Pipeline pipeline_;
	vk::DescriptorPoolSize poolSize_;
	vk::raii::DescriptorPool pool_;
	vk::raii::DescriptorSets sets_;
};

} // namespace

double plainPassMilliseconds()
{
	gpu::Device device;
	PlainPass pass(device.handles());
	constexpr int rounds = 5, frames = 20;
	pass.draw(); // compiles
	double best = 1e9;
	for (int round = 0; round < rounds; ++round) {
		const double begin = processMilliseconds();
		for (int frame = 0; frame < frames; ++frame) pass.draw();
		best = std::min(best, (processMilliseconds() - begin) / frames);
	}
	return best;
}

} // namespace arift::bench
