// The Vulkan behind the hologram: draws one cube into the images that the runtime hands out. It knows nothing of OpenXR.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

class CubeRenderer
{
public:
	/// Physical device and device must outlive the renderer. Throws vk::Error where Vulkan fails, as every function here.
	CubeRenderer(const vk::raii::PhysicalDevice &physicalDevice, const vk::raii::Device &device, uint32_t queueFamily, vk::Format format);
	/// Waits until the GPU has finished.
	~CubeRenderer();

	/// Images of one view, which draw() takes by index. They arrive and leave in COLOR_ATTACHMENT_OPTIMAL. Views are numbered from 0.
	void addView(const std::vector<VkImage> &images, vk::Extent2D size);

	struct View {
		uint32_t image = 0;        ///< index among the view's images
		glm::mat4 clipFromRoom{1}; ///< Vulkan's clip space: y down, depth 0 to 1
	};
	/// Draws the cube on transparent black into one image of every view, and submits. Waits only for its own frame before.
	void draw(const std::vector<View> &views, const glm::mat4 &roomFromCube);

private:
	struct Target {
		vk::raii::ImageView colour;
		vk::raii::Framebuffer framebuffer;
	};
	struct ViewImages {
		vk::Extent2D size;
		vk::raii::DeviceMemory depthMemory;
		vk::raii::Image depth;
		vk::raii::ImageView depthView;
		std::vector<Target> targets;
	};
	vk::raii::ImageView makeImageView(VkImage image, vk::Format format, vk::ImageAspectFlags aspect) const;

	const vk::raii::PhysicalDevice &physicalDevice_;
	const vk::raii::Device &device_;
	vk::Format format_;
	vk::raii::Queue queue_;
	vk::raii::RenderPass renderPass_;
	vk::raii::PipelineLayout layout_;
	vk::raii::Pipeline pipeline_;
	vk::raii::CommandPool pool_;
	vk::raii::CommandBuffer commands_;
	vk::raii::Fence finished_;
	std::vector<ViewImages> views_;
};
