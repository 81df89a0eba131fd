// What OpenXR calls a gamepad, made of evdev's axes and buttons. Linux, Documentation/input/gamepad.rst.
#pragma once
#include "runtime/base/gamepad.h"
#include <libevdev/libevdev.h>

namespace arift::evdev
{

/// An axis that rests in the middle of its range, -1 .. 1; 0 as long as it is within its flat part, from the edge of which it begins anew.
float centredAxis(const input_absinfo &range, int value);

/// An axis that rests at the lower end, 0 .. 1; 0 within its flat part.
float pulledAxis(const input_absinfo &range, int value);

GamepadState gamepadStateOf(const libevdev *device);

} // namespace arift::evdev
