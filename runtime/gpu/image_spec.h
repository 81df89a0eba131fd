// What a shared image is, in terms both processes agree on. Plain data and pure functions over Vulkan's C types: the client library
// makes its import of an image from exactly the numbers with which the service made the image.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vulkan/vulkan_core.h>

namespace arift::gpu
{

/// Fixed width: travels in messages.
struct ImageSpec {
	int32_t format = 0;       ///< VkFormat
	uint32_t usage = 0;       ///< VkImageUsageFlags the application asked for; imageCreateInfo adds what the service needs
	uint32_t createFlags = 0; ///< VkImageCreateFlags
	uint32_t width = 0, height = 0;
	uint32_t arrayLayers = 1; ///< faces included
	uint32_t mipLevels = 1;
	uint32_t samples = 1;
	uint32_t inRows =
		0; ///< 1: its rows lie one after another in its memory, so that a CPU can look at them: on software devices, of colour
};

/// Where a CPU finds an image's texels; nowhere (null) when they do not lie in rows.
struct ImageRows {
	const std::byte *first = nullptr; ///< array layer 0, mip level 0
	size_t rowPitch = 0, layerPitch = 0;
};

/// The VkImageCreateInfo of the image on both sides; `external` must outlive it and is filled and chained in.
VkImageCreateInfo imageCreateInfo(const ImageSpec &spec, VkExternalMemoryImageCreateInfo &external);

constexpr VkExternalMemoryHandleTypeFlagBits sharedHandleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;

/// The layout in which an application hands an image over and gets it back: OpenXR 1.1 §12.19 (XR_KHR_vulkan_enable2), "Swapchain Image
/// Layout".
VkImageLayout boundaryLayout(VkFormat format);
bool isDepth(VkFormat format);
/// Six array layers are one.
inline bool isCube(const ImageSpec &spec) { return spec.createFlags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT; }
/// What can be looked up in an image: colours at texels, colours by direction, depths.
enum class ImageKind { flat, cube, depth };
inline ImageKind kindOf(const ImageSpec &spec)
{
	if (isDepth(VkFormat(spec.format))) return ImageKind::depth;
	return isCube(spec) ? ImageKind::cube : ImageKind::flat;
}
/// As XrSwapchainCreateInfo::arraySize: cubes, or array layers.
inline uint32_t arraySize(const ImageSpec &spec) { return isCube(spec) ? spec.arrayLayers / 6 : spec.arrayLayers; }
/// The same bits without sRGB encoding: the format in which the compositor samples an image. It decodes by itself, in the shader, what it
/// then mixes: a software renderer would decode every channel of every texel.
VkFormat storedFormat(VkFormat format);
/// Of the formats that swapchains have, in a copy of the image (of depth and stencil, the depth); 0: another.
size_t bytesPerTexel(VkFormat format);

/// How an image's largest mip level lies in memory through which it is copied: rows without padding, array layers one after another.
struct CopyLayout {
	size_t rowPitch = 0;
	size_t layerSize = 0;  ///< of the rows
	size_t layerPitch = 0; ///< from one layer's first texel to the next one's: Vulkan wants copies to begin at multiples of 16 at most
	size_t size = 0;       ///< of all layers
};
CopyLayout copyLayoutOf(const ImageSpec &spec);
/// What of such an image is copied.
VkImageAspectFlags copiedAspectOf(VkFormat format);
/// What images of a format need for that, whatever their application asks for.
VkImageCreateFlags createFlagsOf(VkFormat format);
VkImageAspectFlags aspectOf(VkFormat format);
/// Whether such an image may lie in rows on a device of that VkPhysicalDeviceType: it costs a GPU speed, a software device nothing.
bool canLieInRows(uint32_t deviceType, const ImageSpec &spec);

} // namespace arift::gpu
