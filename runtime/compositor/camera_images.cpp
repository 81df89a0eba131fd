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
													gpu::wholeColour});
}

void endCopy(const vk::raii::CommandBuffer &commands, vk::Image image)
{
	commands.pipelineBarrier(Stage::eTransfer, Stage::eFragmentShader, {}, {}, {},
							 vk::ImageMemoryBarrier{Access::eTransferWrite, Access::eShaderRead, Layout::eTransferDstOptimal,
													Layout::eShaderReadOnlyOptimal, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
													gpu::wholeColour});
}

void copy(const vk::raii::CommandBuffer &commands, vk::Buffer buffer, const Texture &texture)
{
	const vk::BufferImageCopy region{0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {texture.width, texture.height, 1}};
	beginCopy(commands, *texture.image.image);
	commands.copyBufferToImage(buffer, *texture.image.image, Layout::eTransferDstOptimal, region);
	endCopy(commands, *texture.image.image);
}

void darken(gpu::Device::Handles &gpu, const Texture &texture)
{
	gpu.runOnce([&](const auto &commands) {
		beginCopy(commands, *texture.image.image);
		commands.clearColorImage(*texture.image.image, Layout::eTransferDstOptimal, vk::ClearColorValue{}, gpu::wholeColour);
		endCopy(commands, *texture.image.image);
	});
}

} // namespace

Texture::Texture(const gpu::Device::Handles &gpu, vk::Format format, uint32_t w, uint32_t h)
	: image(gpu, textureInfo(format, w, h)),
	  view(gpu.device, {{}, *image.image, vk::ImageViewType::e2D, format, {}, gpu::wholeColour}),
	  width(w),
	  height(h)
{
}

CameraImages::CameraImages(gpu::Device::Handles &gpu, const PanelOptics &optics)
	: gpu_(gpu), nothing_(gpu, vk::Format::eR8G8B8A8Unorm, 1, 1)
{
	darken(gpu_, nothing_);
	for (size_t eye = 0; eye < std::min(eyes_.size(), optics.cameras.size()); ++eye) {
		const PanelCamera &camera = optics.cameras[eye];
		makeTexture(eyes_[eye], siteImageOf({.format = PixelFormat::bayerRggb8, .width = camera.width, .height = camera.height}));
		darken(gpu_, *eyes_[eye].sites);
	}
}

void CameraImages::makeTexture(Eye &eye, const SiteImage &layout)
{
	eye.layout = layout;
	eye.sites.emplace(gpu_, layout.bytesPerSite == 8 ? vk::Format::eR16G16B16A16Unorm : vk::Format::eR8G8B8A8Unorm, layout.width,
					  layout.height * layout.planes);
	eye.staging.emplace(gpu_, layout.bytes(), vk::BufferUsageFlagBits::eTransferSrc);
}

bool CameraImages::upload(const vk::raii::CommandBuffer &commands, size_t index, const CameraFrame &frame)
{
	Eye &eye = eyes_[index];
	const SiteImage layout = siteImageOf(frame);
	const bool other = !eye.sites || eye.layout != layout;
	if (!other && eye.shownBuffer == frame.buffer.get() && eye.shownSequence == frame.sequence && eye.shownExposure == frame.midExposure)
		return false;
	if (other) makeTexture(eye, layout);
	packSites(frame, eye.staging->bytes);
	copy(commands, *eye.staging->buffer, *eye.sites);
	eye.shownBuffer = frame.buffer.get();
	eye.shownSequence = frame.sequence;
	eye.shownExposure = frame.midExposure;
	return other;
}

Texture makeAngleTable(gpu::Device::Handles &gpu, const PanelOptics &optics, size_t camera)
{
	const bool used = optics.cameraCoefficients == 0 && camera < optics.cameras.size();
	const std::vector<float> values = used ? optics.cameras[camera].form.table : std::vector<float>{0};
	Texture texture(gpu, vk::Format::eR32Sfloat, uint32_t(values.size()), 1);
	const gpu::Buffer buffer(gpu, values.size() * sizeof(float), vk::BufferUsageFlagBits::eTransferSrc);
	std::memcpy(buffer.bytes.data(), values.data(), buffer.bytes.size());
	gpu.runOnce([&](const auto &commands) { copy(commands, *buffer.buffer, texture); });
	return texture;
}

} // namespace arift
