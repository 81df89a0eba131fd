// Camera images on the GPU: memory that drivers fill, and the textures they are copied to without passing the CPU again.
#pragma once
#include "runtime/compositor/panel_optics.h"
#include "runtime/device/camera.h"
#include "runtime/gpu/handles.h"

namespace arift
{

/// A 2D image for sampling with its view. Its layout is SHADER_READ_ONLY_OPTIMAL between uses.
struct Texture {
	Texture(const gpu::Device::Handles &gpu, vk::Format format, uint32_t width, uint32_t height);
	gpu::Image image;
	vk::raii::ImageView view;
	uint32_t width, height;
};

/// Each eye's newest camera image. Grey ones are one texture; Bayer ones two of half the width and height with two channels: the even and
/// the odd lines of the sensor, whose neighbouring pixels are the channels. So each colour is sampled from its own lattice, and no pass is
/// needed.
class CameraImages
{
public:
	explicit CameraImages(gpu::Device::Handles &gpu);

	/// Buffers whose bytes are copied from directly. They must be gone before the device is; thread-safe.
	static FrameAllocator allocator(gpu::Device::Handles &gpu);

	/// Records the copy of an image that is not the one this eye has already; says whether the eye's textures are others than before.
	/// The frame's buffer must live until the commands have finished.
	bool upload(const vk::raii::CommandBuffer &commands, size_t eye, const CameraFrame &frame);
	/// The textures to bind: of a Bayer image first the lines that hold red, then those that hold blue.
	std::array<vk::ImageView, 2> planes(size_t eye) const;
	/// A texture of one dark texel, for bindings that are not used.
	vk::ImageView nothing() const { return *nothing_.view; }

private:
	struct Eye {
		PixelFormat format{};
		uint32_t width = 0, height = 0;
		std::vector<Texture> planes;
		std::optional<gpu::Buffer> staging; ///< for frames that lie in memory of somebody else
		const FrameBuffer *shownBuffer = nullptr;
		uint64_t shownSequence = 0;
		XrTime shownExposure = 0;
	};
	void makePlanes(Eye &eye, const CameraFrame &frame);
	vk::Buffer source(Eye &eye, const CameraFrame &frame, uint32_t &stride);

	gpu::Device::Handles &gpu_;
	Texture nothing_;
	std::array<Eye, 2> eyes_;
};

/// The radial tables of the cameras whose polynomials do not do (PanelOptics::cameraCoefficients == 0), else of one texel.
Texture makeAngleTable(gpu::Device::Handles &gpu, const PanelOptics &optics, size_t camera);

} // namespace arift
