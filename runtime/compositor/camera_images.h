// Camera images on the GPU, in the form in which the shader samples them.
#pragma once
#include "runtime/compositor/camera_sites.h"
#include "runtime/compositor/panel_optics.h"
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

/// Each eye's newest camera image: a texture of sites (camera_sites.h), so no pass over the whole image is needed.
class CameraImages
{
public:
	/// With a dark image of the usual form for every camera of the Rig.
	CameraImages(gpu::Device::Handles &gpu, const PanelOptics &optics);

	/// Packs an image that is not the one this eye has already and records its copy; says whether the eye's texture is another than before.
	/// The frame is not needed any more afterwards.
	bool upload(const vk::raii::CommandBuffer &commands, size_t eye, const CameraFrame &frame);
	vk::ImageView sites(size_t eye) const { return eyes_[eye].sites ? *eyes_[eye].sites->view : *nothing_.view; }

private:
	struct Eye {
		SiteImage layout;
		std::optional<Texture> sites;
		std::optional<gpu::Buffer> staging;
		// The image the texture has: its buffer (to compare, not to use), its number and its time.
		const void *shownBuffer = nullptr;
		uint64_t shownSequence = 0;
		XrTime shownExposure = 0;
	};
	void makeTexture(Eye &eye, const SiteImage &layout);

	gpu::Device::Handles &gpu_;
	Texture nothing_; ///< bound where there is no image
	std::array<Eye, 2> eyes_;
};

/// The camera's table of G over the angle; one texel where the Rig needs none.
Texture makeAngleTable(gpu::Device::Handles &gpu, const PanelOptics &optics, size_t camera);

} // namespace arift
