// An OpenXR application that shows two squares as they were seen from the left of where the eyes are: a green one, of which it says how far
// away it is, another distance for each eye, and a red one above it, of which it does not.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include <csignal>

namespace
{

using namespace arift::e2e;

volatile std::sig_atomic_t leave = 0;

constexpr std::array distances{0.4f, 1.0f}; ///< metres
constexpr float moved = 0.05f;              ///< metres
constexpr float nearZ = 0.1f, farZ = 10;

XrVector3f turned(const XrQuaternionf &q, const XrVector3f &v)
{
	const auto cross = [](const XrVector3f &a, const XrVector3f &b) {
		return XrVector3f{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
	};
	const XrVector3f axis{q.x, q.y, q.z}, once = cross(axis, v), twice = cross(axis, once);
	return {v.x + 2 * (q.w * once.x + twice.x), v.y + 2 * (q.w * once.y + twice.y), v.z + 2 * (q.w * once.z + twice.z)};
}

/// The depth of what is so far away, between nearZ at 0 and farZ at 1.
float depthOf(float distance) { return (1 / distance - 1 / nearZ) / (1 / farZ - 1 / nearZ); }

class DepthApplication final : public DrawingApplication
{
public:
	DepthApplication()
		: DrawingApplication("depth_application", {XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME}),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  green_(session_, {64, 64}, 1),
		  red_(session_, {64, 64}, 1),
		  depths_{DrawnImages(session_, {32, 16}, 1, VK_FORMAT_D32_SFLOAT), DrawnImages(session_, {32, 16}, 1, VK_FORMAT_D32_SFLOAT)},
		  pool_(vulkan_.device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = 1}),
		  drawn_(vulkan_.device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled})
	{
	}

private:
	void frame() override
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		draw();
		std::array<XrView, 2> views;
		locate(state.predictedDisplayTime, space_, views);
		for (XrView &view : views) {
			const XrVector3f left = turned(view.pose.orientation, {-moved, 0, 0});
			view.pose.position = {view.pose.position.x + left.x, view.pose.position.y + left.y, view.pose.position.z + left.z};
		}
		const Squares green(space_, views, green_.all(), -0.1f, {depths_[0].all(), depths_[1].all()}), red(space_, views, red_.all(), 0.1f);
		endFrame(state.predictedDisplayTime, {green.header(), red.header()});
	}
	void draw()
	{
		if (vulkan_.device.waitForFences(*drawn_, true, UINT64_MAX) != vk::Result::eSuccess)
			throw std::runtime_error("the application's own work does not end");
		vulkan_.device.resetFences(*drawn_);
		const vk::raii::CommandBuffer &commands = commands_[0];
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		recordFill(commands, green_[green_.acquire()], green_.format, {0, 1, 0, 1});
		recordFill(commands, red_[red_.acquire()], red_.format, {1, 0, 0, 1});
		for (size_t eye = 0; eye < 2; ++eye)
			recordFill(commands, depths_[eye][depths_[eye].acquire()], depths_[eye].format, {depthOf(distances[eye]), 0, 0, 0});
		commands.end();
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands}, *drawn_);
		for (const DrawnImages *images : {&green_, &red_, &depths_[0], &depths_[1]}) images->release();
	}

	/// A projection layer whose views see a tenth of a radian each way, so far up.
	class Squares
	{
	public:
		Squares(XrSpace space, const std::array<XrView, 2> &views, const XrSwapchainSubImage &image, float up,
				const std::vector<XrSwapchainSubImage> &depths = {})
		{
			for (size_t eye = 0; eye < 2; ++eye) {
				views_[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
				views_[eye].pose = views[eye].pose;
				views_[eye].fov = {-0.05f, 0.05f, up + 0.05f, up - 0.05f};
				views_[eye].subImage = image;
				if (depths.empty()) continue;
				depths_[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, depths[eye], 0, 1, nearZ, farZ};
				views_[eye].next = &depths_[eye];
			}
			layer_.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
			layer_.space = space;
			layer_.viewCount = uint32_t(views_.size());
			layer_.views = views_.data();
		}
		Squares(const Squares &) = delete;
		const XrCompositionLayerBaseHeader *header() const { return reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer_); }

	private:
		std::array<XrCompositionLayerDepthInfoKHR, 2> depths_;
		std::array<XrCompositionLayerProjectionView, 2> views_;
		XrCompositionLayerProjection layer_{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
	};

	const Space space_;
	const DrawnImages green_, red_;
	const std::array<DrawnImages, 2> depths_;
	const vk::raii::CommandPool pool_;
	const vk::raii::CommandBuffers commands_;
	const vk::raii::Fence drawn_;
};

} // namespace

int main()
{
	std::signal(SIGTERM, [](int) { leave = 1; });
	return runApplication("depth_application", [] { DepthApplication().run(leave); });
}
