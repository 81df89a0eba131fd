// What a gamepad says at a moment: shared by whoever reads one and whoever hears of it.
#pragma once
#include "runtime/base/xr.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace arift
{

/// Named as in the interaction profile microsoft/xbox_controller. OpenXR 1.1, "Microsoft Xbox Controller Profile".
enum class GamepadButton : uint32_t {
	menu,
	view,
	a,
	b,
	x,
	y,
	dpadDown,
	dpadRight,
	dpadUp,
	dpadLeft,
	shoulderLeft,
	shoulderRight,
	thumbstickLeft,
	thumbstickRight,
	count
};

/// In the order of GamepadButton: "a" is .../input/a/click.
inline constexpr std::array<const char *, size_t(GamepadButton::count)> gamepadButtonNames{"menu",
																						   "view",
																						   "a",
																						   "b",
																						   "x",
																						   "y",
																						   "dpad_down",
																						   "dpad_right",
																						   "dpad_up",
																						   "dpad_left",
																						   "shoulder_left",
																						   "shoulder_right",
																						   "thumbstick_left",
																						   "thumbstick_right"};

struct GamepadState {
	uint32_t buttons = 0;                    ///< the bit 1 << GamepadButton is set while it is pressed
	std::array<float, 2> triggers{};         ///< left, right; 0 at rest .. 1
	std::array<XrVector2f, 2> thumbsticks{}; ///< left, right; x right, y up, each -1 .. 1

	bool isPressed(GamepadButton button) const { return (buttons >> uint32_t(button) & 1) != 0; }
	void set(GamepadButton button, bool pressed)
	{
		const uint32_t bit = 1u << uint32_t(button);
		buttons = pressed ? buttons | bit : buttons & ~bit;
	}
};

} // namespace arift
