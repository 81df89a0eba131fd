// An OpenXR application that fills its views with one colour and says OPAQUE:
//    passthrough_application RED GREEN BLUE ALPHA [layer]
// Numbers are linear, 0..1. layer: the cameras' image below its own, by XR_FB_passthrough; SIGUSR1 pauses or resumes it.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include <csignal>
#include <cstdlib>
#include <string_view>

namespace
{

using namespace arift::e2e;

volatile std::sig_atomic_t toggles = 0;

/// One passthrough layer with its feature.
class CameraLayer
{
public:
	CameraLayer(XrInstance instance, XrSession session) : instance_(instance)
	{
		const XrPassthroughCreateInfoFB feature{XR_TYPE_PASSTHROUGH_CREATE_INFO_FB, nullptr, XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB};
		check(get<PFN_xrCreatePassthroughFB>("xrCreatePassthroughFB")(session, &feature, &passthrough_), "xrCreatePassthroughFB");
		const XrPassthroughLayerCreateInfoFB layer{XR_TYPE_PASSTHROUGH_LAYER_CREATE_INFO_FB, nullptr, passthrough_,
												   XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB,
												   XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB};
		check(get<PFN_xrCreatePassthroughLayerFB>("xrCreatePassthroughLayerFB")(session, &layer, &layer_.layerHandle),
			  "xrCreatePassthroughLayerFB");
	}
	CameraLayer(const CameraLayer &) = delete;

	void run(bool running) const
	{
		if (running)
			check(get<PFN_xrPassthroughStartFB>("xrPassthroughStartFB")(passthrough_), "xrPassthroughStartFB");
		else
			check(get<PFN_xrPassthroughPauseFB>("xrPassthroughPauseFB")(passthrough_), "xrPassthroughPauseFB");
	}
	const XrCompositionLayerBaseHeader *header() const { return reinterpret_cast<const XrCompositionLayerBaseHeader *>(&layer_); }

private:
	template <typename Pfn> Pfn get(const char *name) const
	{
		PFN_xrVoidFunction function = nullptr;
		check(xrGetInstanceProcAddr(instance_, name, &function), name);
		return reinterpret_cast<Pfn>(function);
	}

	const XrInstance instance_;
	XrPassthroughFB passthrough_ = XR_NULL_HANDLE;
	XrCompositionLayerPassthroughFB layer_{XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB};
};

class PassthroughApplication final : public DrawingApplication
{
public:
	PassthroughApplication(const std::array<float, 4> &colour, bool withLayer)
		: DrawingApplication("passthrough_application",
							 withLayer ? std::vector<const char *>{XR_FB_PASSTHROUGH_EXTENSION_NAME} : std::vector<const char *>{}),
		  colour_(colour),
		  space_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  images_(session_, {64, 64}, 1),
		  pool_(vulkan_.device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = vulkan_.queueFamily}),
		  commands_(vulkan_.device, {.commandPool = *pool_, .commandBufferCount = 1})
	{
		if (withLayer) cameras_ = std::make_unique<CameraLayer>(instance_, session_);
	}

private:
	void frame() override
	{
		if (cameras_ && toggled_ != toggles) cameras_->run(++toggled_ % 2 == 0);
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		const VkImage image = images_[images_.acquire()];
		const vk::raii::CommandBuffer &commands = commands_.front();
		commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
		recordFill(commands, image, images_.format, colour_);
		commands.end();
		queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands});
		queue_.waitIdle();
		images_.release();
		std::array<XrView, 2> views;
		locate(state.predictedDisplayTime, space_, views);
		const ProjectionLayer projection(space_, views, {images_.all(), images_.all()},
										 cameras_ ? XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT : 0);
		std::vector<const XrCompositionLayerBaseHeader *> layers;
		if (cameras_) layers.push_back(cameras_->header());
		layers.push_back(projection.header());
		endFrame(state.predictedDisplayTime, layers, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
	}

	const std::array<float, 4> colour_;
	const Space space_;
	const DrawnImages images_;
	const vk::raii::CommandPool pool_;
	const vk::raii::CommandBuffers commands_;
	std::unique_ptr<CameraLayer> cameras_;
	int toggled_ = 0;
};

} // namespace

int main(int count, char **arguments)
{
	if (count < 5 || count > 6 || (count == 6 && std::string_view(arguments[5]) != "layer")) {
		std::fprintf(stderr, "usage: passthrough_application RED GREEN BLUE ALPHA [layer]\n");
		return 2;
	}
	std::signal(SIGUSR1, [](int) { toggles = toggles + 1; });
	std::array<float, 4> colour;
	for (size_t i = 0; i < colour.size(); ++i) colour[i] = float(std::atof(arguments[i + 1]));
	constexpr int never = 0;
	return runApplication("passthrough_application", [&] { PassthroughApplication(colour, count == 6).run(never); });
}
