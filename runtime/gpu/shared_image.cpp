#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"
#include <cstring>
#include <fmt/core.h>
#include <stdexcept>

namespace arift::gpu
{

namespace
{

constexpr auto handleType = vk::ExternalMemoryHandleTypeFlagBits::eOpaqueFd;

vk::raii::Image makeImage(const Device::Handles &gpu, const ImageSpec &spec)
{
	VkExternalMemoryImageCreateInfo external;
	const vk::ImageCreateInfo info(imageCreateInfo(spec, external));
	const vk::PhysicalDeviceExternalImageFormatInfo shared{handleType};
	const vk::PhysicalDeviceImageFormatInfo2 format{info.format, info.imageType, info.tiling, info.usage, info.flags, &shared};
	try {
		const auto limits = gpu.physical.getImageFormatProperties2<vk::ImageFormatProperties2, vk::ExternalImageFormatProperties>(format);
		const auto &most = limits.get<vk::ImageFormatProperties2>().imageFormatProperties;
		if (spec.width <= most.maxExtent.width && spec.height <= most.maxExtent.height && spec.arrayLayers <= most.maxArrayLayers &&
			spec.mipLevels <= most.maxMipLevels && (vk::SampleCountFlagBits(spec.samples) & most.sampleCounts))
			return {gpu.device, info};
	} catch (const vk::FormatNotSupportedError &) {
	}
	throw std::runtime_error(
		fmt::format("the device cannot share an image of format {}, {}x{}, {} layers, {} mip levels, {} samples, usage {:#x}",
					vk::to_string(info.format), spec.width, spec.height, spec.arrayLayers, spec.mipLevels, spec.samples, spec.usage));
}

vk::raii::DeviceMemory makeMemory(const Device::Handles &gpu, const vk::raii::Image &image, uint32_t type, vk::DeviceSize size)
{
	const vk::MemoryDedicatedAllocateInfo dedicated{*image};
	const vk::ExportMemoryAllocateInfo exported{handleType, &dedicated};
	return {gpu.device, {size, type, &exported}};
}

uint32_t deviceLocalType(const Device::Handles &gpu, uint32_t allowed)
{
	const std::array<vk::MemoryPropertyFlags, 2> wishes{vk::MemoryPropertyFlagBits::eDeviceLocal, vk::MemoryPropertyFlags{}};
	return gpu.memoryType(allowed, wishes);
}

/// Fills with transparent black (depth: the far plane) and hands the image over.
void clearAndRelease(const vk::raii::CommandBuffer &commands, vk::Image image, VkFormat format, uint32_t queueFamily)
{
	using Access = vk::AccessFlagBits;
	using Stage = vk::PipelineStageFlagBits;
	using Layout = vk::ImageLayout;
	const vk::ImageSubresourceRange all{vk::ImageAspectFlags(aspectOf(format)), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
	const vk::ImageMemoryBarrier before{{},
										Access::eTransferWrite,
										Layout::eUndefined,
										Layout::eTransferDstOptimal,
										VK_QUEUE_FAMILY_IGNORED,
										VK_QUEUE_FAMILY_IGNORED,
										image,
										all};
	commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {}, before);
	if (isDepth(format))
		commands.clearDepthStencilImage(image, Layout::eTransferDstOptimal, vk::ClearDepthStencilValue{1, 0}, all);
	else
		commands.clearColorImage(image, Layout::eTransferDstOptimal, vk::ClearColorValue{}, all);
	const vk::ImageMemoryBarrier after{Access::eTransferWrite,
									   {},
									   Layout::eTransferDstOptimal,
									   Layout(boundaryLayout(format)),
									   queueFamily,
									   VK_QUEUE_FAMILY_EXTERNAL,
									   image,
									   all};
	commands.pipelineBarrier(Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {}, after);
}

/// Texels on their way into an image that does not lie in rows.
struct Staging {
	Staging(const Device::Handles &gpu, size_t size)
		: buffer(gpu, size, vk::BufferUsageFlagBits::eTransferSrc),
		  pool(gpu.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, gpu.queueFamily}),
		  commands(std::move(vk::raii::CommandBuffers(gpu.device, {*pool, vk::CommandBufferLevel::ePrimary, 1}).front())),
		  fence(gpu.device, vk::FenceCreateInfo{})
	{
	}
	Buffer buffer;
	vk::raii::CommandPool pool;
	vk::raii::CommandBuffer commands;
	vk::raii::Fence fence;
};

/// Takes the layer over, copies the staged texels into it and hands it back.
void recordWrite(const vk::raii::CommandBuffer &commands, vk::Buffer staged, vk::Image image, const ImageSpec &spec, uint32_t layer,
				 uint32_t queueFamily)
{
	using Access = vk::AccessFlagBits;
	using Stage = vk::PipelineStageFlagBits;
	using Layout = vk::ImageLayout;
	const auto boundary = Layout(boundaryLayout(VkFormat(spec.format)));
	const vk::ImageSubresourceRange range{vk::ImageAspectFlags(aspectOf(VkFormat(spec.format))), 0, VK_REMAINING_MIP_LEVELS, layer, 1};
	const auto copied = vk::ImageAspectFlags(copiedAspectOf(VkFormat(spec.format)));
	commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
	commands.pipelineBarrier(
		Stage::eAllCommands, Stage::eTransfer, {}, {}, {},
		vk::ImageMemoryBarrier{
			{}, Access::eTransferWrite, boundary, Layout::eTransferDstOptimal, VK_QUEUE_FAMILY_EXTERNAL, queueFamily, image, range});
	commands.copyBufferToImage(staged, image, Layout::eTransferDstOptimal,
							   vk::BufferImageCopy{0, 0, 0, {copied, 0, layer, 1}, {}, {spec.width, spec.height, 1}});
	commands.pipelineBarrier(
		Stage::eTransfer, Stage::eAllCommands, {}, {}, {},
		vk::ImageMemoryBarrier{
			Access::eTransferWrite, {}, Layout::eTransferDstOptimal, boundary, queueFamily, VK_QUEUE_FAMILY_EXTERNAL, image, range});
	commands.end();
}

} // namespace

