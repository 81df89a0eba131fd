// What every application of these tests has in common: an instance, a session that draws with Vulkan, and a loop of events and frames. Each
// is a program of its own, with no header of the runtime's.
#pragma once
#include "samples/hologram_cube/vulkan_for_xr.h" // first: with OpenXR's functions

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace arift::e2e
{

bool isDepth(VkFormat format);

/// A swapchain of 8-bit sRGB images, or of another format, with their images.
class DrawnImages
{
public:
	DrawnImages(XrSession session, VkExtent2D size, uint32_t arrayLayers, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB);
	/// The index of the next image, once it is free.
	uint32_t acquire() const;
	void release() const;
	VkImage operator[](size_t index) const { return images_[index].image; }
	size_t count() const { return images_.size(); }
	/// All of one array layer.
	XrSwapchainSubImage all(uint32_t arrayLayer = 0) const;
	XrSwapchain handle() const { return swapchain_; }

	const VkExtent2D size;
	const VkFormat format;

private:
	Swapchain swapchain_;
	std::vector<XrSwapchainImageVulkan2KHR> images_;
};

/// Fills an image, from the layout in which the runtime hands it over and back to it, `times` times over. Between begin and end. Depth
/// images are filled with the colour's first number.
void recordFill(const vk::raii::CommandBuffer &commands, VkImage image, VkFormat format, const std::array<float, 4> &colour, int times = 1);

class DrawingApplication
{
public:
	/// `extensions`: beside the one for Vulkan.
	explicit DrawingApplication(const std::string &name, std::vector<const char *> extensions = {});
	virtual ~DrawingApplication() = default;
	DrawingApplication(const DrawingApplication &) = delete;

	/// Frame after frame while the session runs, until the runtime ends it, or `leave` is set and the runtime has let it go.
	void run(const volatile int &leave);

protected:
	/// One xrWaitFrame, xrBeginFrame and xrEndFrame.
	virtual void frame() = 0;

	Space createSpace(XrReferenceSpaceType type) const;
	std::vector<int64_t> formats() const;
	/// Both eyes' views in `space`; says whether they are where they are said to be.
	bool locate(XrTime time, XrSpace space, std::array<XrView, 2> &views) const;
	void endFrame(XrTime time, const std::vector<const XrCompositionLayerBaseHeader *> &layers,
				  XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND) const;

	const Instance instance_;
	const XrSystemId system_;
	const Vulkan vulkan_;
	const Session session_;
	const vk::raii::Queue queue_;

private:
	void handleEvents(bool leave);
	void follow(XrSessionState state);

	enum class Life { waiting, running, leaving, over } life_ = Life::waiting;
};

/// A projection layer of both eyes, whose images lie in `images`: one array layer each, or one image for both.
class ProjectionLayer
{
public:
	ProjectionLayer(XrSpace space, const std::array<XrView, 2> &views, const std::array<XrSwapchainSubImage, 2> &images,
					XrCompositionLayerFlags flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT);
	ProjectionLayer(const ProjectionLayer &) = delete;
	const XrCompositionLayerBaseHeader *header() const { return reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer_); }

private:
	std::array<XrCompositionLayerProjectionView, 2> views_;
	XrCompositionLayerProjection layer_{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
};

/// `main` of such a program: says what went wrong and returns 1 where something did.
template <typename Run> int runApplication(const char *name, Run run)
{
	try {
		run();
		return 0;
	} catch (const std::exception &problem) {
		std::fprintf(stderr, "%s: %s\n", name, problem.what());
		return 1;
	}
}

} // namespace arift::e2e
