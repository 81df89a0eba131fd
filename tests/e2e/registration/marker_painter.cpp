#include "marker_painter.h"
#include "marker_frag.h"
#include "marker_vert.h"
#include <array>
#include <cmath>
#include <optional>

namespace
{

constexpr uint64_t patience = 10'000'000'000; // ns; a software renderer compiles in its first draw

/// What both shader stages are pushed.
struct Push {
	std::array<float, 4> disc, window;
};

vk::raii::RenderPass makePass(const vk::raii::Device &device, vk::Format format)
{
	const vk::AttachmentDescription colour{.format = format,
										   .loadOp = vk::AttachmentLoadOp::eClear,
										   .storeOp = vk::AttachmentStoreOp::eStore,
										   .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
										   .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
										   .finalLayout = vk::ImageLayout::eColorAttachmentOptimal};
	const vk::AttachmentReference reference{0, vk::ImageLayout::eColorAttachmentOptimal};
	const vk::SubpassDescription subpass{
		.pipelineBindPoint = vk::PipelineBindPoint::eGraphics, .colorAttachmentCount = 1, .pColorAttachments = &reference};
	return {device, vk::RenderPassCreateInfo{.attachmentCount = 1, .pAttachments = &colour, .subpassCount = 1, .pSubpasses = &subpass}};
}

vk::raii::PipelineLayout makeLayout(const vk::raii::Device &device)
{
	const vk::PushConstantRange range{vk::ShaderStageFlagBits::eFragment, 0, sizeof(Push)};
	return {device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &range}};
}

vk::raii::Pipeline makePipeline(const vk::raii::Device &device, vk::PipelineLayout layout, vk::RenderPass pass)
{
	const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo{.codeSize = sizeof(marker_vert), .pCode = marker_vert});
	const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo{.codeSize = sizeof(marker_frag), .pCode = marker_frag});
	const std::array stages{
		vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
		vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}};
	const vk::PipelineVertexInputStateCreateInfo noVertices;
	const vk::PipelineInputAssemblyStateCreateInfo triangles{.topology = vk::PrimitiveTopology::eTriangleList};
	const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
	const vk::PipelineRasterizationStateCreateInfo filled{.cullMode = vk::CullModeFlagBits::eNone, .lineWidth = 1};
	const vk::PipelineMultisampleStateCreateInfo single{.rasterizationSamples = vk::SampleCountFlagBits::e1};
	using enum vk::ColorComponentFlagBits;
	const vk::PipelineColorBlendAttachmentState replace{.colorWriteMask = eR | eG | eB | eA};
	const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &replace};
	constexpr std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
	const vk::PipelineDynamicStateCreateInfo dynamics{.dynamicStateCount = uint32_t(dynamic.size()), .pDynamicStates = dynamic.data()};
	return {device, nullptr,
			vk::GraphicsPipelineCreateInfo{.stageCount = uint32_t(stages.size()),
										   .pStages = stages.data(),
										   .pVertexInputState = &noVertices,
										   .pInputAssemblyState = &triangles,
										   .pViewportState = &viewport,
										   .pRasterizationState = &filled,
										   .pMultisampleState = &single,
										   .pColorBlendState = &blend,
										   .pDynamicState = &dynamics,
										   .layout = layout,
										   .renderPass = pass}};
}

/// The pixels that a disc can touch; nothing when it is behind the view or outside it.
std::optional<vk::Rect2D> around(const Disc &disc, const std::array<float, 4> &window, vk::Extent2D extent)
{
	const double x = disc.centre.x, y = disc.centre.y, z = -double(disc.centre.z);
	const double distance = std::sqrt(x * x + y * y + z * z), off = std::acos(z / distance),
				 half = std::asin(std::min(1.0, disc.radius / distance));
	if (off + half > 1.4) return std::nullopt;
	// The cone around the disc lies within these tangents: along the radius the tangent's slope is 1/cos^2, largest at the far rim.
	const double reach = 1.05 * half / std::pow(std::cos(off + half), 2);
	const double column = (x / z - window[0]) / window[2], row = (y / z - window[1]) / window[3];
	const double columns = reach / window[2] + 3, rows = reach / -window[3] + 3;
	const auto inside = [](double value, uint32_t end) { return int32_t(std::clamp(value, 0.0, double(end))); };
	const int32_t left = inside(std::floor(column - columns), extent.width), right = inside(std::ceil(column + columns), extent.width);
	const int32_t top = inside(std::floor(row - rows), extent.height), bottom = inside(std::ceil(row + rows), extent.height);
	if (left >= right || top >= bottom) return std::nullopt;
	return vk::Rect2D{{left, top}, {uint32_t(right - left), uint32_t(bottom - top)}};
}

} // namespace

