#include "runtime/compositor/camera_images.h"
#include <algorithm>
#include <cstring>

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;
using Usage = vk::ImageUsageFlagBits;

constexpr vk::ImageSubresourceRange whole{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};

class GpuFrameBuffer final : public FrameBuffer
{
public:
	GpuFrameBuffer(const gpu::Device::Handles &gpu, size_t bytes)
		: gpu_(gpu), buffer_(gpu, std::max<size_t>(bytes, 1), vk::BufferUsageFlagBits::eTransferSrc), size_(bytes)
	{
	}
	std::span<std::byte> bytes() override { return buffer_.bytes.first(size_); }
	bool isOf(const gpu::Device::Handles &gpu) const { return &gpu == &gpu_; }
	vk::Buffer buffer() const { return *buffer_.buffer; }

private:
	const gpu::Device::Handles &gpu_;
	gpu::Buffer buffer_;
	size_t size_;
};

vk::ImageCreateInfo textureInfo(vk::Format format, uint32_t width, uint32_t height)
{
	return {{},
			vk::ImageType::e2D,
			format,
			{width, height, 1},
			1,
			1,
			vk::SampleCountFlagBits::e1,
			vk::ImageTiling::eOptimal,
			Usage::eSampled | Usage::eTransferDst};
}

void beginCopy(const vk::raii::CommandBuffer &commands, vk::Image image)
{
	commands.pipelineBarrier(Stage::eFragmentShader, Stage::eTransfer, {}, {}, {},
							 vk::ImageMemoryBarrier{{},
													Access::eTransferWrite,
													Layout::eUndefined,
													Layout::eTransferDstOptimal,
													VK_QUEUE_FAMILY_IGNORED,
													VK_QUEUE_FAMILY_IGNORED,
													image,
													whole});
}

void endCopy(const vk::raii::CommandBuffer &commands, vk::Image image)
{
	commands.pipelineBarrier(Stage::eTransfer, Stage::eFragmentShader, {}, {}, {},
							 vk::ImageMemoryBarrier{Access::eTransferWrite, Access::eShaderRead, Layout::eTransferDstOptimal,
													Layout::eShaderReadOnlyOptimal, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
													whole});
}

/// `rowTexels` texels from row to row in the buffer.
void copy(const vk::raii::CommandBuffer &commands, vk::Buffer buffer, vk::DeviceSize offset, uint32_t rowTexels, const Texture &texture)
{
	const vk::BufferImageCopy region{
		offset, rowTexels, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {texture.width, texture.height, 1}};
	beginCopy(commands, *texture.image.image);
	commands.copyBufferToImage(buffer, *texture.image.image, Layout::eTransferDstOptimal, region);
	endCopy(commands, *texture.image.image);
}

Texture darkTexel(gpu::Device::Handles &gpu)
{
	Texture texture(gpu, vk::Format::eR8G8B8A8Unorm, 1, 1);
	gpu.runOnce([&](const auto &commands) {
		beginCopy(commands, *texture.image.image);
		commands.clearColorImage(*texture.image.image, Layout::eTransferDstOptimal, vk::ClearColorValue{}, whole);
		endCopy(commands, *texture.image.image);
	});
	return texture;
}

/// Rows must begin at a whole texel of the textures: two bytes.
uint32_t usableStride(const CameraFrame &frame) { return (frame.width * bytesPerPixel(frame.format) + 3) / 4 * 4; }

} // namespace

Texture::Texture(const gpu::Device::Handles &gpu, vk::Format format, uint32_t w, uint32_t h)
	: image(gpu, textureInfo(format, w, h)),
	  view(gpu.device, {{}, *image.image, vk::ImageViewType::e2D, format, {}, whole}),
	  width(w),
	  height(h)
{
}

CameraImages::CameraImages(gpu::Device::Handles &gpu) : gpu_(gpu), nothing_(darkTexel(gpu)) {}

FrameAllocator CameraImages::allocator(gpu::Device::Handles &gpu)
{
	return [&gpu](size_t bytes) { return std::make_shared<GpuFrameBuffer>(gpu, bytes); };
}

