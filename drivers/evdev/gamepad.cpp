#include "drivers/evdev/gamepad.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace arift::evdev
{
namespace
{

struct ButtonCode {
	GamepadButton button;
	unsigned code;
};
constexpr std::array buttonCodes{
	ButtonCode{GamepadButton::menu, BTN_START},
	ButtonCode{GamepadButton::view, BTN_SELECT},
	ButtonCode{GamepadButton::a, BTN_SOUTH},
	ButtonCode{GamepadButton::b, BTN_EAST},
	ButtonCode{GamepadButton::x, BTN_X},
	ButtonCode{GamepadButton::y, BTN_Y},
	ButtonCode{GamepadButton::dpadDown, BTN_DPAD_DOWN},
	ButtonCode{GamepadButton::dpadRight, BTN_DPAD_RIGHT},
	ButtonCode{GamepadButton::dpadUp, BTN_DPAD_UP},
	ButtonCode{GamepadButton::dpadLeft, BTN_DPAD_LEFT},
	ButtonCode{GamepadButton::shoulderLeft, BTN_TL},
	ButtonCode{GamepadButton::shoulderRight, BTN_TR},
	ButtonCode{GamepadButton::thumbstickLeft, BTN_THUMBL},
	ButtonCode{GamepadButton::thumbstickRight, BTN_THUMBR},
};

/// Linux has the same number for the name X and for "north", though X is the western one of Microsoft's gamepads. Most drivers go by the
/// name; those of these makers' gamepads by the place.
bool goesByPlace(const libevdev *device)
{
	constexpr int sony = 0x054c, nintendo = 0x057e;
	const int vendor = libevdev_get_id_vendor(device);
	return vendor == sony || vendor == nintendo;
}

bool isPressed(const libevdev *device, unsigned code) { return libevdev_get_event_value(device, EV_KEY, code) != 0; }

bool hasAxes(const libevdev *device, unsigned first, unsigned other)
{
	return libevdev_has_event_code(device, EV_ABS, first) && libevdev_has_event_code(device, EV_ABS, other);
}

/// Y of the kernel goes down.
XrVector2f stickOf(const libevdev *device, unsigned x, unsigned y)
{
	if (!hasAxes(device, x, y)) return {};
	return {centredAxis(*libevdev_get_abs_info(device, x), libevdev_get_event_value(device, EV_ABS, x)),
			-centredAxis(*libevdev_get_abs_info(device, y), libevdev_get_event_value(device, EV_ABS, y))};
}

/// Some have an axis, some a button, some both.
float triggerOf(const libevdev *device, unsigned axis, unsigned button)
{
	const float pulled = libevdev_has_event_code(device, EV_ABS, axis)
							 ? pulledAxis(*libevdev_get_abs_info(device, axis), libevdev_get_event_value(device, EV_ABS, axis))
							 : 0;
	return pulled == 0 && isPressed(device, button) ? 1 : pulled;
}

/// A pad that is told as two axes instead of four buttons.
void addHat(const libevdev *device, GamepadState &state)
{
	const int x = libevdev_get_event_value(device, EV_ABS, ABS_HAT0X), y = libevdev_get_event_value(device, EV_ABS, ABS_HAT0Y);
	if (x < 0) state.set(GamepadButton::dpadLeft, true);
	if (x > 0) state.set(GamepadButton::dpadRight, true);
	if (y < 0) state.set(GamepadButton::dpadUp, true);
	if (y > 0) state.set(GamepadButton::dpadDown, true);
}

} // namespace

float centredAxis(const input_absinfo &range, int value)
{
	const double half = (double(range.maximum) - range.minimum) / 2, flat = std::max(0, range.flat);
	if (!(half > flat)) return 0;
	const double from = value - (range.minimum + half);
	if (std::abs(from) <= flat) return 0;
	return float(std::clamp(std::copysign((std::abs(from) - flat) / (half - flat), from), -1.0, 1.0));
}

float pulledAxis(const input_absinfo &range, int value)
{
	const double flat = std::max(0, range.flat), length = double(range.maximum) - range.minimum - flat;
	if (!(length > 0)) return 0;
	return float(std::clamp((double(value) - range.minimum - flat) / length, 0.0, 1.0));
}

GamepadState gamepadStateOf(const libevdev *device)
{
	GamepadState state;
	for (const auto &[button, code] : buttonCodes) state.set(button, isPressed(device, code));
	if (goesByPlace(device)) {
		state.set(GamepadButton::x, isPressed(device, BTN_WEST));
		state.set(GamepadButton::y, isPressed(device, BTN_NORTH));
	}
	addHat(device, state);
	state.thumbsticks[0] = stickOf(device, ABS_X, ABS_Y);
	// Gamepads without RX and RY have their right stick on Z and RZ, which are triggers otherwise.
	const bool isUsual = hasAxes(device, ABS_RX, ABS_RY);
	state.thumbsticks[1] = isUsual ? stickOf(device, ABS_RX, ABS_RY) : stickOf(device, ABS_Z, ABS_RZ);
	state.triggers = {triggerOf(device, isUsual ? ABS_Z : ABS_BRAKE, BTN_TL2), triggerOf(device, isUsual ? ABS_RZ : ABS_GAS, BTN_TR2)};
	return state;
}

} // namespace arift::evdev
