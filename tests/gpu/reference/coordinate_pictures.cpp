#include "tests/gpu/reference/coordinate_pictures.h"
#include "runtime/gpu/handles.h"
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>

namespace arift::reference
{
namespace
{

gpu::ImageSpec rgba16(uint32_t width, uint32_t height, bool cube)
{
	gpu::ImageSpec spec;
	spec.format = VK_FORMAT_R16G16B16A16_UNORM;
	spec.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
	spec.width = width;
	spec.height = height;
	if (cube) {
		spec.createFlags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
		spec.arrayLayers = 6;
	}
	return spec;
}

} // namespace

std::vector<uint16_t> coordinateValues(Content content, uint32_t width, uint32_t height)
{
	std::vector<uint16_t> values(size_t(width) * height);
	for (uint32_t row = 0; row < height; ++row)
		for (uint32_t column = 0; column < width; ++column) {
			const double share = content == Content::column ? (column + 0.5) / width : content == Content::row ? (row + 0.5) / height : 1;
			values[size_t(row) * width + column] = uint16_t(std::lround(share * 65535));
		}
	return values;
}

CameraFrame coordinateFrame(const FrameAllocator &allocate, Content content, uint32_t width, uint32_t height)
{
	const std::vector<uint16_t> values = coordinateValues(content, width, height);
	CameraFrame frame;
	frame.format = PixelFormat::grey16;
	frame.width = width;
	frame.height = height;
	frame.stride = width * 2;
	frame.buffer = allocate(values.size() * 2);
	std::memcpy(frame.buffer->bytes().data(), values.data(), values.size() * 2);
	return frame;
}

CoordinateTexture::CoordinateTexture(gpu::Device &device, Content content, uint32_t width, uint32_t height, bool cube)
	: image_(device, rgba16(width, height, cube))
{
	gpu::Device::Handles &gpu = device.handles();
	const std::vector<uint16_t> values = coordinateValues(content, width, height);
	const gpu::Buffer staging(gpu, values.size() * 8, vk::BufferUsageFlagBits::eTransferSrc);
	auto *texels = reinterpret_cast<uint16_t *>(staging.bytes.data());
	for (const uint16_t value : values) {
		for (int channel = 0; channel < 3; ++channel) *texels++ = value;
		*texels++ = 65535;
	}
	gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
		using Access = vk::AccessFlagBits;
		using Stage = vk::PipelineStageFlagBits;
		using Layout = vk::ImageLayout;
		const Layout boundary = Layout(gpu::boundaryLayout(VK_FORMAT_R16G16B16A16_UNORM));
		const uint32_t layers = image_.spec().arrayLayers;
		const vk::ImageSubresourceRange all{vk::ImageAspectFlagBits::eColor, 0, 1, 0, layers};
		const vk::ImageMemoryBarrier take{
			{}, Access::eTransferWrite, boundary, Layout::eTransferDstOptimal, VK_QUEUE_FAMILY_EXTERNAL, gpu.queueFamily, image_.image(),
			all};
		commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {}, take);
		for (uint32_t layer = 0; layer < layers; ++layer) {
			const vk::BufferImageCopy whole{0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, layer, 1}, {}, {width, height, 1}};
			commands.copyBufferToImage(*staging.buffer, image_.image(), Layout::eTransferDstOptimal, whole);
		}
		const vk::ImageMemoryBarrier give{
			Access::eTransferWrite, {}, Layout::eTransferDstOptimal, boundary, gpu.queueFamily, VK_QUEUE_FAMILY_EXTERNAL,
			image_.image(),         all};
		commands.pipelineBarrier(Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {}, give);
	});
}

DepthTexture::DepthTexture(gpu::Device &device, uint32_t width, uint32_t height, const std::function<double(double, double)> &value)
	: image_(device,
			 {.format = VK_FORMAT_D32_SFLOAT, .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, .width = width, .height = height})
{
	std::vector<float> values;
	for (uint32_t row = 0; row < height; ++row)
		for (uint32_t column = 0; column < width; ++column) values.push_back(float(value(column + 0.5, row + 0.5)));
	image_.write(0, std::as_bytes(std::span(values)));
}

PanelReadings::PanelReadings(std::array<ReadbackImage, 3> images, uint32_t width, uint32_t height)
	: images_(std::move(images)), width_(width), height_(height)
{
	for (const ReadbackImage &image : images_)
		if (image.format != VK_FORMAT_R16G16B16A16_UNORM || image.pixels.size() != size_t(image.width) * image.height * 8)
			throw std::runtime_error("the panel is read back in an unexpected format");
}

PanelReadings::Reading PanelReadings::at(uint32_t x, uint32_t y, int channel) const
{
	const auto value = [&](Content content) {
		const ReadbackImage &image = images_[size_t(content)];
		uint16_t bits;
		std::memcpy(&bits, image.pixels.data() + (size_t(y) * image.width + x) * 8 + size_t(channel) * 2, 2);
		return bits / 65535.0;
	};
	return {value(Content::column) * width_ - 0.5, value(Content::row) * height_ - 0.5, value(Content::white)};
}

} // namespace arift::reference