void CameraImages::makePlanes(Eye &eye, const CameraFrame &frame)
{
	eye.planes.clear();
	eye.format = frame.format;
	eye.width = frame.width;
	eye.height = frame.height;
	if (isBayer(frame.format))
		for (int plane = 0; plane < 2; ++plane) eye.planes.emplace_back(gpu_, vk::Format::eR8G8Unorm, frame.width / 2, frame.height / 2);
	else
		eye.planes.emplace_back(gpu_, frame.format == PixelFormat::grey16 ? vk::Format::eR16Unorm : vk::Format::eR8Unorm, frame.width,
								frame.height);
}

/// The buffer to copy from: the frame's own where it is ours, else one of ours with a copy of its rows.
vk::Buffer CameraImages::source(Eye &eye, const CameraFrame &frame, uint32_t &stride)
{
	const auto *ours = dynamic_cast<const GpuFrameBuffer *>(frame.buffer.get());
	if (ours && ours->isOf(gpu_) && frame.stride % 2 == 0) {
		stride = frame.stride;
		return ours->buffer();
	}
	stride = usableStride(frame);
	const size_t size = size_t(stride) * frame.height, row = size_t(frame.width) * bytesPerPixel(frame.format);
	if (!eye.staging || eye.staging->bytes.size() < size) eye.staging.emplace(gpu_, size, vk::BufferUsageFlagBits::eTransferSrc);
	const std::span<const std::byte> bytes = frame.buffer->bytes();
	for (uint32_t y = 0; y < frame.height; ++y)
		std::memcpy(eye.staging->bytes.data() + size_t(y) * stride, bytes.data() + size_t(y) * frame.stride, row);
	return *eye.staging->buffer;
}

bool CameraImages::upload(const vk::raii::CommandBuffer &commands, size_t index, const CameraFrame &frame)
{
	Eye &eye = eyes_[index];
	const bool other = eye.planes.empty() || eye.format != frame.format || eye.width != frame.width || eye.height != frame.height;
	if (!other && eye.shownBuffer == frame.buffer.get() && eye.shownSequence == frame.sequence && eye.shownExposure == frame.midExposure)
		return false;
	if (other) makePlanes(eye, frame);
	uint32_t stride = 0;
	const vk::Buffer buffer = source(eye, frame, stride);
	// Two lines of a Bayer image are one row of a half plane: as many texels of two bytes as a line has bytes.
	const uint32_t rowTexels = isBayer(frame.format) ? stride : stride / bytesPerPixel(frame.format);
	for (size_t plane = 0; plane < eye.planes.size(); ++plane) copy(commands, buffer, plane * stride, rowTexels, eye.planes[plane]);
	eye.shownBuffer = frame.buffer.get();
	eye.shownSequence = frame.sequence;
	eye.shownExposure = frame.midExposure;
	return other;
}

std::array<vk::ImageView, 2> CameraImages::planes(size_t index) const
{
	const Eye &eye = eyes_[index];
	if (eye.planes.empty()) return {nothing(), nothing()};
	const vk::ImageView first = *eye.planes.front().view, last = *eye.planes.back().view;
	const bool redBelow = eye.format == PixelFormat::bayerGbrg8 || eye.format == PixelFormat::bayerBggr8;
	return redBelow ? std::array{last, first} : std::array{first, last};
}

Texture makeAngleTable(gpu::Device::Handles &gpu, const PanelOptics &optics, size_t camera)
{
	const bool used = optics.cameraCoefficients == 0 && camera < optics.cameras.size();
	const std::vector<float> values = used ? optics.cameras[camera].form.table : std::vector<float>{0};
	Texture texture(gpu, vk::Format::eR32Sfloat, uint32_t(values.size()), 1);
	const gpu::Buffer buffer(gpu, values.size() * sizeof(float), vk::BufferUsageFlagBits::eTransferSrc);
	std::memcpy(buffer.bytes.data(), values.data(), buffer.bytes.size());
	gpu.runOnce([&](const auto &commands) { copy(commands, *buffer.buffer, 0, uint32_t(values.size()), texture); });
	return texture;
}

} // namespace arift
