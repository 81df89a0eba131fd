#include "runtime/service/vibration.h"
#include <algorithm>

namespace arift
{

void Vibration::ask(const ipc::Vibrate &message, XrTime now)
{
	for (size_t i = 0; i < motors_.size(); ++i) {
		if ((message.motors >> i & 1) == 0) continue;
		const XrDuration duration = message.duration == 0 ? 0 : std::max(message.duration, shortest);
		const XrDuration longest = std::numeric_limits<XrTime>::max() - now;
		motors_[i] = {message.amplitude, now + std::min(duration, longest)};
	}
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
