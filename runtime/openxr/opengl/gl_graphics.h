// A session's OpenGL or OpenGL ES binding: the application's context.
#pragma once
#include "runtime/openxr/graphics.h"
#include "runtime/openxr/opengl/gl_api.h"
#include <optional>

namespace arift::openxr
{

/// The oldest and newest versions of GL a session can be made with.
constexpr XrVersion oldestGl = XR_MAKE_VERSION(3, 3, 0), newestGl = XR_MAKE_VERSION(4, 6, 0);
constexpr XrVersion oldestGlEs = XR_MAKE_VERSION(3, 0, 0), newestGlEs = XR_MAKE_VERSION(3, 2, 0);

class GlGraphics final : public Graphics
{
public:
	/// In xrCreateSession. Throws XR_ERROR_GRAPHICS_DEVICE_INVALID for a context that is too old or does not work.
	GlGraphics(std::unique_ptr<GlContext> context, const Instance &instance);
	std::array<uint8_t, 16> deviceUuid() const override { return about_.deviceUuid; }
	std::array<uint8_t, 16> driverUuid() const override { return about_.driverUuid; }
	bool rowsGoUp() const override { return true; }
	/// OpenGL ES cannot read it back.
	bool copiesDepth() const override { return false; }
	std::vector<int64_t> formatsOf(std::span<const int32_t> vulkan) const override;
	bool sees(const MemoryProbe &probe) const override;
	gpu::ImageSpec specOf(const XrSwapchainCreateInfo &info, ipc::Sharing sharing) const override;
	std::unique_ptr<SwapchainImages> import(const gpu::ImageSpec &spec, const SharedMemory &memory) override;

	bool isEs() const { return about_.version.isEs; }
	/// Whether the call that is under way is one that may use the context.
	bool mayUseContext() const { return !instance_.isEnding; }
	/// Only where images are not copied.
	const GlSharingApi &sharing() const { return *sharing_; }

	const std::unique_ptr<const GlContext> context;
	const GlApi gl;

private:
	struct About {
		std::array<uint8_t, 16> deviceUuid{}, driverUuid{};
		GlVersion version;
		int largest = 0, mostLayers = 0; ///< extent and array layers of a texture
	};
	static About aboutOf(const GlContext &context, const GlApi &gl, const std::optional<GlSharingApi> &sharing);

	const std::optional<GlSharingApi> sharing_;
	const About about_;
	const Instance &instance_;
};

/// The one for the binding in the chain of XrSessionCreateInfo; null where no enabled extension's binding is there.
/// Throws XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING or XR_ERROR_GRAPHICS_DEVICE_INVALID.
std::unique_ptr<Graphics> makeGlGraphics(Instance &instance, const void *next);

} // namespace arift::openxr