MarkerPainter::MarkerPainter(const Vulkan &vulkan, vk::Format format, vk::Extent2D extent)
	: device_(vulkan.device),
	  format_(format),
	  extent_(extent),
	  queue_(device_, vulkan.queueFamily, 0),
	  pool_(device_,
			vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan.queueFamily}),
	  pass_(makePass(device_, format)),
	  layout_(makeLayout(device_)),
	  pipeline_(makePipeline(device_, *layout_, *pass_))
{
}

MarkerPainter::~MarkerPainter()
{
	for (const auto &[image, target] : targets_) (void)(*device_).waitForFences(*target.drawn, true, patience, *device_.getDispatcher());
}

MarkerPainter::Target &MarkerPainter::target(VkImage image)
{
	if (const auto known = targets_.find(image); known != targets_.end()) return known->second;
	vk::raii::ImageView view(device_, vk::ImageViewCreateInfo{.image = image,
															  .viewType = vk::ImageViewType::e2D,
															  .format = format_,
															  .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}});
	const vk::ImageView attachment = *view;
	vk::raii::Framebuffer framebuffer(device_, vk::FramebufferCreateInfo{.renderPass = *pass_,
																		 .attachmentCount = 1,
																		 .pAttachments = &attachment,
																		 .width = extent_.width,
																		 .height = extent_.height,
																		 .layers = 1});
	vk::raii::CommandBuffers commands(device_, vk::CommandBufferAllocateInfo{.commandPool = *pool_, .commandBufferCount = 1});
	vk::raii::Fence drawn(device_, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled});
	return targets_.emplace(image, Target{std::move(view), std::move(framebuffer), std::move(commands[0]), std::move(drawn)}).first->second;
}

void MarkerPainter::record(const Target &target, const XrFovf &fov, std::span<const Disc> discs) const
{
	const float left = std::tan(fov.angleLeft), right = std::tan(fov.angleRight), up = std::tan(fov.angleUp),
				down = std::tan(fov.angleDown);
	const std::array<float, 4> window{left, up, (right - left) / float(extent_.width), (down - up) / float(extent_.height)};
	const vk::raii::CommandBuffer &commands = target.commands;
	commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	const vk::ClearValue nothing{};
	commands.beginRenderPass(vk::RenderPassBeginInfo{.renderPass = *pass_,
													 .framebuffer = *target.framebuffer,
													 .renderArea = {{0, 0}, extent_},
													 .clearValueCount = 1,
													 .pClearValues = &nothing},
							 vk::SubpassContents::eInline);
	commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
	commands.setViewport(0, vk::Viewport{0, 0, float(extent_.width), float(extent_.height), 0, 1});
	for (const Disc &disc : discs) {
		const auto scissor = around(disc, window, extent_);
		if (!scissor) continue;
		commands.setScissor(0, *scissor);
		commands.pushConstants<Push>(*layout_, vk::ShaderStageFlagBits::eFragment, 0,
									 Push{{disc.centre.x, disc.centre.y, disc.centre.z, disc.radius}, window});
		commands.draw(3, 1, 0, 0);
	}
	commands.endRenderPass();
	commands.end();
}

void MarkerPainter::paint(VkImage image, const XrFovf &fov, std::span<const Disc> discs)
{
	Target &to = target(image);
	if (device_.waitForFences(*to.drawn, true, patience) != vk::Result::eSuccess) throw std::runtime_error("the GPU does not finish");
	device_.resetFences(*to.drawn);
	record(to, fov, discs);
	const vk::CommandBuffer commands = *to.commands;
	queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &commands}, *to.drawn);
}
