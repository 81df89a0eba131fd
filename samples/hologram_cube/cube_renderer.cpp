#include "cube_renderer.h"
#include "cube.frag.h"
#include "cube.vert.h"
#include <array>
#include <stdexcept>

namespace
{

constexpr vk::Format depthFormat = vk::Format::eD32Sfloat;

/// The push constants of cube.vert.
struct Placement {
	glm::mat4 clipFromModel, roomFromModel;
};

vk::raii::RenderPass makeRenderPass(const vk::raii::Device &device, vk::Format format)
{
	const std::array attachments{vk::AttachmentDescription{.format = format,
														   .loadOp = vk::AttachmentLoadOp::eClear,
														   .storeOp = vk::AttachmentStoreOp::eStore,
														   .initialLayout = vk::ImageLayout::eColorAttachmentOptimal,
														   .finalLayout = vk::ImageLayout::eColorAttachmentOptimal},
								 vk::AttachmentDescription{.format = depthFormat,
														   .loadOp = vk::AttachmentLoadOp::eClear,
														   .storeOp = vk::AttachmentStoreOp::eDontCare,
														   .initialLayout = vk::ImageLayout::eUndefined,
														   .finalLayout = vk::ImageLayout::eDepthStencilAttachmentOptimal}};
	const vk::AttachmentReference colour{0, vk::ImageLayout::eColorAttachmentOptimal};
	const vk::AttachmentReference depth{1, vk::ImageLayout::eDepthStencilAttachmentOptimal};
	const vk::SubpassDescription subpass{.colorAttachmentCount = 1, .pColorAttachments = &colour, .pDepthStencilAttachment = &depth};
	// A view's depth image serves all its frames: this frame's clear waits for the tests of the frame before.
	constexpr auto stages = vk::PipelineStageFlagBits::eEarlyFragmentTests | vk::PipelineStageFlagBits::eLateFragmentTests |
							vk::PipelineStageFlagBits::eColorAttachmentOutput;
	constexpr auto writes = vk::AccessFlagBits::eDepthStencilAttachmentWrite | vk::AccessFlagBits::eColorAttachmentWrite;
	const vk::SubpassDependency dependency{.srcSubpass = VK_SUBPASS_EXTERNAL,
										   .srcStageMask = stages,
										   .dstStageMask = stages,
										   .srcAccessMask = writes,
										   .dstAccessMask = writes | vk::AccessFlagBits::eDepthStencilAttachmentRead};
	return {device, vk::RenderPassCreateInfo{.attachmentCount = attachments.size(),
											 .pAttachments = attachments.data(),
											 .subpassCount = 1,
											 .pSubpasses = &subpass,
											 .dependencyCount = 1,
											 .pDependencies = &dependency}};
}

vk::raii::PipelineLayout makeLayout(const vk::raii::Device &device)
{
	const vk::PushConstantRange range{vk::ShaderStageFlagBits::eVertex, 0, sizeof(Placement)};
	return {device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &range}};
}

vk::raii::Pipeline makePipeline(const vk::raii::Device &device, vk::PipelineLayout layout, vk::RenderPass renderPass)
{
	const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo{.codeSize = sizeof cube_vert, .pCode = cube_vert});
	const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo{.codeSize = sizeof cube_frag, .pCode = cube_frag});
	const std::array stages{
		vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
		vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}};
	const vk::PipelineVertexInputStateCreateInfo noVertexBuffers;
	const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
	const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
	const vk::PipelineRasterizationStateCreateInfo rasterization{.cullMode = vk::CullModeFlagBits::eBack, .lineWidth = 1};
	const vk::PipelineMultisampleStateCreateInfo oneSample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
	const vk::PipelineDepthStencilStateCreateInfo depth{
		.depthTestEnable = true, .depthWriteEnable = true, .depthCompareOp = vk::CompareOp::eLess};
	using enum vk::ColorComponentFlagBits;
	const vk::PipelineColorBlendAttachmentState replace{.colorWriteMask = eR | eG | eB | eA};
	const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &replace};
	const std::array dynamicStates{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
	const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = dynamicStates.size(), .pDynamicStates = dynamicStates.data()};
	return {device, nullptr,
			vk::GraphicsPipelineCreateInfo{.stageCount = stages.size(),
										   .pStages = stages.data(),
										   .pVertexInputState = &noVertexBuffers,
										   .pInputAssemblyState = &assembly,
										   .pViewportState = &viewport,
										   .pRasterizationState = &rasterization,
										   .pMultisampleState = &oneSample,
										   .pDepthStencilState = &depth,
										   .pColorBlendState = &blend,
										   .pDynamicState = &dynamic,
										   .layout = layout,
										   .renderPass = renderPass}};
}

