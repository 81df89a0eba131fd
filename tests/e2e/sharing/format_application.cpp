// An OpenXR application that shows every colour format that the runtime offers, side by side over a translucent view, and draws depth in
// every depth format. For its first frames it shows other colours.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include <csignal>
#include <optional>

namespace
{

using namespace arift::e2e;

volatile std::sig_atomic_t leave = 0;

constexpr int firstFrames = 20;
using Colour = std::array<float, 4>;

class FormatApplication final : public DrawingApplication
{
public:
	FormatApplication()
		: DrawingApplication("format_application"),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  head_(createSpace(XR_REFERENCE_SPACE_TYPE_VIEW)),
		  views_(session_, {480, 600}, 2),
		  pool_(vulkan_.device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = 1}),
		  drawn_(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled})
	{
		for (const int64_t format : formats())
			each_.push_back(std::make_unique<DrawnImages>(session_, VkExtent2D{67, 45}, 1, VkFormat(format)));
	}

private:
	void frame() override
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		const bool first = frame_++ < firstFrames;
		draw(first ? Colour{0, 0.3f, 0, 0.9f} : Colour{0.05f, 0.1f, 0.2f, 0.5f},
			 first ? Colour{0, 0, 0.5f, 1} : Colour{0.5f, 0.25f, 0.1f, 1});
		show(state.predictedDisplayTime);
	}
	void draw(const Colour &view, const Colour &quad)
	{
		if (vulkan_.device.waitForFences(*drawn_, true, UINT64_MAX) != vk::Result::eSuccess)
			throw std::runtime_error("the application's own work does not end");
		vulkan_.device.resetFences(*drawn_);
		const vk::raii::CommandBuffer &commands = commands_[0];
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		recordFill(commands, views_[views_.acquire()], views_.format, view);
		for (const auto &images : each_) recordFill(commands, (*images)[images->acquire()], images->format, quad);
		commands.end();
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands}, *drawn_);
		views_.release();
		for (const auto &images : each_) images->release();
	}
	void show(XrTime displayTime) const
	{
		std::array<XrView, 2> located;
		locate(displayTime, space_, located);
		const ProjectionLayer projection(space_, located, {views_.all(0), views_.all(1)});
		std::vector<const XrCompositionLayerBaseHeader *> layers{projection.header()};
		std::array<XrCompositionLayerQuad, 9> quads;
		for (const auto &images : each_) {
			if (isDepth(images->format)) continue;
			const size_t i = layers.size() - 1;
			quads[i] = {XR_TYPE_COMPOSITION_LAYER_QUAD};
			quads[i].space = head_;
			quads[i].subImage = images->all();
			quads[i].pose = {{0, 0, 0, 1}, {0.22f * (float(i % 3) - 1), 0.22f * (1 - float(i / 3)), -1}};
			quads[i].size = {0.2f, 0.2f};
			layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader *>(&quads[i]));
		}
		endFrame(displayTime, layers);
	}

	const Space space_, head_;
	const DrawnImages views_;
	std::vector<std::unique_ptr<DrawnImages>> each_;
	const vk::raii::CommandPool pool_;
	const vk::raii::CommandBuffers commands_;
	const vk::raii::Fence drawn_;
	int frame_ = 0;
};

} // namespace

int main()
{
	std::signal(SIGTERM, [](int) { leave = 1; });
	return runApplication("format_application", [] { FormatApplication().run(leave); });
}
