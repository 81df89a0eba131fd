#include "runtime/service/vibration.h"
#include <algorithm>

namespace arift
{

void Vibration::ask(uint32_t session, const ipc::Vibrate &message, XrTime now)
{
	for (size_t i = 0; i < motors_.size(); ++i) {
		if ((message.motors >> i & 1) == 0) continue;
		const XrDuration duration = message.duration == 0 ? 0 : std::clamp(message.duration, shortest, longest);
		motors_[i] = {message.amplitude, now + duration, session};
	}
}

void Vibration::keepThoseOf(const std::function<bool(uint32_t session)> &mayVibrate)
{
	for (Motor &motor : motors_)
		if (motor.amplitude > 0 && !mayVibrate(motor.session)) motor = {};
}

Rumble Vibration::at(XrTime now) const
{
	Rumble rumble;
	for (const Motor &motor : motors_) {
		const XrDuration left = motor.amplitude > 0 ? motor.until - now : 0;
		if (left <= 0) continue;
		(&motor == motors_.data() ? rumble.strong : rumble.weak) = motor.amplitude;
		rumble.duration = rumble.duration == 0 ? left : std::min(rumble.duration, left);
	}
	return rumble;
}

} // namespace arift
