#include "runtime/openxr/opengl/gl_graphics.h"
#include "runtime/openxr/opengl/gl_copied_images.h"
#include "runtime/openxr/opengl/gl_formats.h"
#include "runtime/openxr/opengl/gl_shared_images.h"
#include <algorithm>
#include <cstring>

namespace arift::openxr
{
namespace
{

/// Textures have every usage that their format allows: what was asked for is only looked at.
VkImageUsageFlags usageOf(XrSwapchainUsageFlags flags, VkFormat format)
{
	constexpr XrSwapchainUsageFlags known = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
											XR_SWAPCHAIN_USAGE_UNORDERED_ACCESS_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT |
											XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
											XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT;
	if (flags & ~known) throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "usageFlags has the bits {:#x} that are not supported", flags & ~known);
	return VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
		   (gpu::isDepth(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

void requireVersion(const GlVersion &version)
{
	const XrVersion oldest = version.isEs ? oldestGlEs : oldestGl;
	if (XR_MAKE_VERSION(uint64_t(version.major), uint64_t(version.minor), 0) < oldest)
		throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the context's version is {}.{}, which is older than {}.{}", version.major,
					version.minor, XR_VERSION_MAJOR(oldest), XR_VERSION_MINOR(oldest));
}

} // namespace

namespace
{

/// A buffer of the probe's memory, read. Errors are taken back where GL cannot.
bool seesPattern(const GlApi &gl, const GlSharingApi &sharing, const MemoryProbe &probe)
{
	GLuint memory = 0, buffer = 0;
	GLint before = 0;
	gl.GetIntegerv(GL_COPY_READ_BUFFER_BINDING, &before);
	sharing.CreateMemoryObjectsEXT(1, &memory);
	sharing.ImportMemoryFdEXT(memory, probe.size, GL_HANDLE_TYPE_OPAQUE_FD_EXT, probe.memory.get());
	probe.memory.release(); // GL's now
	gl.GenBuffers(1, &buffer);
	gl.BindBuffer(GL_COPY_READ_BUFFER, buffer);
	sharing.BufferStorageMemEXT(GL_COPY_READ_BUFFER, GLsizeiptr(probe.size), memory, 0);
	const void *bytes = gl.MapBufferRange(GL_COPY_READ_BUFFER, 0, GLsizeiptr(probe.pattern.size()), GL_MAP_READ_BIT);
	const bool isSame = bytes && std::memcmp(bytes, probe.pattern.data(), probe.pattern.size()) == 0;
	if (bytes)
		gl.UnmapBuffer(GL_COPY_READ_BUFFER);
	else
		gl.GetError();
	gl.BindBuffer(GL_COPY_READ_BUFFER, GLuint(before));
	gl.DeleteBuffers(1, &buffer);
	sharing.DeleteMemoryObjectsEXT(1, &memory);
	return isSame;
}

} // namespace

GlGraphics::About GlGraphics::aboutOf(const GlContext &context, const GlApi &gl, const std::optional<GlSharingApi> &sharing)
{
	const CurrentContext current(context);
	About about;
	const auto *version = reinterpret_cast<const char *>(gl.GetString(GL_VERSION));
	if (!version) throw Error(XR_ERROR_GRAPHICS_DEVICE_INVALID, "the graphics binding's context does not work: it has no GL_VERSION");
	about.version = parseGlVersion(version);
	requireVersion(about.version);
	if (sharing) { // without, the service's GPU is another one, and images are copied
		sharing->GetUnsignedBytevEXT(GL_DRIVER_UUID_EXT, about.driverUuid.data());
		sharing->GetUnsignedBytei_vEXT(GL_DEVICE_UUID_EXT, 0, about.deviceUuid.data());
	}
	gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &about.largest);
	gl.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &about.mostLayers);
	return about;
}

GlGraphics::GlGraphics(std::unique_ptr<GlContext> given, const Instance &instance)
	: context(std::move(given)), gl(*context), sharing_(findSharing(*context)), about_(aboutOf(*context, gl, sharing_)), instance_(instance)
{
}

std::vector<int64_t> GlGraphics::formatsOf(std::span<const int32_t> vulkan) const { return glFormatsOf(vulkan, about_.version); }

bool GlGraphics::sees(const MemoryProbe &probe) const
{
	if (!sharing_) return false;
	const CurrentContext current(*context);
	return seesPattern(gl, *sharing_, probe);
}

gpu::ImageSpec GlGraphics::specOf(const XrSwapchainCreateInfo &info, ipc::Sharing sharing) const
{
	gpu::ImageSpec spec;
	spec.format = vulkanFormatOf(info.format);
	spec.usage = usageOf(info.usageFlags, VkFormat(spec.format));
	if (info.faceCount == 6) spec.createFlags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
	spec.width = info.width;
	spec.height = info.height;
	spec.arrayLayers = info.arraySize * info.faceCount;
	spec.mipLevels = info.mipCount;
	spec.samples = info.sampleCount;
	spec.inRows = sharing == ipc::Sharing::memory && gpu::canLieInRows(instance_.service.welcome().deviceType, spec) ? 1 : 0;
	if (int64_t(std::max(spec.width, spec.height)) > about_.largest || int64_t(spec.arrayLayers) > about_.mostLayers)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "the context has no texture of {}x{} with {} layers: at most {} and {}", spec.width,
					spec.height, spec.arrayLayers, about_.largest, about_.mostLayers);
	if (info.faceCount == 6 && info.arraySize > 1)
		throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "arrays of cubes are not supported with OpenGL");
	return spec;
}

std::unique_ptr<SwapchainImages> GlGraphics::import(const gpu::ImageSpec &spec, const SharedMemory &memory)
{
	const CurrentContext current(*context);
	if (memory.sharing == ipc::Sharing::copies) return std::make_unique<GlCopiedImages>(*this, spec, memory);
	return std::make_unique<GlSharedImages>(*this, spec, memory);
}

std::unique_ptr<Graphics> makeGlGraphics(Instance &instance, const void *next)
{
	std::unique_ptr<GlContext> context = glContextOf(instance, next);
	if (!context) return nullptr;
	auto graphics = std::make_unique<GlGraphics>(std::move(context), instance);
	if (!(graphics->isEs() ? instance.openGlEsRequirementsKnown : instance.openGlRequirementsKnown))
		throw Error(XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING, "the {} graphics requirements were not asked for",
					graphics->isEs() ? "OpenGL ES" : "OpenGL");
	return graphics;
}

} // namespace arift::openxr
