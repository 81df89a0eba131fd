// Draws discs into the images of an OpenXR swapchain with Vulkan.
#pragma once
#include "samples/hologram_cube/vulkan_for_xr.h"
#include <map>
#include <span>

struct Disc {
	XrVector3f centre; ///< metres, in the frame of the view (x right, y up, z backwards)
	float radius;
};

/// Thread-bound.
class MarkerPainter
{
public:
	MarkerPainter(const Vulkan &vulkan, vk::Format format, vk::Extent2D extent);
	~MarkerPainter();

	vk::Queue queue() const { return *queue_; }
	/// Clears `image` to transparent black, draws the discs and submits; the caller may hand the image over at once.
	void paint(VkImage image, const XrFovf &fov, std::span<const Disc> discs);

private:
	struct Target {
		vk::raii::ImageView view;
		vk::raii::Framebuffer framebuffer;
		vk::raii::CommandBuffer commands;
		vk::raii::Fence drawn;
	};
	Target &target(VkImage image);
	void record(const Target &target, const XrFovf &fov, std::span<const Disc> discs) const;

	const vk::raii::Device &device_;
	vk::Format format_;
	vk::Extent2D extent_;
	vk::raii::Queue queue_;
	vk::raii::CommandPool pool_;
	vk::raii::RenderPass pass_;
	vk::raii::PipelineLayout layout_;
	vk::raii::Pipeline pipeline_;
	std::map<VkImage, Target> targets_;
};
