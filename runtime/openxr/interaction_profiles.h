// The interaction profiles of OpenXR's core: which inputs and outputs each device has. OpenXR 1.1, "Interaction Profile Paths".
#pragma once
#include <optional>
#include <span>
#include <string_view>

namespace arift::openxr
{

struct InteractionProfile {
	std::string_view name; ///< after "/interaction_profiles/"
	bool since1_1;         ///< only instances of OpenXR 1.1 have it in their core
	std::span<const std::string_view> userPaths;
	/// Blank-separated: "trigger/value" below /input/, "/output/haptic" as it stands, "L:" or "R:" before what only that hand has.
	std::string_view components;

	/// Whether `path` (a full path such as /user/hand/left/input/trigger/value) names one of its components or the parent of one.
	bool has(std::string_view path, bool is1_1) const;
};

/// Nothing for a path that names no profile of this version.
const InteractionProfile *findInteractionProfile(std::string_view path, bool is1_1);

/// /user/hand/left and the other paths that stand for a person's devices. OpenXR 1.1, "Reserved Paths".
bool isTopLevelUserPath(std::string_view path);

} // namespace arift::openxr
