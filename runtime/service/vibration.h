// What the two motors of a gamepad are to do, as a session asks for it over time. Pure.
#pragma once
#include "runtime/device/input_devices.h"
#include "runtime/ipc/messages.h"

namespace arift
{

class Vibration
{
public:
	/// As short as can be felt: a motor needs that long to turn.
	static constexpr XrDuration shortest = 30 * millisecond;

	void ask(const ipc::Vibrate &message, XrTime now);
	void stop() { motors_ = {}; }
	/// What they do from `now` on, for as long as nothing changes.
	Rumble at(XrTime now) const;

private:
	struct Motor {
		float amplitude = 0;
		XrTime until = 0;
	};
	std::array<Motor, 2> motors_{}; ///< strong, weak
};

} // namespace arift
