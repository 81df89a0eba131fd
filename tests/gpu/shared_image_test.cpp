// One device makes a shared image, another imports it by its file descriptor: both see the same texels.
#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"
#include <cstring>
#include <gtest/gtest.h>
#include <stdexcept>

namespace arift::gpu
{
namespace
{

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

constexpr ImageSpec spec{.format = VK_FORMAT_R8G8B8A8_UNORM,
						 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
						 .width = 37,
						 .height = 21,
						 .arrayLayers = 2};

/// What an application does with the numbers and the descriptor it is sent.
struct Imported {
	Imported(Device &device, const SharedImage &shared) : gpu(device.handles())
	{
		VkExternalMemoryImageCreateInfo external;
		image = vk::raii::Image(gpu.device, vk::ImageCreateInfo(imageCreateInfo(shared.spec(), external)));
		const vk::MemoryDedicatedAllocateInfo dedicated{*image};
		const vk::ImportMemoryFdInfoKHR import{vk::ExternalMemoryHandleTypeFlagBits::eOpaqueFd, shared.exportMemory().release(),
											   &dedicated};
		memory = vk::raii::DeviceMemory(gpu.device, {shared.memorySize(), shared.memoryTypeIndex(), &import});
		image.bindMemory(*memory, 0);
	}
	Device::Handles &gpu;
	vk::raii::Image image{nullptr};
	vk::raii::DeviceMemory memory{nullptr};
};

vk::ImageSubresourceRange allOf() { return {vk::ImageAspectFlagBits::eColor, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS}; }

/// Takes the image over, does `work` in `layout`, and hands it back.
template <typename Work> void owning(Device::Handles &gpu, vk::Image image, Layout layout, Work work)
{
	const auto boundary = Layout(boundaryLayout(VkFormat(spec.format)));
	gpu.runOnce([&](const vk::raii::CommandBuffer &commands) {
		commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
								 vk::ImageMemoryBarrier{{},
														Access::eTransferRead | Access::eTransferWrite,
														boundary,
														layout,
														VK_QUEUE_FAMILY_EXTERNAL,
														gpu.queueFamily,
														image,
														allOf()});
		work(commands);
		commands.pipelineBarrier(
			Stage::eTransfer, Stage::eBottomOfPipe, {}, {}, {},
			vk::ImageMemoryBarrier{
				Access::eTransferWrite, {}, layout, boundary, gpu.queueFamily, VK_QUEUE_FAMILY_EXTERNAL, image, allOf()});
	});
}

void fill(Device::Handles &gpu, vk::Image image, std::array<float, 4> colour)
{
	owning(gpu, image, Layout::eTransferDstOptimal, [&](const auto &commands) {
		commands.clearColorImage(image, Layout::eTransferDstOptimal, vk::ClearColorValue(colour), allOf());
	});
}

/// Every texel of both layers, or nothing where they differ.
std::optional<std::array<uint8_t, 4>> uniformColour(Device::Handles &gpu, vk::Image image)
{
	const size_t texels = size_t(spec.width) * spec.height * spec.arrayLayers;
	const Buffer buffer(gpu, texels * 4, vk::BufferUsageFlagBits::eTransferDst);
	const vk::BufferImageCopy copy{0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, spec.arrayLayers}, {}, {spec.width, spec.height, 1}};
	owning(gpu, image, Layout::eTransferSrcOptimal,
		   [&](const auto &commands) { commands.copyImageToBuffer(image, Layout::eTransferSrcOptimal, *buffer.buffer, copy); });
	std::array<uint8_t, 4> first;
	std::memcpy(first.data(), buffer.bytes.data(), 4);
	for (size_t i = 0; i < texels; ++i)
		if (std::memcmp(buffer.bytes.data() + 4 * i, first.data(), 4) != 0) return std::nullopt;
	return first;
}

using Colour = std::array<uint8_t, 4>;

TEST(SharedImage, isClearWhenMade)
{
	Device device;
	const SharedImage shared(device, spec);
	EXPECT_EQ(uniformColour(device.handles(), shared.image()), (Colour{0, 0, 0, 0}));
	EXPECT_EQ(device.validationMessages(), 0u);
}

TEST(SharedImage, isOneMemoryForBothDevices)
{
	Device service, application;
	const SharedImage shared(service, spec);
	const Imported imported(application, shared);
	fill(application.handles(), *imported.image, {1, 0.2f, 0.4f, 0.6f});
	EXPECT_EQ(uniformColour(service.handles(), shared.image()), (Colour{255, 51, 102, 153}));
	fill(service.handles(), shared.image(), {0, 1, 0, 1});
	EXPECT_EQ(uniformColour(application.handles(), *imported.image), (Colour{0, 255, 0, 255}));
	EXPECT_EQ(service.validationMessages() + application.validationMessages(), 0u);
}

TEST(SharedImage, refusesWhatTheDeviceCannotMake)
{
	Device device;
	ImageSpec tooLarge = spec;
	tooLarge.width = 1 << 20;
	EXPECT_THROW(SharedImage(device, tooLarge), std::runtime_error);
	ImageSpec noSuchUse = spec;
	noSuchUse.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
	EXPECT_THROW(SharedImage(device, noSuchUse), std::runtime_error);
	EXPECT_EQ(device.validationMessages(), 0u);
}

TEST(SharedImage, mayBeUsedForCopiesAlone)
{
	Device device;
	ImageSpec plain = spec;
	plain.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
	const SharedImage shared(device, plain);
	EXPECT_EQ(device.validationMessages(), 0u) << "its boundary layout is an attachment's";
}

TEST(BoundaryLayout, isTheSpecifications)
{
	EXPECT_EQ(boundaryLayout(VK_FORMAT_R8G8B8A8_SRGB), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
	EXPECT_EQ(boundaryLayout(VK_FORMAT_D32_SFLOAT), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
}

} // namespace
} // namespace arift::gpu
