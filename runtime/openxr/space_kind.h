// What a space hangs on.
#pragma once
#include "runtime/openxr/api.h"

namespace arift::openxr
{

/// A reference space, or an action's device.
enum class SpaceKind { view, local, localFloor, stage, unbounded, action };

/// Somewhere in a reference space.
struct Placed {
	SpaceKind reference = SpaceKind::local;
	XrPosef pose{};
};

} // namespace arift::openxr
