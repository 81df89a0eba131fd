#include "drivers/evdev/device.h"
#include "drivers/evdev/gamepad.h"
#include "runtime/base/error.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <sys/ioctl.h>

namespace arift::evdev
{
namespace
{

/// For writing too where that is allowed: motors want it.
UniqueFd open(const Node &node)
{
	constexpr int flags = O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
	UniqueFd fd(::open(node.path.c_str(), O_RDWR | flags));
	if (!fd) fd = UniqueFd(::open(node.path.c_str(), O_RDONLY | flags));
	if (!fd) throw InputError("{} ({}): {}", node.path.string(), node.name, std::strerror(errno));
	return fd;
}

libevdev *attach(const Node &node, int fd)
{
	libevdev *device = nullptr;
	const int problem = libevdev_new_from_fd(fd, &device);
	if (problem != 0) throw InputError("{} ({}): {}", node.path.string(), node.name, std::strerror(-problem));
	return device;
}

/// What the kernel wants to hear of a motor.
uint16_t magnitudeOf(float amplitude) { return uint16_t(std::lround(std::clamp(amplitude, 0.0f, 1.0f) * 0xffff)); }

/// In the kernel's milliseconds; it goes up to this and knows 0 as for ever.
uint16_t lengthOf(XrDuration duration) { return uint16_t(std::clamp<XrDuration>(duration / millisecond, 1, 0x7fff)); }

void take(const input_event &event, InputReport &report)
{
	constexpr int repeated = 2;
	if (event.type == EV_KEY && event.value != repeated) report.keys.push_back({event.code, event.value != 0});
	if (event.type == EV_REL && event.code == REL_X) report.motion.x += float(event.value);
	if (event.type == EV_REL && event.code == REL_Y) report.motion.y -= float(event.value);
}

} // namespace

Device::Device(const Node &node) : kind_(node.kind), fd_(open(node)), device_(attach(node, fd_.get())) {}

std::optional<GamepadState> Device::gamepad() const
{
	return kind_ == InputKind::gamepad ? std::optional(gamepadStateOf(device_.get())) : std::nullopt;
}

/// One event; `isComplete` when it ends a moment.
Outcome Device::next(unsigned flag, InputReport &report, bool &isComplete)
{
	input_event event{};
	const int status = libevdev_next_event(device_.get(), flag, &event);
	if (status == -EAGAIN) return Outcome::timeout;
	if (status < 0) return Outcome::lost;
	if (status == LIBEVDEV_READ_STATUS_SYNC && flag == LIBEVDEV_READ_FLAG_NORMAL) {
		// The kernel's queue has run over: what has changed meanwhile comes as events, and is one moment.
		while (next(LIBEVDEV_READ_FLAG_SYNC, report, isComplete) == Outcome::ready) {}
		isComplete = true;
		return Outcome::ready;
	}
	take(event, report);
	isComplete = event.type == EV_SYN && event.code == SYN_REPORT;
	return Outcome::ready;
}

Outcome Device::read(InputReport &report)
{
	for (bool isComplete = false; !isComplete;)
		if (const Outcome outcome = next(LIBEVDEV_READ_FLAG_NORMAL, report, isComplete); outcome != Outcome::ready) return outcome;
	report.gamepad = gamepad();
	return Outcome::ready;
}

void Device::rumble(const Rumble &rumble)
{
	if (!libevdev_has_event_code(device_.get(), EV_FF, FF_RUMBLE)) return;
	const bool wantsMore = rumble.duration > 0 && (rumble.strong > 0 || rumble.weak > 0);
	if (wantsMore) {
		ff_effect effect{};
		effect.type = FF_RUMBLE;
		effect.id = int16_t(effect_);
		effect.replay.length = lengthOf(rumble.duration);
		effect.u.rumble.strong_magnitude = magnitudeOf(rumble.strong);
		effect.u.rumble.weak_magnitude = magnitudeOf(rumble.weak);
		if (::ioctl(fd_.get(), EVIOCSFF, &effect) < 0) return; // gone, or not ours to write to
		effect_ = effect.id;
	}
	if (effect_ < 0) return;
	input_event play{};
	play.type = EV_FF;
	play.code = uint16_t(effect_);
	play.value = wantsMore ? 1 : 0;
	[[maybe_unused]] const ssize_t written = ::write(fd_.get(), &play, sizeof(play));
}

} // namespace arift::evdev
