#include "runtime/compositor/panel_renderer.h"
#include "runtime/base/clock.h"
#include "runtime/compositor/block_buffer.h"
#include "runtime/compositor/camera_images.h"
#include "runtime/compositor/drawing.h"
#include "runtime/compositor/layer_images.h"
#include "runtime/compositor/pipelines.h"
#include <algorithm>
#include <cstring>

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;
using Type = vk::DescriptorType;
using Usage = vk::ImageUsageFlagBits;

/// An image that is drawn, with what is needed to plan its drawing.
struct Canvas {
	Canvas(gpu::Device::Handles &gpu, const PanelOptics &optics, ViewGeometry view_, vk::Format format, vk::RenderPass renderPass)
		: geometry(view_),
		  grids{makeGrid(optics, geometry, 0), makeGrid(optics, geometry, 1)},
		  image(gpu, {{},
					  vk::ImageType::e2D,
					  format,
					  {geometry.width, geometry.height, 1},
					  1,
					  1,
					  vk::SampleCountFlagBits::e1,
					  vk::ImageTiling::eOptimal,
					  Usage::eColorAttachment | Usage::eTransferSrc | Usage::eTransferDst}),
		  view(gpu.device, {{}, *image.image, vk::ImageViewType::e2D, format, {}, gpu::wholeColour}),
		  depth(gpu, {{},
					  vk::ImageType::e2D,
					  depthFormat,
					  {geometry.width, geometry.height, 1},
					  1,
					  1,
					  vk::SampleCountFlagBits::e1,
					  vk::ImageTiling::eOptimal,
					  Usage::eDepthStencilAttachment}),
		  depthView(gpu.device, {{}, *depth.image, vk::ImageViewType::e2D, depthFormat, {}, {vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1}}),
		  framebuffer(makeFramebuffer(gpu, renderPass))
	{
		blacken(gpu);
	}
	ViewGeometry geometry;
	std::array<TileGrid, 2> grids;
	gpu::Image image;
	vk::raii::ImageView view;
	gpu::Image depth;
	vk::raii::ImageView depthView;
	vk::raii::Framebuffer framebuffer;
	vk::Extent2D extent() const { return {geometry.width, geometry.height}; }

private:
	vk::raii::Framebuffer makeFramebuffer(const gpu::Device::Handles &gpu, vk::RenderPass renderPass) const
	{
		const std::array views{*view, *depthView};
		return {gpu.device, {{}, renderPass, views, geometry.width, geometry.height, 1}};
	}
	/// Once: what lies outside the lens circle is never drawn, all that lies inside is, every time.
	void blacken(gpu::Device::Handles &gpu) const
	{
		const auto change = [&](vk::AccessFlags done, vk::AccessFlags next, Layout from, Layout to) {
			return vk::ImageMemoryBarrier{
				done, next, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image.image, gpu::wholeColour};
		};
		gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
			commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
									 change({}, Access::eTransferWrite, Layout::eUndefined, Layout::eTransferDstOptimal));
			commands.clearColorImage(*image.image, Layout::eTransferDstOptimal, vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 1.0f}),
									 gpu::wholeColour);
			commands.pipelineBarrier(Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {},
									 change(Access::eTransferWrite, {}, Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal));
		});
	}
};

vk::raii::Sampler makeSampler(const gpu::Device::Handles &gpu, vk::Filter filter)
{
	using Address = vk::SamplerAddressMode;
	return {gpu.device,
			{{}, filter, filter, vk::SamplerMipmapMode::eNearest, Address::eClampToEdge, Address::eClampToEdge, Address::eClampToEdge}};
}

/// A set for every eye and band, as makeDrawing() numbers its eye blocks.
constexpr uint32_t eyeSetCount = 2 * bandCount;

vk::raii::DescriptorPool makePool(const gpu::Device::Handles &gpu)
{
	const std::array sizes{vk::DescriptorPoolSize{Type::eUniformBuffer, eyeSetCount},
						   vk::DescriptorPoolSize{Type::eCombinedImageSampler, 2 * eyeSetCount}};
	return {gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, eyeSetCount, sizes}};
}

std::vector<vk::raii::DescriptorSet> makeSets(const gpu::Device::Handles &gpu, const vk::raii::DescriptorPool &pool,
											  const Pipelines &pipelines)
{
	const std::vector layouts(eyeSetCount, pipelines.eyeSetLayout());
	vk::raii::DescriptorSets sets(gpu.device, {*pool, layouts});
	return {std::make_move_iterator(sets.begin()), std::make_move_iterator(sets.end())};
}

