// Where finished panel images go.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/compositor/pacer.h"
#include <memory>
#include <string>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace arift
{

namespace gpu
{
class Device;
}

/// What became of an image. `closed` is how a person ends the program, no error; `gone`: nothing can be shown there any more.
enum class Presented { shown, closed, gone };

/// Thread-bound to the compositor's thread.
class Target
{
public:
	virtual ~Target() = default;
	struct Result {
		Presented outcome = Presented::shown;
		XrTime display = 0;   ///< when the image's middle line is seen, as well as the target knows
		uint32_t rawKeys = 0; ///< presses of the key that asks for raw passthrough, and for holograms again
	};
	/// Shows `image` (layout TRANSFER_SRC_OPTIMAL before and after, finished) at the refresh planned, or as soon as it can after that.
	/// May sleep until the image has been taken, but no longer than a few refreshes. Throws std::runtime_error when the GPU is lost.
	virtual Result present(VkImage image, VkExtent2D extent, const Pacer::Refresh &refresh) = 0;
	/// For people: "offscreen", "window 1280x800".
	virtual std::string name() const = 0;
};

/// Nobody watches: an image finished in time is seen when it was planned, one that is late at the next line of the grid.
std::unique_ptr<Target> makeOffscreenTarget(const Clock &clock, XrDuration period);

/// Instance extensions the device needs for a window; empty where there is no X display.
std::vector<const char *> windowExtensions();
/// A window on the X display that DISPLAY names, as large as the panel and free to be resized or closed.
/// Throws std::runtime_error with the reason where there can be none. The device must have been made with windowExtensions().
std::unique_ptr<Target> makeWindowTarget(gpu::Device &device, Clock &clock, const Pacer::Settings &pacing, VkExtent2D size);

} // namespace arift
