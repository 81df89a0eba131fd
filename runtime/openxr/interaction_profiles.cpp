#include "runtime/openxr/interaction_profiles.h"
#include <algorithm>
#include <array>

namespace arift::openxr
{
namespace
{

using namespace std::literals;

constexpr std::array handPaths{"/user/hand/left"sv, "/user/hand/right"sv};
constexpr std::array headPaths{"/user/head"sv};
constexpr std::array gamepadPaths{"/user/gamepad"sv};
constexpr std::span<const std::string_view> hands(handPaths), head(headPaths), gamepad(gamepadPaths);

constexpr InteractionProfile profiles[] = {
	{"khr/simple_controller", false, hands, "select/click menu/click grip/pose aim/pose /output/haptic"},
	{"google/daydream_controller", false, hands,
	 "select/click trackpad trackpad/x trackpad/y trackpad/click trackpad/touch grip/pose aim/pose"},
	{"htc/vive_controller", false, hands,
	 "system/click squeeze/click menu/click trigger/click trigger/value trackpad trackpad/x trackpad/y "
	 "trackpad/click trackpad/touch grip/pose aim/pose /output/haptic"},
	{"htc/vive_pro", false, head, "system/click volume_up/click volume_down/click mute_mic/click"},
	{"microsoft/motion_controller", false, hands,
	 "menu/click squeeze/click trigger/value thumbstick thumbstick/x thumbstick/y thumbstick/click trackpad "
	 "trackpad/x trackpad/y trackpad/click trackpad/touch grip/pose aim/pose /output/haptic"},
	{"microsoft/xbox_controller", false, gamepad,
	 "menu/click view/click a/click b/click x/click y/click dpad_down/click dpad_right/click dpad_up/click "
	 "dpad_left/click shoulder_left/click shoulder_right/click thumbstick_left/click thumbstick_right/click "
	 "trigger_left/value trigger_right/value thumbstick_left thumbstick_left/x thumbstick_left/y thumbstick_right "
	 "thumbstick_right/x thumbstick_right/y /output/haptic_left /output/haptic_right /output/haptic_left_trigger "
	 "/output/haptic_right_trigger"},
	{"oculus/go_controller", false, hands,
	 "system/click trigger/click back/click trackpad trackpad/x trackpad/y trackpad/click trackpad/touch grip/pose "
	 "aim/pose"},
	{"oculus/touch_controller", false, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch thumbstick thumbstick/x thumbstick/y thumbstick/click "
	 "thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic"},
	{"valve/index_controller", false, hands,
	 "system/click system/touch a/click a/touch b/click b/touch squeeze/value squeeze/force trigger/click "
	 "trigger/value trigger/touch thumbstick thumbstick/x thumbstick/y thumbstick/click thumbstick/touch trackpad "
	 "trackpad/x trackpad/y trackpad/force trackpad/touch grip/pose aim/pose /output/haptic"},
	{"bytedance/pico_neo3_controller", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch R:a/click R:a/touch R:b/click R:b/touch system/click menu/click "
	 "squeeze/click squeeze/value trigger/click trigger/touch trigger/value thumbstick thumbstick/x thumbstick/y "
	 "thumbstick/click thumbstick/touch grip/pose aim/pose /output/haptic"},
	{"bytedance/pico4_controller", true, hands,
	 "L:x/click L:x/touch L:y/click L:menu/click L:y/touch R:a/click R:a/touch R:b/click R:b/touch system/click "
	 "squeeze/click squeeze/value trigger/click trigger/touch trigger/value thumbstick thumbstick/x thumbstick/y "
	 "thumbstick/click thumbstick/touch grip/pose aim/pose /output/haptic"},
	{"bytedance/pico_g3_controller", true, hands,
	 "trigger/click trigger/value menu/click grip/pose aim/pose thumbstick thumbstick/x thumbstick/y "
	 "thumbstick/click"},
	{"hp/mixed_reality_controller", true, hands,
	 "L:x/click L:y/click R:a/click R:b/click menu/click squeeze/value trigger/value thumbstick thumbstick/x "
	 "thumbstick/y thumbstick/click grip/pose aim/pose /output/haptic"},
	{"htc/vive_cosmos_controller", true, hands,
	 "L:x/click L:y/click L:menu/click R:a/click R:b/click R:system/click shoulder/click squeeze/click trigger/click "
	 "trigger/value thumbstick thumbstick/x thumbstick/y thumbstick/click thumbstick/touch grip/pose aim/pose "
	 "/output/haptic"},
	{"htc/vive_focus3_controller", true, hands,
	 "L:x/click L:y/click L:menu/click R:a/click R:b/click R:system/click squeeze/click squeeze/touch squeeze/value "
	 "trigger/click trigger/touch trigger/value thumbstick thumbstick/x thumbstick/y thumbstick/click "
	 "thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic"},
	{"meta/touch_controller_quest_1_rift_s", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch trigger/proximity thumb_resting_surfaces/proximity thumbstick "
	 "thumbstick/x thumbstick/y thumbstick/click thumbstick/touch grip/pose aim/pose /output/haptic"},
	{"meta/touch_controller_quest_2", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch trigger/proximity thumb_resting_surfaces/proximity thumbstick "
	 "thumbstick/x thumbstick/y thumbstick/click thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic"},
	{"meta/touch_controller_rift_cv1", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch trigger/proximity thumb_resting_surfaces/proximity thumbstick "
	 "thumbstick/x thumbstick/y thumbstick/click thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic"},
	{"meta/touch_plus_controller", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch thumbstick thumbstick/x thumbstick/y thumbstick/click "
	 "thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic thumb_resting_surfaces/proximity "
	 "trigger/proximity trigger_curl/value trigger_slide/value trigger/force"},
	{"meta/touch_pro_controller", true, hands,
	 "L:x/click L:x/touch L:y/click L:y/touch L:menu/click R:a/click R:a/touch R:b/click R:b/touch R:system/click "
	 "squeeze/value trigger/value trigger/touch thumbstick thumbstick/x thumbstick/y thumbstick/click "
	 "thumbstick/touch thumbrest/touch grip/pose aim/pose /output/haptic thumbrest/force stylus/force "
	 "thumb_resting_surfaces/proximity trigger_curl/value trigger_slide/value trigger/proximity "
	 "/output/haptic_trigger /output/haptic_thumb"},
	{"ml/ml2_controller", true, hands,
	 "menu/click home/click trigger/click trigger/value trackpad trackpad/x trackpad/y trackpad/click trackpad/force "
	 "trackpad/touch grip/pose aim/pose shoulder/click /output/haptic"},
	{"samsung/odyssey_controller", true, hands,
	 "menu/click squeeze/click trigger/value thumbstick thumbstick/x thumbstick/y thumbstick/click trackpad "
	 "trackpad/x trackpad/y trackpad/click trackpad/touch grip/pose aim/pose /output/haptic"},
};

/// Whether one word of the components is what `rest` (the path after the user path) asks for.
bool matches(std::string_view component, std::string_view rest)
{
	if (component.starts_with('/')) return component == rest;
	constexpr std::string_view folder = "/input/";
	if (!rest.starts_with(folder)) return false;
	rest.remove_prefix(folder.size());
	// "Input Source Paths": the last component may be left out, the runtime then chooses.
	return component.starts_with(rest) && (component.size() == rest.size() || component[rest.size()] == '/');
}

} // namespace

bool InteractionProfile::has(std::string_view path, bool is1_1) const
{
	const auto user = std::ranges::find_if(userPaths, [&](std::string_view candidate) { return path.starts_with(candidate); });
	if (user == userPaths.end()) return false;
	const std::string_view rest = path.substr(user->size());
	const std::string_view otherHand = *user == handPaths[0] ? "R:" : "L:";
	if (is1_1 && *user != headPaths[0] && *user != gamepadPaths[0] && matches("grip_surface/pose", rest)) return true;
	for (size_t begin = 0; begin < components.size();) {
		const size_t end = std::min(components.find(' ', begin), components.size());
		std::string_view component = components.substr(begin, end - begin);
		begin = end + 1;
		if (component.starts_with(otherHand)) continue;
		if (component.starts_with("L:") || component.starts_with("R:")) component.remove_prefix(2);
		if (matches(component, rest)) return true;
	}
	return false;
}

const InteractionProfile *findInteractionProfile(std::string_view path, bool is1_1)
{
	constexpr std::string_view folder = "/interaction_profiles/";
	if (!path.starts_with(folder)) return nullptr;
	path.remove_prefix(folder.size());
	for (const InteractionProfile &profile : profiles)
		if (profile.name == path && (is1_1 || !profile.since1_1)) return &profile;
	return nullptr;
}

bool isTopLevelUserPath(std::string_view path)
{
	constexpr std::array all{"/user/hand/left"sv, "/user/hand/right"sv, "/user/head"sv, "/user/gamepad"sv, "/user/treadmill"sv};
	return std::ranges::find(all, path) != all.end();
}

} // namespace arift::openxr
