#include "tests/gpu/panel_fixture.h"
#include "runtime/gpu/handles.h"
#include <cmath>
#include <cstring>

namespace arift
{

namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

gpu::ImageSpec specOf(const gpu::Device &device, uint32_t width, uint32_t height, VkFormat format, uint32_t arrayLayers,
					  VkImageCreateFlags flags)
{
	gpu::ImageSpec spec{.format = format,
						.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
						.createFlags = flags,
						.width = width,
						.height = height,
						.arrayLayers = arrayLayers};
	spec.inRows = gpu::canLieInRows(device.identity().deviceType, spec) ? 1 : 0;
	return spec;
}

void upload(gpu::Device &device, const gpu::SharedImage &shared, const std::vector<uint8_t> &bytes)
{
	gpu::Device::Handles &gpu = device.handles();
	const gpu::ImageSpec &spec = shared.spec();
	const gpu::Buffer buffer(gpu, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc);
	std::memcpy(buffer.bytes.data(), bytes.data(), bytes.size());
	const auto boundary = Layout(gpu::boundaryLayout(VkFormat(spec.format)));
	const vk::ImageSubresourceRange all{vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
	const vk::BufferImageCopy copy{0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, spec.arrayLayers}, {}, {spec.width, spec.height, 1}};
	gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
		commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
								 vk::ImageMemoryBarrier{{},
														Access::eTransferWrite,
														boundary,
														Layout::eTransferDstOptimal,
														VK_QUEUE_FAMILY_EXTERNAL,
														gpu.queueFamily,
														shared.image(),
														all});
		commands.copyBufferToImage(*buffer.buffer, shared.image(), Layout::eTransferDstOptimal, copy);
		commands.pipelineBarrier(Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {},
								 vk::ImageMemoryBarrier{Access::eTransferWrite,
														{},
														Layout::eTransferDstOptimal,
														boundary,
														gpu.queueFamily,
														VK_QUEUE_FAMILY_EXTERNAL,
														shared.image(),
														all});
	});
}

} // namespace

