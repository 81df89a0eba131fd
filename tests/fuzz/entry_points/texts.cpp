#include "tests/fuzz/entry_points/texts.h"
#include "runtime/openxr/extensions.h"
#include "runtime/openxr/functions.h"
#include <array>

namespace arift::fuzz
{
namespace
{

// The corpus names them by their places: new ones belong at the end.
constexpr std::array<const char *, 40> pathTexts{
	"/user/hand/left",
	"/user/hand/right",
	"/user/head",
	"/user/gamepad",
	"/user/treadmill",
	"/user/hand_htc/left",
	"/interaction_profiles/khr/simple_controller",
	"/interaction_profiles/oculus/touch_controller",
	"/interaction_profiles/valve/index_controller",
	"/interaction_profiles/htc/vive_controller",
	"/interaction_profiles/microsoft/xbox_controller",
	"/interaction_profiles/microsoft/motion_controller",
	"/interaction_profiles/ext/hand_interaction_ext",
	"/user/hand/left/input/select/click",
	"/user/hand/right/input/select/click",
	"/user/hand/left/input/grip/pose",
	"/user/hand/right/input/aim/pose",
	"/user/hand/left/output/haptic",
	"/user/hand/left/input/trigger/value",
	"/user/hand/left/input/thumbstick",
	"/user/hand/left/input/thumbstick/x",
	"/user/hand/left/input/trackpad",
	"/user/hand/left/input/trackpad/dpad_up",
	"/user/hand/left/input/trackpad/dpad_center",
	"/user/hand/left/input/thumbstick/dpad_left",
	"/user/hand/left/input/trackpad/force",
	"/user/hand/left/input/grip_surface/pose",
	"/user/hand/right/input/palm_ext/pose",
	"/user/gamepad/input/a/click",
	"/user/gamepad/input/thumbstick_left",
	"/user/gamepad/input/trigger_left/value",
	"/user/gamepad/output/haptic_left",
	"/perfmetrics_meta/app/cpu_frametime",
	"/user/hand/left/input/trigger",
	"/user/hand/left/input",
	"/user/hand/left/input/trackpad/y",
	"/user/hand/left/input/aim/pose",
	"/user/hand/right/output/haptic",
	"/user/hand/right/input/thumbstick",
	"/user/head/input/mute_mic/click",
};

std::string_view usual(std::string_view name)
{
	if (name == "pathString") return pathTexts[13];
	if (name == "name") return "xrPollEvent";
	if (name == "enabledApiLayerNames" || name == "layerName") return "XR_APILAYER_none";
	if (name == "enabledExtensionNames") return "XR_MND_headless";
	return {};
}

/// Of those that the name asks for.
std::string known(std::string_view name, size_t number)
{
	if (name == "enabledExtensionNames") return openxr::extensionInfos[number % openxr::extensionInfos.size()].name;
	if (name == "name") {
		const auto names = openxr::functionNames();
		return names[number % names.size()];
	}
	return pathTexts[number % pathTexts.size()];
}

/// Anything but the byte that ends a text.
std::string bytes(Choices &choices, size_t count)
{
	std::string text;
	for (size_t i = 0; i < count; ++i) text += char(std::max<uint8_t>(choices.byte(), 1));
	return text;
}

} // namespace

std::span<const char *const> knownPaths() { return pathTexts; }

uint64_t knownPath(std::string_view text)
{
	const auto found = std::ranges::find(pathTexts, text);
	return found == pathTexts.end() ? 0 : uint64_t(found - pathTexts.begin()) + 1;
}

std::string chooseText(Choices &choices, std::string_view name, unsigned &made)
{
	constexpr uint8_t firstLong = 240, empty = 250, asBefore = 251, upperCase = 252;
	const uint8_t choice = choices.byte();
	if (choice == 0) {
		const std::string_view text = usual(name);
		return text.empty() ? "n" + std::to_string(++made) : std::string(text);
	}
	if (choice < 160) return known(name, choice - 1u);
	if (choice < firstLong) return bytes(choices, choice - 160u);
	if (choice < empty) return "/" + std::string(size_t(choice - firstLong) * 32u + 30u, 'a'); // about where paths end: at 256
	if (choice == asBefore) return "n" + std::to_string(made);
	return choice == upperCase ? "Name" : "";
}

} // namespace arift::fuzz