/// A layer image that is never drawn: something must be bound.
constexpr uint64_t noImage = UINT64_MAX;
/// Images that are drawn once, to warm up: whether sizes are powers of two is part of what a software renderer compiles.
constexpr std::array<uint64_t, 2> warmUpImages{UINT64_MAX - 1, UINT64_MAX - 2};
constexpr std::array<uint32_t, 2> warmUpSizes{3, 4};
constexpr std::array<uint64_t, 1> warmUpCubes{UINT64_MAX - 3};

gpu::ImageSpec smallImage(uint32_t size)
{
	return {.format = VK_FORMAT_R8G8B8A8_SRGB, .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT, .width = size, .height = size};
}
gpu::ImageSpec smallCube()
{
	gpu::ImageSpec spec = smallImage(4);
	spec.createFlags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
	spec.arrayLayers = 6;
	return spec;
}

} // namespace

struct PanelRenderer::Implementation {
	Implementation(gpu::Device &device_, const Rig &rig, VkFormat panelFormat, Unready unready_);

	void warmUp();
	void draw(Canvas &canvas, const PanelInputs &inputs);
	void record(Canvas &canvas, const PanelInputs &inputs, const Drawing &drawing);
	void drawItems(const Drawing &drawing);
	vk::Pipeline pipelineOf(const PipelineKey &key);
	void uploadCameras(const PanelInputs &inputs);
	void bindTextures(size_t eye);
	FrameVector<const LayerImages::Entry *> imagesOf(const Drawing &drawing) const;
	void writeVertices(const Drawing &drawing);
	ReadbackImage read(const Canvas &canvas);

	gpu::Device &device;
	gpu::Device::Handles &gpu;
	PanelOptics optics;
	VkFormat format;
	Unready unready;
	Pipelines pipelines;
	Canvas panel, eyes;
	vk::raii::Sampler linear, nearest;
	BlockBuffer<shaders::EyeBlock> eyeBlocks;
	DynamicBlocks<shaders::SurfaceBlock> surfaceBlocks;
	std::optional<gpu::Buffer> vertices;
	CameraImages cameraImages;
	std::array<Texture, 2> angleTables;
	gpu::SharedImage noLayer;
	LayerImages layerImages;
	vk::raii::DescriptorPool pool;
	std::vector<vk::raii::DescriptorSet> eyeSets;
	std::array<uint32_t, 2> lensOf{0, 1}; ///< whose angle table each eye's set holds
	vk::raii::CommandPool commandPool;
	vk::raii::CommandBuffers commandBuffers;
	vk::raii::Fence fence;
	Cost cost;

	const vk::raii::CommandBuffer &commands() const { return commandBuffers.front(); }
};

PanelRenderer::Implementation::Implementation(gpu::Device &device_, const Rig &rig, VkFormat panelFormat, Unready unready_)
	: device(device_),
	  gpu(device.handles()),
	  optics(rig),
	  format(panelFormat),
	  unready(unready_),
	  pipelines(gpu, vk::Format(format), optics),
	  panel(gpu, optics, panelGeometry(optics), vk::Format(format), pipelines.renderPass()),
	  eyes(gpu, optics, eyesGeometry(optics), vk::Format(format), pipelines.renderPass()),
	  linear(makeSampler(gpu, vk::Filter::eLinear)),
	  nearest(makeSampler(gpu, vk::Filter::eNearest)),
	  eyeBlocks(gpu, eyeSetCount),
	  surfaceBlocks(gpu, pipelines.surfaceSetLayout(), eyeSetCount * maxDrawnLayers),
	  cameraImages(gpu, optics),
	  angleTables{makeAngleTable(gpu, optics, 0), makeAngleTable(gpu, optics, 1)},
	  noLayer(device, smallImage(1)),
	  layerImages(gpu, pipelines.layerSetLayout(), *linear, *nearest),
	  pool(makePool(gpu)),
	  eyeSets(makeSets(gpu, pool, pipelines)),
	  commandPool(gpu.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, gpu.queueFamily}),
	  commandBuffers(gpu.device, {*commandPool, vk::CommandBufferLevel::ePrimary, 1}),
	  fence(gpu.device, vk::FenceCreateInfo{})
{
	layerImages.add(noImage, noLayer.image(), noLayer.spec(), {});
	gpu.runOnce([&](const auto &setUp) { layerImages.acquire(setUp, std::array{layerImages.find(noImage)}); });
	for (size_t eye = 0; eye < 2; ++eye) bindTextures(eye);
}