struct SharedImage::Implementation {
	Implementation(Device::Handles &handles, const ImageSpec &wanted)
		: gpu(handles),
		  spec(wanted),
		  image(makeImage(gpu, spec)),
		  size(image.getMemoryRequirements().size),
		  type(deviceLocalType(gpu, image.getMemoryRequirements().memoryTypeBits)),
		  memory(makeMemory(gpu, image, type, size))
	{
		image.bindMemory(*memory, 0);
		if (spec.inRows) map();
		gpu.runOnce([&](const auto &commands) { clearAndRelease(commands, *image, VkFormat(spec.format), gpu.queueFamily); });
	}

	void map()
	{
		const auto layout = image.getSubresourceLayout({vk::ImageAspectFlagBits::eColor, 0, 0});
		first = static_cast<std::byte *>(memory.mapMemory(0, VK_WHOLE_SIZE)) + layout.offset;
		rows = {first, layout.rowPitch, layout.arrayPitch};
	}

	void write(uint32_t layer, std::span<const std::byte> texels)
	{
		const CopyLayout layout = copyLayoutOf(spec);
		if (rows.first) {
			for (size_t y = 0; y < spec.height; ++y)
				std::memcpy(first + layer * rows.layerPitch + y * rows.rowPitch, texels.data() + y * layout.rowPitch, layout.rowPitch);
			return;
		}
		if (!staging) staging.emplace(gpu, layout.layerSize);
		std::memcpy(staging->buffer.bytes.data(), texels.data(), layout.layerSize);
		recordWrite(staging->commands, *staging->buffer.buffer, *image, spec, layer, gpu.queueFamily);
		gpu.submitAndWait(staging->commands, staging->fence);
	}

	Device::Handles &gpu;
	ImageSpec spec;
	vk::raii::Image image;
	vk::DeviceSize size;
	uint32_t type;
	vk::raii::DeviceMemory memory; ///< mapped for as long as it lives, where the image lies in rows
	std::byte *first = nullptr;    ///< of the first row, where it does
	ImageRows rows;
	std::optional<Staging> staging; ///< once it is written
};

uint64_t SharedImage::memorySizeOf(Device &device, const ImageSpec &spec)
{
	return makeImage(device.handles(), spec).getMemoryRequirements().size;
}

SharedImage::SharedImage(Device &device, const ImageSpec &spec) : implementation_(std::make_unique<Implementation>(device.handles(), spec))
{
}
SharedImage::~SharedImage() = default;
SharedImage::SharedImage(SharedImage &&) noexcept = default;

VkImage SharedImage::image() const { return *implementation_->image; }
ImageRows SharedImage::rows() const { return implementation_->rows; }
const ImageSpec &SharedImage::spec() const { return implementation_->spec; }
uint64_t SharedImage::memorySize() const { return implementation_->size; }
uint32_t SharedImage::memoryTypeIndex() const { return implementation_->type; }

void SharedImage::write(uint32_t arrayLayer, std::span<const std::byte> texels) { implementation_->write(arrayLayer, texels); }

UniqueFd SharedImage::exportMemory() const
{
	return UniqueFd(implementation_->gpu.device.getMemoryFdKHR({*implementation_->memory, handleType}));
}

} // namespace arift::gpu
