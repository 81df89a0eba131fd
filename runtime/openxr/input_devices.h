// What is in a person's hands, and what it says at this moment.
#pragma once
#include "runtime/base/pose.h"
#include "runtime/openxr/space_kind.h"
#include <map>
#include <optional>

namespace arift::openxr
{

/// Of one component.
struct InputValue {
	XrVector2f vector{}; ///< x alone for numbers; 0 or 1 for what is pressed or not
	std::optional<Placed> place;
};

struct InputDevice {
	XrPath profile = XR_NULL_PATH;
	bool isActive = false;
	bool isPlayed = false;               ///< by the application itself (XR_EXT_conformance_automation), whatever the service has
	std::optional<Placed> place;         ///< of every pose that it says nothing else of
	std::map<XrPath, InputValue> values; ///< by source (/user/hand/left/input/select/click)

	const InputValue *find(XrPath source) const
	{
		const auto found = values.find(source);
		return found == values.end() ? nullptr : &found->second;
	}
};

/// What lies on the surface of a device that is held: turned against the grip as on usual controllers.
inline Placed onSurface(const Placed &grip)
{
	constexpr float sine = -0.3826834f, cosine = 0.9238795f; // 45 degrees about x, half
	return {grip.reference, grip.pose * XrPosef{{sine, 0, 0, cosine}, {0, 0, 0}}};
}

/// By user path.
using InputDevices = std::map<XrPath, InputDevice>;

} // namespace arift::openxr