/// Nothing is drawing: every draw is waited for.
void PanelRenderer::Implementation::bindTextures(size_t eye)
{
	const std::array images{vk::DescriptorImageInfo{*nearest, cameraImages.sites(eye), Layout::eShaderReadOnlyOptimal},
							vk::DescriptorImageInfo{*linear, *angleTables[lensOf[eye]].view, Layout::eShaderReadOnlyOptimal}};
	for (uint32_t index = uint32_t(eye) * bandCount; index < (eye + 1) * bandCount; ++index) {
		const vk::DescriptorBufferInfo block{eyeBlocks.buffer(), eyeBlocks.offset(index), sizeof(shaders::EyeBlock)};
		gpu.device.updateDescriptorSets({vk::WriteDescriptorSet{*eyeSets[index], 0, 0, Type::eUniformBuffer, {}, block},
										 vk::WriteDescriptorSet{*eyeSets[index], 1, 0, Type::eCombinedImageSampler, images}},
										{});
	}
}

void PanelRenderer::Implementation::uploadCameras(const PanelInputs &inputs)
{
	for (size_t eye = 0; eye < 2; ++eye) {
		const CameraView *camera = cameraOf(inputs, optics, eye);
		if (!camera) continue;
		const uint32_t lens = std::min(camera->lens, 1u);
		const bool otherTable = lensOf[eye] != lens;
		lensOf[eye] = lens;
		if (cameraImages.upload(commands(), eye, camera->frame) || otherTable) bindTextures(eye);
	}
}

FrameVector<const LayerImages::Entry *> PanelRenderer::Implementation::imagesOf(const Drawing &drawing) const
{
	FrameVector<const LayerImages::Entry *> entries;
	for (const DrawItem &item : drawing.items)
		for (const uint64_t image : {item.image, item.depthImage}) {
			if (image == 0) continue;
			const LayerImages::Entry *entry = layerImages.find(image);
			if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(entry);
		}
	return entries;
}

void PanelRenderer::Implementation::writeVertices(const Drawing &drawing)
{
	const auto bytes = std::as_bytes(std::span(drawing.vertices));
	if (!vertices || vertices->bytes.size() < bytes.size())
		vertices.emplace(gpu, std::max<size_t>(2 * bytes.size(), 1 << 16), vk::BufferUsageFlagBits::eVertexBuffer);
	if (!bytes.empty()) std::memcpy(vertices->bytes.data(), bytes.data(), bytes.size());
}

/// Null if what it draws is left out. What replaces everything below it cannot be: older images would be seen there.
vk::Pipeline PanelRenderer::Implementation::pipelineOf(const PipelineKey &key)
{
	const bool canBeLeftOut = unready == Unready::leftOut && key.blend != Blend::replace && key.throughLens;
	return canBeLeftOut ? pipelines.find(key) : pipelines.at(key);
}

void PanelRenderer::Implementation::drawItems(const Drawing &drawing)
{
	const LayerImages::Entry *none = layerImages.find(noImage);
	constexpr shaders::LayerBlock unused{};
	commands().bindVertexBuffers(0, *vertices->buffer, vk::DeviceSize(0));
	for (const DrawItem &item : drawing.items) {
		const vk::Pipeline pipeline = pipelineOf(item.pipeline);
		if (!pipeline) {
			++cost.leftOut;
			continue;
		}
		const LayerImages::Entry *layer = item.image != 0 ? layerImages.find(item.image) : none;
		commands().bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
		commands().bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines.layout(), 0,
									  {*eyeSets[item.eyeBlock], *layer->sets[item.arrayIndex]}, {});
		if (item.pipeline.surface != Surface::none) {
			surfaceBlocks.bind(commands(), pipelines.layout(), 2, item.layerBlock);
			if (item.depthImage != 0)
				commands().bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines.layout(), 3,
											  *layerImages.find(item.depthImage)->sets[item.depthArrayIndex], {});
		} else {
			const bool hasBlock = item.pipeline.layer != Cover::none || item.pipeline.look != Look::backdrop;
			const shaders::LayerBlock &block = hasBlock ? drawing.layerBlocks[item.layerBlock] : unused;
			commands().pushConstants<shaders::LayerBlock>(pipelines.layout(), vk::ShaderStageFlagBits::eVertex, 0, block);
		}
		commands().draw(item.vertexCount, 1, item.firstVertex, 0);
	}
}

void PanelRenderer::Implementation::record(Canvas &canvas, const PanelInputs &inputs, const Drawing &drawing)
{
	eyeBlocks.write(drawing.eyeBlocks);
	surfaceBlocks.write(drawing.surfaceBlocks);
	writeVertices(drawing);
	const auto entries = imagesOf(drawing);
	const vk::Extent2D extent = canvas.extent();
	commands().begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	const XrTime uploading = realTime();
	uploadCameras(inputs);
	cost.upload = inSeconds(realTime() - uploading);
	layerImages.acquire(commands(), entries);
	const bool tests = std::ranges::any_of(drawing.items, [](const DrawItem &item) { return item.pipeline.depth != Depth::unused; });
	const std::array<vk::ClearValue, 2> infinitelyFar{};
	commands().beginRenderPass({pipelines.renderPass(tests), *canvas.framebuffer, {{}, extent}, infinitelyFar},
							   vk::SubpassContents::eInline);
	commands().setViewport(0, vk::Viewport{0, 0, float(extent.width), float(extent.height), 0, 1});
	commands().setScissor(0, vk::Rect2D{{}, extent});
	drawItems(drawing);
	commands().endRenderPass();
	layerImages.release(commands(), entries);
	commands().end();
}

