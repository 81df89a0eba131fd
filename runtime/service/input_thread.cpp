#include "runtime/service/input_thread.h"
#include "runtime/base/log.h"
#include <algorithm>

namespace arift
{
namespace
{

/// How long to read at most (real time) before looking round.
constexpr XrDuration readLimit = second;
/// What motors are told at a time: the kernel knows no longer times.
constexpr XrDuration longestRumble = 30 * second;

} // namespace

InputThread::InputThread(InputSettings settings, std::unique_ptr<InputDevices> devices, Deeds deeds)
	: map_(std::move(settings)),
	  devices_(std::move(devices)),
	  deeds_(std::move(deeds)),
	  thread_([this](const std::stop_token &stop) { run(stop); })
{
}

InputThread::~InputThread()
{
	thread_.request_stop();
	devices_->wake();
	thread_.join();
}

void InputThread::vibrate(uint32_t session, const ipc::Vibrate &message)
{
	wanted_.update([&](Wanted &wanted) {
		wanted.vibration.ask(session, message, realTime());
		++wanted.changes;
	});
	devices_->wake();
}

void InputThread::focusMoved()
{
	wanted_.update([](Wanted &wanted) { ++wanted.changes; });
	devices_->wake();
}

/// Without what sessions want that may not, which is forgotten. Should anything have come while they were asked for, they are asked for
/// again: the number of changes says so.
InputThread::Wanted InputThread::wanted()
{
	Wanted wanted = *wanted_.lock();
	wanted.vibration.keepThoseOf(deeds_.mayVibrate);
	wanted_.update([&](Wanted &now) {
		if (now.changes == wanted.changes) now.vibration = wanted.vibration;
	});
	return wanted;
}

/// Tells the motors where that is news to them: somebody has asked, the focus has moved, or what they were told is over. The kernel stops
/// them by itself should nobody do so.
void InputThread::drive()
{
	const XrTime now = realTime();
	const bool isOver = told_.rumble.duration > 0 && now >= told_.until;
	if (wanted_.lock()->changes == told_.changes && !isOver) return;
	const Wanted news = wanted();
	Rumble rumble = news.vibration.at(now);
	rumble.duration = std::min(rumble.duration, longestRumble);
	const bool isAtRest = rumble.duration == 0 && told_.rumble.duration == 0;
	told_ = {news.changes, rumble, now + rumble.duration};
	if (const auto gamepad = map_.gamepad(); gamepad && !isAtRest) devices_->rumble(*gamepad, rumble);
}

void InputThread::take(const InputReport &report)
{
	const Wishes wishes = map_.take(report);
	deeds_.tell(map_.table());
	if (wishes.rawPassthrough) deeds_.toggleRawPassthrough();
	if (wishes.recenter) deeds_.recenter();
}

void InputThread::read(const std::stop_token &stop)
{
	while (!stop.stop_requested()) {
		drive();
		const XrTime now = realTime();
		const XrTime deadline = told_.rumble.duration > 0 ? std::min(now + readLimit, told_.until) : now + readLimit;
		InputReport report;
		if (devices_->read(report, deadline) == Outcome::ready) take(report);
	}
}

/// No key is held and no motor turns for ever.
void InputThread::leave()
{
	deeds_.tell({});
	if (const auto gamepad = map_.gamepad(); gamepad && told_.rumble.duration > 0) devices_->rumble(*gamepad, {});
}

void InputThread::run(const std::stop_token &stop)
{
	try {
		read(stop);
	} catch (const std::exception &problem) {
		log::error("keyboards, mice and gamepads are read no more: {}", problem.what());
	}
	leave();
}

} // namespace arift
