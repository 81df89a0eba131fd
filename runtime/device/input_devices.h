// What keyboards, mice and gamepads are: all that a person has switched on, read together. Drivers own no threads and know no OpenXR.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/base/gamepad.h"
#include "runtime/device/outcome.h"
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arift
{

/// Where the system lists them: its own places, or a test's.
struct InputPlaces {
	std::filesystem::path devices = "/dev/input";
	std::filesystem::path sysfs = "/sys";
};

enum class InputKind { keyboard, mouse, gamepad, other };

/// A key or button by the number that Linux gives it: KEY_*, BTN_* of linux/input-event-codes.h.
using KeyCode = uint16_t;

/// A device as the system lists it, whether or not it is read.
struct InputDeviceInfo {
	std::string node; ///< "event3"
	std::string name; ///< what its maker calls it
	InputKind kind = InputKind::other;
	bool isOn = false;
	std::string problem; ///< why it could not be read; empty where it can
};

struct KeyChange {
	KeyCode key = 0;
	bool isPressed = false;
};

/// What one device says at one moment.
struct InputReport {
	uint32_t device = 0; ///< never given to another one
	InputKind kind = InputKind::other;
	bool isThere = true; ///< false: it is gone, and with it all that was pressed
	std::vector<KeyChange> keys;
	XrVector2f motion{};                 ///< counts of a mouse, x right, y up
	std::optional<GamepadState> gamepad; ///< of a gamepad, as it is now
};

/// Of the two motors that gamepads have, for so long.
struct Rumble {
	float strong = 0, weak = 0; ///< 0 .. 1
	XrDuration duration = 0;    ///< 0: no more
};

class InputDevices
{
public:
	virtual ~InputDevices() = default;
	/// Thread-bound. Blocks until a device comes, goes or says something, `deadline` (real time) has come or wake() is called (both:
	/// timeout).
	virtual Outcome read(InputReport &report, XrTime deadline) = 0;
	/// Thread-bound. Takes the place of what this device was told before; nothing where it has no motors, or is gone.
	virtual void rumble(uint32_t device, const Rumble &rumble) = 0;
	/// Thread-safe: ends the read in progress, or the next one.
	virtual void wake() = 0;
};

} // namespace arift