void PanelRenderer::Implementation::warmUp()
{
	std::vector<gpu::SharedImage> images;
	for (size_t i = 0; i < warmUpImages.size(); ++i) {
		const gpu::SharedImage &image = images.emplace_back(device, smallImage(warmUpSizes[i]));
		layerImages.add(warmUpImages[i], image.image(), image.spec(), {});
	}
	const gpu::SharedImage cube(device, smallCube());
	layerImages.add(warmUpCubes[0], cube.image(), cube.spec(), {});
	// Inside the lens circle, where every frame draws anew.
	const glm::ivec2 axis(panel.geometry.eyes[0].axis);
	const std::vector<PipelineKey> usual = usualKeys(optics);
	for (const PipelineKey &key : usual) pipelines.at(key);
	record(panel, {}, warmUpDrawing(usual, warmUpImages, warmUpCubes, {axis.x, axis.y, axis.x + 4, axis.y + 4}));
	gpu.submitAndWait(commands(), fence);
	for (const uint64_t key : warmUpImages) layerImages.remove(key);
	for (const uint64_t key : warmUpCubes) layerImages.remove(key);
}

void PanelRenderer::Implementation::draw(Canvas &canvas, const PanelInputs &inputs)
{
	const XrTime begin = realTime();
	const auto findImage = [&](const LayerTexture &texture) { return layerImages.find(texture); };
	const auto isReady = [&](const PipelineKey &key) { return bool(pipelineOf(key)); };
	const Drawing drawing = makeDrawing(inputs, optics, canvas.geometry, canvas.grids, findImage, isReady);
	const XrTime planned = realTime();
	cost.leftOut = 0;
	record(canvas, inputs, drawing);
	const XrTime recorded = realTime();
	gpu.submitAndWait(commands(), fence);
	cost.plan = inSeconds(planned - begin);
	cost.record = inSeconds(recorded - planned) - cost.upload;
	cost.wait = inSeconds(realTime() - recorded);
}

ReadbackImage PanelRenderer::Implementation::read(const Canvas &canvas)
{
	const size_t texel = format == VK_FORMAT_R16G16B16A16_UNORM ? 8 : 4;
	const vk::Extent2D extent = canvas.extent();
	const gpu::Buffer buffer(gpu, texel * extent.width * extent.height, vk::BufferUsageFlagBits::eTransferDst);
	const vk::BufferImageCopy all{0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {extent.width, extent.height, 1}};
	gpu.runOnce([&](const vk::raii::CommandBuffer &copying) {
		copying.copyImageToBuffer(*canvas.image.image, Layout::eTransferSrcOptimal, *buffer.buffer, all);
		const vk::MemoryBarrier toHost{vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead};
		copying.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {}, toHost, {}, {});
	});
	return {extent.width, extent.height, format, {buffer.bytes.begin(), buffer.bytes.end()}};
}

PanelRenderer::PanelRenderer(gpu::Device &device, const Rig &rig, VkFormat format, Unready unready)
	: implementation_(std::make_unique<Implementation>(device, rig, format, unready))
{
}

PanelRenderer::~PanelRenderer() = default;

void PanelRenderer::warmUp() { implementation_->warmUp(); }

void PanelRenderer::addImage(uint64_t key, VkImage image, const gpu::ImageSpec &spec, const gpu::ImageRows &rows)
{
	implementation_->layerImages.add(key, image, spec, rows);
}

void PanelRenderer::removeImage(uint64_t key) { implementation_->layerImages.remove(key); }

void PanelRenderer::render(const PanelInputs &inputs) { implementation_->draw(implementation_->panel, inputs); }

PanelRenderer::Cost PanelRenderer::cost() const { return implementation_->cost; }

VkImage PanelRenderer::image() const { return *implementation_->panel.image.image; }

VkExtent2D PanelRenderer::extent() const { return implementation_->panel.extent(); }

ReadbackImage PanelRenderer::readPanel() { return implementation_->read(implementation_->panel); }

ReadbackImage PanelRenderer::renderEyes(const PanelInputs &inputs)
{
	implementation_->draw(implementation_->eyes, inputs);
	return implementation_->read(implementation_->eyes);
}

} // namespace arift