vk::raii::DeviceMemory allocateOnGpu(const vk::raii::PhysicalDevice &physicalDevice, const vk::raii::Device &device,
									 const vk::MemoryRequirements &needs)
{
	const vk::PhysicalDeviceMemoryProperties memory = physicalDevice.getMemoryProperties();
	for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
		const bool onGpu = bool(memory.memoryTypes[type].propertyFlags & vk::MemoryPropertyFlagBits::eDeviceLocal);
		if (onGpu && (needs.memoryTypeBits >> type & 1))
			return {device, vk::MemoryAllocateInfo{.allocationSize = needs.size, .memoryTypeIndex = type}};
	}
	throw std::runtime_error("the GPU has no memory of its own for a depth image");
}

} // namespace

CubeRenderer::CubeRenderer(const vk::raii::PhysicalDevice &physicalDevice, const vk::raii::Device &device, uint32_t queueFamily,
						   vk::Format format)
	: physicalDevice_(physicalDevice),
	  device_(device),
	  format_(format),
	  queue_(device, queueFamily, 0),
	  renderPass_(makeRenderPass(device, format)),
	  layout_(makeLayout(device)),
	  pipeline_(makePipeline(device, *layout_, *renderPass_)),
	  pool_(device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = queueFamily}),
	  commands_(std::move(vk::raii::CommandBuffers(device, {.commandPool = *pool_, .commandBufferCount = 1}).front())),
	  finished_(device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled})
{
}

CubeRenderer::~CubeRenderer()
{
	try {
		device_.waitIdle();
	} catch (const vk::Error &) { // a lost device: nothing runs on it any more
	}
}

vk::raii::ImageView CubeRenderer::makeImageView(VkImage image, vk::Format format, vk::ImageAspectFlags aspect) const
{
	return {device_, vk::ImageViewCreateInfo{
						 .image = image, .viewType = vk::ImageViewType::e2D, .format = format, .subresourceRange = {aspect, 0, 1, 0, 1}}};
}

void CubeRenderer::addView(const std::vector<VkImage> &images, vk::Extent2D size)
{
	vk::raii::Image depth(device_, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
													   .format = depthFormat,
													   .extent = {size.width, size.height, 1},
													   .mipLevels = 1,
													   .arrayLayers = 1,
													   .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment});
	vk::raii::DeviceMemory memory = allocateOnGpu(physicalDevice_, device_, depth.getMemoryRequirements());
	depth.bindMemory(*memory, 0);
	vk::raii::ImageView depthView = makeImageView(*depth, depthFormat, vk::ImageAspectFlagBits::eDepth);
	std::vector<Target> targets;
	for (const VkImage image : images) {
		vk::raii::ImageView colour = makeImageView(image, format_, vk::ImageAspectFlagBits::eColor);
		const std::array attachments{*colour, *depthView};
		vk::raii::Framebuffer framebuffer(device_, vk::FramebufferCreateInfo{.renderPass = *renderPass_,
																			 .attachmentCount = attachments.size(),
																			 .pAttachments = attachments.data(),
																			 .width = size.width,
																			 .height = size.height,
																			 .layers = 1});
		targets.push_back({std::move(colour), std::move(framebuffer)});
	}
	views_.push_back({size, std::move(memory), std::move(depth), std::move(depthView), std::move(targets)});
}

void CubeRenderer::draw(const std::vector<View> &views, const glm::mat4 &roomFromCube)
{
	if (device_.waitForFences(*finished_, true, 1'000'000'000) != vk::Result::eSuccess)
		throw std::runtime_error("the GPU has not finished a frame within a second");
	device_.resetFences(*finished_);
	commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	commands_.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
	for (size_t i = 0; i < views.size(); ++i) {
		const auto &[size, depthMemory, depth, depthView, targets] = views_[i];
		// Transparent black: the runtime shows the world wherever alpha is 0.
		const std::array clear{vk::ClearValue(vk::ClearColorValue(std::array{0.f, 0.f, 0.f, 0.f})),
							   vk::ClearValue(vk::ClearDepthStencilValue{1, 0})};
		commands_.beginRenderPass({.renderPass = *renderPass_,
								   .framebuffer = *targets.at(views[i].image).framebuffer,
								   .renderArea = {{0, 0}, size},
								   .clearValueCount = clear.size(),
								   .pClearValues = clear.data()},
								  vk::SubpassContents::eInline);
		commands_.setViewport(0, vk::Viewport{0, 0, float(size.width), float(size.height), 0, 1});
		commands_.setScissor(0, vk::Rect2D{{0, 0}, size});
		const Placement placement{views[i].clipFromRoom * roomFromCube, roomFromCube};
		commands_.pushConstants<Placement>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, placement);
		commands_.draw(36, 1, 0, 0);
		commands_.endRenderPass();
	}
	commands_.end();
	queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands_}, *finished_);
}
