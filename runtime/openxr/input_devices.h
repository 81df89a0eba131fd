// What is in a person's hands, and what it says at this moment.
#pragma once
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
	std::optional<Placed> place;         ///< of every pose that it says nothing else of
	std::map<XrPath, InputValue> values; ///< by source (/user/hand/left/input/select/click)

	const InputValue *find(XrPath source) const
	{
		const auto found = values.find(source);
		return found == values.end() ? nullptr : &found->second;
	}
};

/// By user path.
using InputDevices = std::map<XrPath, InputDevice>;

} // namespace arift::openxr