double linearOf(double code)
{
	const double v = code / 255;
	return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double encoded(double linear)
{
	const double v = std::clamp(linear, 0.0, 1.0);
	return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

Rig plainRig()
{
	Rig rig;
	rig.name = "plain";
	for (size_t e = 0; e < 2; ++e) {
		rig.eyeInHead[e] = {identityOrientation, {e == 0 ? -0.032f : 0.032f, 0, 0}};
		const CameraModel model(cameraWidth, cameraHeight,
								KannalaBrandt{.fx = 220, .fy = 220, .cx = (cameraWidth - 1) / 2.0, .cy = (cameraHeight - 1) / 2.0, .k = {}},
								0.9);
		rig.cameras.push_back({.model = model, .cameraInHead = rig.eyeInHead[e]});
	}
	return rig;
}

PanelInputs inputsAtRest(const Rig &rig)
{
	PanelInputs inputs;
	inputs.displayTime = second;
	for (size_t e = 0; e < 2; ++e) inputs.top[e] = inputs.bottom[e] = {rig.eyeInHead[e], identityPose};
	return inputs;
}

LayerImage::LayerImage(gpu::Device &device, uint32_t width, uint32_t height, const Texel &texel, VkFormat format, uint32_t arrayLayers,
					   VkImageCreateFlags flags)
	: shared_(device, specOf(device, width, height, format, arrayLayers, flags))
{
	std::vector<uint8_t> bytes;
	for (uint32_t layer = 0; layer < arrayLayers; ++layer)
		for (uint32_t y = 0; y < height; ++y)
			for (uint32_t x = 0; x < width; ++x)
				for (const uint8_t value : texel(x, y, layer)) bytes.push_back(value);
	upload(device, shared_, bytes);
}

CameraFrame PanelTest::frame(PixelFormat format, const std::function<uint8_t(uint32_t, uint32_t)> &value, bool ours, uint32_t padding)
{
	CameraFrame frame{.midExposure = inputs.displayTime - 40 * millisecond,
					  .sequence = ++sequence,
					  .format = format,
					  .width = cameraWidth,
					  .height = cameraHeight,
					  .stride = cameraWidth * bytesPerPixel(format) + padding};
	const size_t bytes = size_t(frame.stride) * cameraHeight;
	frame.buffer = ours ? makeHostFrameBuffer(bytes) : makeHostFrameBuffer(bytes);
	for (uint32_t y = 0; y < cameraHeight; ++y)
		for (uint32_t x = 0; x < frame.stride - padding; ++x) frame.buffer->bytes()[size_t(y) * frame.stride + x] = std::byte(value(x, y));
	return frame;
}

void PanelTest::seeColour()
{
	const auto value = [](uint32_t x, uint32_t y) -> uint8_t { return x % 2 == y % 2 ? (x % 2 ? 50 : 200) : 100; };
	for (uint32_t e = 0; e < 2; ++e)
		inputs.cameras[e] = CameraView{.frame = frame(PixelFormat::bayerRggb8, value), .cameraInOrigin = rig.eyeInHead[e], .lens = e};
}

void PanelTest::seeGrey(uint8_t value)
{
	for (uint32_t e = 0; e < 2; ++e)
		inputs.cameras[e] = CameraView{
			.frame = frame(PixelFormat::grey8, [=](auto, auto) { return value; }), .cameraInOrigin = rig.eyeInHead[e], .lens = e};
}

uint64_t PanelTest::addImage(uint32_t width, uint32_t height, const LayerImage::Texel &texel, VkFormat format, uint32_t arrayLayers)
{
	return add(std::make_unique<LayerImage>(device, width, height, texel, format, arrayLayers));
}

uint64_t PanelTest::addGreenAmongMagenta()
{
	return addImage(8, 4, [](uint32_t x, uint32_t y, auto) {
		const auto &[corner, extent] = greenOnes;
		const bool isGreen = x >= uint32_t(corner.x) && x < uint32_t(corner.x + extent.width) && y >= uint32_t(corner.y) &&
							 y < uint32_t(corner.y + extent.height);
		return isGreen ? std::array<uint8_t, 4>{0, 255, 0, 255} : std::array<uint8_t, 4>{255, 0, 255, 255};
	});
}

int PanelTest::greenPixels() const
{
	int green = 0, others = 0;
	for (int y = 0; y < 800; ++y)
		for (int x = 0; x < 1280; ++x) {
			const auto found = at(x, y);
			green += found == std::array{0, 255, 0};
			others += found != std::array{0, 255, 0} && found != std::array{0, 0, 0};
		}
	EXPECT_EQ(others, 0) << "neither green nor black";
	return green;
}

uint64_t PanelTest::addCube(uint32_t size, const LayerImage::Texel &texel, uint32_t count)
{
	return add(
		std::make_unique<LayerImage>(device, size, size, texel, VK_FORMAT_R8G8B8A8_UNORM, 6 * count, VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT));
}

uint64_t PanelTest::add(std::unique_ptr<LayerImage> image)
{
	images.push_back(std::move(image));
	const uint64_t key = images.size();
	renderer.addImage(key, images.back()->image(), images.back()->spec(), images.back()->rows());
	return key;
}

PanelLayer &PanelTest::addUniformLayer(std::array<uint8_t, 4> colour, XrCompositionLayerFlags flags)
{
	const uint64_t key = addImage(16, 16, [&](auto...) { return colour; });
	PanelLayer &layer = inputs.layers.emplace_back(PanelLayer{.flags = flags});
	const float wide = 1.2f;
	for (size_t e = 0; e < 2; ++e)
		layer.projection[e] = ProjectionView{rig.eyeInHead[e], {-wide, wide, wide, -wide}, {key, 0, {{0, 0}, {16, 16}}}};
	return layer;
}

PanelLayer &PanelTest::addQuad(uint64_t image, XrPosef quadInOrigin, XrExtent2Df size, XrRect2Di rect, uint32_t arrayIndex)
{
	PanelLayer &layer = inputs.layers.emplace_back();
	for (auto &quad : layer.quad) quad = QuadView{quadInOrigin, size, {image, arrayIndex, rect}};
	return layer;
}

void PanelTest::render()
{
	renderer.render(inputs);
	panel = renderer.readPanel();
}

std::array<int, 3> PanelTest::at(int x, int y) const
{
	const std::byte *texel = panel.pixels.data() + 4 * (size_t(y) * panel.width + size_t(x));
	return {int(texel[0]), int(texel[1]), int(texel[2])};
}

glm::dvec2 PanelTest::pixelOf(Eye eye, XrVector3f point) const
{
	const XrVector3f d = inverse(inputs.top[size_t(eye)].viewInOrigin) * point;
	return rig.lens.pixel(eye, Channel::green, {d.x / -d.z, d.y / -d.z}).value();
}

void PanelTest::expectNear(std::array<int, 3> found, const Linear &expected, double tolerance) const
{
	for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], encoded(expected[c]), tolerance) << "channel " << c;
}

} // namespace arift
