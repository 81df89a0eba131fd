#include "runtime/openxr/opengl/gl_formats.h"
#include "runtime/openxr/error.h"
#include <GL/gl.h>
#include <GL/glext.h>
#include <algorithm>
#include <vulkan/vulkan_core.h>

namespace arift::openxr
{
namespace
{

struct Pair {
	VkFormat vulkan;
	GLenum gl;
	int es; ///< in 30 or 32, OpenGL ES can draw in it from this version on (OpenGL ES 3.2, table 8.10); 0: never
	GlTransfer transfer;
};
// OpenGL 4.6, tables 8.12 and 8.13. There is no order of bytes but red first.
constexpr Pair pairs[] = {
	{VK_FORMAT_R8G8B8A8_SRGB, GL_SRGB8_ALPHA8, 30, {GL_RGBA, GL_UNSIGNED_BYTE}},
	{VK_FORMAT_R8G8B8A8_UNORM, GL_RGBA8, 30, {GL_RGBA, GL_UNSIGNED_BYTE}},
	{VK_FORMAT_R16G16B16A16_SFLOAT, GL_RGBA16F, 32, {GL_RGBA, GL_HALF_FLOAT}},
	{VK_FORMAT_A2B10G10R10_UNORM_PACK32, GL_RGB10_A2, 30, {GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV}},
	{VK_FORMAT_R16G16B16A16_UNORM, GL_RGBA16, 0, {GL_RGBA, GL_UNSIGNED_SHORT}},
	{VK_FORMAT_D32_SFLOAT, GL_DEPTH_COMPONENT32F, 30, {GL_DEPTH_COMPONENT, GL_FLOAT}},
	{VK_FORMAT_D24_UNORM_S8_UINT, GL_DEPTH24_STENCIL8, 30, {GL_DEPTH_COMPONENT, GL_UNSIGNED_INT_24_8}},
	{VK_FORMAT_D32_SFLOAT_S8_UINT, GL_DEPTH32F_STENCIL8, 30, {GL_DEPTH_COMPONENT, GL_FLOAT}},
	{VK_FORMAT_D16_UNORM, GL_DEPTH_COMPONENT16, 30, {GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT}},
};

} // namespace

std::vector<int64_t> glFormatsOf(std::span<const int32_t> vulkan, const GlVersion &version)
{
	const int es = 10 * version.major + version.minor;
	std::vector<int64_t> formats;
	for (const int32_t format : vulkan) {
		const auto *const pair = std::ranges::find_if(pairs, [&](const Pair &p) { return p.vulkan == format; });
		if (pair != std::end(pairs) && (!version.isEs || (pair->es != 0 && pair->es <= es))) formats.push_back(pair->gl);
	}
	return formats;
}

uint32_t glFormatOf(int32_t vulkan)
{
	return std::ranges::find_if(pairs, [&](const Pair &p) { return p.vulkan == vulkan; })->gl;
}

int32_t vulkanFormatOf(int64_t glFormat)
{
	const auto *const pair = std::ranges::find_if(pairs, [&](const Pair &p) { return p.gl == glFormat; });
	if (pair == std::end(pairs)) throw Error(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "{:#x} is no internal format of swapchains", glFormat);
	return pair->vulkan;
}

GlTransfer transferOf(int32_t vulkan)
{
	return std::ranges::find_if(pairs, [&](const Pair &p) { return p.vulkan == vulkan; })->transfer;
}

} // namespace arift::openxr
