// What keys, mice and gamepads mean: their reports in, what applications see and what the service itself is asked for out. Pure.
#pragma once
#include "runtime/ipc/pages.h"
#include "runtime/service/input_settings.h"
#include <map>
#include <set>

namespace arift
{

/// What a report asks of the service itself.
struct Wishes {
	bool recenter = false;
	bool rawPassthrough = false; ///< the other way round than it is
};

class InputMap
{
public:
	explicit InputMap(InputSettings settings);

	Wishes take(const InputReport &report);
	const ipc::InputTable &table() const { return table_; }
	/// The device that is /user/gamepad: of several the one that was there first.
	std::optional<uint32_t> gamepad() const;

private:
	struct Held {
		InputKind kind = InputKind::other;
		std::set<KeyCode> keys;
		std::optional<GamepadState> gamepad;
	};
	bool isHeld(const std::vector<KeyCode> &keys) const;
	void aim(const XrVector2f &motion);
	ipc::HandState hand() const;

	const InputSettings settings_;
	std::map<uint32_t, Held> devices_; ///< numbers grow: the first is the oldest
	XrVector2f aim_{};                 ///< radians from straight ahead, to the right and up
	ipc::InputTable table_;
};

} // namespace arift
