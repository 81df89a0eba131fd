// The interaction profiles of OpenXR's core and of the extensions offered: which inputs and outputs each device has. OpenXR 1.1,
// "Interaction Profile Paths".
#pragma once
#include "runtime/openxr/extensions.h"
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arift::openxr
{

/// The version whose core has a profile.
enum class Since { version1_0, version1_1, never };

struct InteractionProfile {
	std::string_view name;  ///< after "/interaction_profiles/"
	std::string_view title; ///< for people
	Since since;
	Extension extension; ///< that brings it where the version does not; count: none
	std::span<const std::string_view> userPaths;
	/// Blank-separated, each with its type behind a colon (b boolean, f float, v vector, p pose, h haptic): "trigger/value:f" below
	/// /input/,
	/// "/output/haptic:h" as it stands; "L:" or "R:" before what only that hand has, "1.1:" and "fb:" before what needs OpenXR 1.1 or
	/// XR_FB_touch_controller_proximity.
	std::string_view components;
};

/// In the order of the specification.
std::span<const InteractionProfile> interactionProfiles();

/// Nothing for a path that names no profile of this version and these extensions.
const InteractionProfile *findInteractionProfile(std::string_view path, const Features &features);

/// One input or output of a device.
struct Component {
	std::string path; ///< behind the user path: "/input/trigger/value"
	XrActionType type;
};

/// All that a profile has below one of its user paths, with what extensions add to every device of its kind.
std::vector<Component> componentsOf(const InteractionProfile &profile, std::string_view userPath, const Features &features);

/// A full path such as /user/hand/left/input/trigger/value.
struct SourcePath {
	std::string_view user; ///< /user/hand/left
	std::string_view rest; ///< /input/trigger/value
};
/// Nothing for a path that begins with none of the profile's user paths.
std::optional<SourcePath> splitSource(const InteractionProfile &profile, std::string_view path);

/// The component that a suggested path means for an action of this type: the one it names or, where it names the parent of several, the one
/// that suits best. Nothing where the profile has no such path. OpenXR 1.1, "Input Source Paths".
std::optional<Component> resolveSource(const InteractionProfile &profile, std::string_view path, XrActionType type,
									   const Features &features);

/// /user/hand/left and the other paths that stand for a person's devices. OpenXR 1.1, "Reserved Paths".
bool isTopLevelUserPath(std::string_view path, const Features &features);

} // namespace arift::openxr
