// A hologram application for measurements: blue discs at fixed places of LOCAL space, as any OpenXR application would draw them. It is told
// their places once, on its command line, and knows nothing of the runtime but OpenXR.
#include "tests/e2e/common/drawing_application.h" // first: with OpenXR's functions

#include "marker_painter.h"
#include <charconv>
#include <csignal>
#include <span>

namespace
{

volatile std::sig_atomic_t leave = 0;

struct Options {
	std::vector<XrVector3f> places; ///< metres, in LOCAL space
	float radius = 0.02f;           ///< metres
};

float number(std::span<char *> arguments, size_t index)
{
	float value = 0;
	if (index >= arguments.size()) throw std::invalid_argument("a number is missing at the end of the command line");
	const std::string_view text = arguments[index];
	const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
	if (error != std::errc{} || end != text.data() + text.size()) throw std::invalid_argument(std::string(text) + " is no number");
	return value;
}

Options read(std::span<char *> arguments)
{
	Options options;
	for (size_t i = 1; i < arguments.size();) {
		const std::string_view name = arguments[i];
		if (name == "--position") {
			options.places.push_back({number(arguments, i + 1), number(arguments, i + 2), number(arguments, i + 3)});
			i += 4;
		} else if (name == "--radius") {
			options.radius = number(arguments, i + 1);
			i += 2;
		} else {
			throw std::invalid_argument(std::string(name) + " is unknown; usage: pinned_marker --position X Y Z ... [--radius METRES]");
		}
	}
	if (options.places.empty()) throw std::invalid_argument("usage: pinned_marker --position X Y Z ... [--radius METRES]");
	return options;
}

XrVector3f turned(const XrQuaternionf &q, const XrVector3f &v)
{
	const auto cross = [](const XrVector3f &a, const XrVector3f &b) {
		return XrVector3f{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
	};
	const XrVector3f axis{q.x, q.y, q.z}, once = cross(axis, v), twice = cross(axis, once);
	return {v.x + 2 * (q.w * once.x + twice.x), v.y + 2 * (q.w * once.y + twice.y), v.z + 2 * (q.w * once.z + twice.z)};
}

XrVector3f inView(const XrPosef &view, const XrVector3f &point)
{
	const XrQuaternionf back{-view.orientation.x, -view.orientation.y, -view.orientation.z, view.orientation.w};
	return turned(back, {point.x - view.position.x, point.y - view.position.y, point.z - view.position.z});
}

using namespace arift::e2e;

class PinnedMarker final : public DrawingApplication
{
public:
	explicit PinnedMarker(const Options &options)
		: DrawingApplication("pinned_marker"),
		  options_(options),
		  local_(createSpace(XR_REFERENCE_SPACE_TYPE_LOCAL)),
		  size_(viewSize()),
		  format_(chooseFormat()),
		  left_(session_, size_, 1, format_),
		  right_(session_, size_, 1, format_),
		  painter_(vulkan_, vk::Format(format_), {size_.width, size_.height})
	{
	}

private:
	VkExtent2D viewSize() const
	{
		const auto views = enumerate("xrEnumerateViewConfigurationViews", XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW},
									 [&](uint32_t capacity, uint32_t *count, XrViewConfigurationView *list) {
										 return xrEnumerateViewConfigurationViews(
											 instance_, system_, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, capacity, count, list);
									 });
		return {views.at(0).recommendedImageRectWidth, views.at(0).recommendedImageRectHeight};
	}
	VkFormat chooseFormat() const
	{
		for (const int64_t format : formats())
			if (format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB) return VkFormat(format);
		throw std::runtime_error("the runtime offers no 8-bit sRGB format");
	}

	void frame() override
	{
		XrFrameState state{XR_TYPE_FRAME_STATE};
		check(xrWaitFrame(session_, nullptr, &state), "xrWaitFrame");
		check(xrBeginFrame(session_, nullptr), "xrBeginFrame");
		std::array<XrView, 2> views;
		if (!state.shouldRender || !locate(state.predictedDisplayTime, local_, views)) return endFrame(state.predictedDisplayTime, {});
		drawEye(left_, views[0]);
		drawEye(right_, views[1]);
		const ProjectionLayer layer(local_, views, {left_.all(), right_.all()});
		endFrame(state.predictedDisplayTime, {layer.header()});
	}
	void drawEye(const DrawnImages &images, const XrView &view)
	{
		std::vector<Disc> discs;
		for (const XrVector3f &place : options_.places) discs.push_back({inView(view.pose, place), options_.radius});
		painter_.paint(images[images.acquire()], view.fov, discs);
		images.release();
	}

	const Options options_;
	const Space local_;
	const VkExtent2D size_;
	const VkFormat format_;
	const DrawnImages left_, right_;
	MarkerPainter painter_;
};

} // namespace

int main(int count, char **arguments)
{
	return runApplication("pinned_marker", [&] {
		const Options options = read({arguments, size_t(count)});
		std::signal(SIGTERM, [](int) { leave = 1; });
		std::signal(SIGINT, [](int) { leave = 1; });
		PinnedMarker(options).run(leave);
	});
}
