// What the two motors of a gamepad are to do, as sessions ask for it over time. Pure.
#pragma once
#include "runtime/device/input_devices.h"
#include "runtime/ipc/messages.h"
#include <functional>

namespace arift
{

class Vibration
{
public:
	/// As short as can be felt: a motor needs that long to turn.
	static constexpr XrDuration shortest = 30 * millisecond;
	/// However long a session wants: one that hangs is not felt for longer. Who wants more asks again.
	static constexpr XrDuration longest = 60 * second;

	void ask(uint32_t session, const ipc::Vibrate &message, XrTime now);
	/// Motors that a session had which may not have them any more stop, and do not begin again.
	void keepThoseOf(const std::function<bool(uint32_t session)> &mayVibrate);
	/// What they do from `now` on, for as long as nothing changes.
	Rumble at(XrTime now) const;

private:
	struct Motor {
		float amplitude = 0;
		XrTime until = 0;
		uint32_t session = 0; ///< who asked
	};
	std::array<Motor, 2> motors_{}; ///< strong, weak
};

} // namespace arift
