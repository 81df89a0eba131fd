// XR_KHR_binding_modification: what else an application wants of the bindings it suggests.
#pragma once
#include "runtime/openxr/ext/ext_dpad_binding.h"
#include "runtime/openxr/instance.h"
#include <vector>

namespace arift::openxr
{

struct InteractionProfile;

/// The directional pads that an application wants otherwise than they come.
struct DpadModification {
	XrPath pad; ///< /user/hand/left/input/thumbstick
	const ActionSetCore *set;
	DpadSettings settings;
};

/// All modifications in the chain of XrInteractionProfileSuggestedBinding. Throws XR_ERROR_PATH_UNSUPPORTED or XR_ERROR_VALIDATION_FAILURE.
std::vector<DpadModification> modificationsIn(const Instance &instance, const InteractionProfile &profile, const void *next);

} // namespace arift::openxr
