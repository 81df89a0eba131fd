// A composition's images in swapchains of their own, painted once: what was released once stays what is shown.
#pragma once
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include "tests/e2e/composition/compositions.h"

namespace arift::e2e
{

class PaintedImages
{
public:
	PaintedImages(const Vulkan &vulkan, const vk::raii::Queue &queue, XrSession session, const Image &image);
	XrSwapchain handle() const { return swapchain_; }
	XrSwapchainSubImage subImage(const Part &part) const;

private:
	void paint(const Vulkan &vulkan, const vk::raii::Queue &queue, VkImage target) const;

	const Image image_;
	Swapchain swapchain_;
};

} // namespace arift::e2e
