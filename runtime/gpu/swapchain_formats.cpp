#include "runtime/gpu/device.h"
#include "runtime/gpu/handles.h"

namespace arift::gpu
{

namespace
{

// Encoded formats first: an application that takes the first one gets its colours right. What engines ask for by name follows.
constexpr std::array candidates{VK_FORMAT_R8G8B8A8_SRGB,
								VK_FORMAT_B8G8R8A8_SRGB,
								VK_FORMAT_R16G16B16A16_SFLOAT,
								VK_FORMAT_A2B10G10R10_UNORM_PACK32,
								VK_FORMAT_R16G16B16A16_UNORM,
								VK_FORMAT_R8G8B8A8_UNORM,
								VK_FORMAT_B8G8R8A8_UNORM,
								VK_FORMAT_D32_SFLOAT,
								VK_FORMAT_D24_UNORM_S8_UINT,
								VK_FORMAT_D32_SFLOAT_S8_UINT,
								VK_FORMAT_D16_UNORM};

bool canShare(const Device::Handles &gpu, VkFormat format)
{
	using Usage = vk::ImageUsageFlagBits;
	const auto attachment = isDepth(format) ? Usage::eDepthStencilAttachment : Usage::eColorAttachment;
	const auto usage = attachment | Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst;
	const vk::PhysicalDeviceExternalImageFormatInfo shared{vk::ExternalMemoryHandleTypeFlagBits::eOpaqueFd};
	const vk::PhysicalDeviceImageFormatInfo2 info{vk::Format(format), vk::ImageType::e2D, vk::ImageTiling::eOptimal, usage, {}, &shared};
	try {
		const auto found = gpu.physical.getImageFormatProperties2<vk::ImageFormatProperties2, vk::ExternalImageFormatProperties>(info);
		const auto features = found.get<vk::ExternalImageFormatProperties>().externalMemoryProperties.externalMemoryFeatures;
		using Feature = vk::ExternalMemoryFeatureFlagBits;
		return bool(features & Feature::eExportable) && bool(features & Feature::eImportable);
	} catch (const vk::FormatNotSupportedError &) {
		return false;
	}
}

} // namespace

std::vector<int64_t> swapchainFormats(Device &device)
{
	std::vector<int64_t> formats;
	for (const VkFormat format : candidates)
		if (canShare(device.handles(), format)) formats.push_back(format);
	return formats;
}

} // namespace arift::gpu
