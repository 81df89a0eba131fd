// Vulkan's formats, in which the service makes images, as OpenGL's sized internal formats.
#pragma once
#include "runtime/openxr/opengl/gl_api.h"
#include <cstdint>
#include <span>
#include <vector>

namespace arift::openxr
{

/// GL's sized internal formats for those of `vulkan` (VkFormats, the runtime's favourite first) that a version of GL or GL ES can draw in.
std::vector<int64_t> glFormatsOf(std::span<const int32_t> vulkan, const GlVersion &version);
/// The sized internal format of one of these VkFormats.
uint32_t glFormatOf(int32_t vulkan);
/// The VkFormat of one of them.
int32_t vulkanFormatOf(int64_t glFormat);
/// How the texels of a VkFormat that glFormatsOf() knows are read back, with the bytes that Vulkan's have: glReadPixels' format and type.
struct GlTransfer {
	uint32_t format = 0, type = 0;
};
GlTransfer transferOf(int32_t vulkan);

} // namespace arift::openxr
