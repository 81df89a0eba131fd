// XR_EXT_dpad_binding: a thumbstick or trackpad as a directional pad.
#pragma once
#include "runtime/openxr/error.h"
#include <cstdint>
#include <string_view>

namespace arift::openxr
{

/// What an application may choose, with this runtime's defaults.
struct DpadSettings {
	float forceThreshold = 0.5f;         ///< force at which the pad is pressed, 0 to 1
	float forceThresholdReleased = 0.4f; ///< and below which it is released
	float centerRegion = 0.5f;           ///< radius in which no direction is meant
	float wedgeAngle = 1.5708f;          ///< radians: width of each direction
	bool isSticky = false;               ///< the first direction stands until the pad is released
};
/// Throws XR_ERROR_VALIDATION_FAILURE for numbers out of the specification's ranges.
DpadSettings settingsOf(const XrInteractionProfileDpadBindingEXT &modification);

/// Directions, one bit each: with wide wedges two are meant at once.
using DpadRegions = uint32_t;
constexpr DpadRegions dpadUp = 1, dpadDown = 2, dpadLeft = 4, dpadRight = 8, dpadCenter = 16;
/// The bit for the last component of a path, such as "dpad_up"; 0 for none.
DpadRegions dpadRegionNamed(std::string_view component);

/// How a pad is pressed.
struct DpadPress {
	bool isNeeded = false; ///< a thumbstick is not pressed: leaning it is enough
	float force = 0;       ///< 0 to 1
};

/// One pad from one synchronization to the next. Pure.
class Dpad
{
public:
	/// What is pressed now.
	DpadRegions update(const DpadSettings &settings, XrVector2f position, DpadPress press);

private:
	bool isPressed_ = false;
	DpadRegions latched_ = 0;
};

} // namespace arift::openxr
