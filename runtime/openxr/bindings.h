// What applications suggest to bind their actions to, as the interaction profiles understand it. OpenXR 1.1, "Suggested Bindings".
#pragma once
#include "runtime/openxr/actions.h"
#include "runtime/openxr/ext/ext_dpad_binding.h"
#include <map>
#include <vector>

namespace arift::openxr
{

/// How the value of a binding is found in what a device says.
enum class SourcePart {
	whole,
	x, ///< of the vector that is the source's parent
	y,
	dpad ///< of the pad that is the source's parent
};

/// One action bound to one component of one profile.
struct Binding {
	std::shared_ptr<const ActionCore> action;
	XrPath profile = XR_NULL_PATH;
	XrPath user = XR_NULL_PATH;                       ///< /user/hand/left
	XrPath identifier = XR_NULL_PATH;                 ///< /user/hand/left/input/trackpad: what action sets compete for
	XrPath source = XR_NULL_PATH;                     ///< /user/hand/left/input/trackpad/x
	XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT; ///< of the source
	SourcePart part = SourcePart::whole;
	DpadRegions direction = 0; ///< dpad
	DpadSettings dpad;
	XrPath press = XR_NULL_PATH; ///< dpad: what says how hard the pad is pressed; none: it need not be
};

/// By interaction profile: what was suggested for it last.
using Suggestions = std::map<XrPath, std::vector<Binding>>;

} // namespace arift::openxr
