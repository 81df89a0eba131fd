#include "runtime/service/input_thread.h"
#include "runtime/base/log.h"

namespace arift
{
namespace
{

/// How long to read at most (real time) before looking round.
constexpr XrDuration readLimit = second;
/// What motors are told at a time: the kernel knows no longer times, and stops them by itself should nobody do so.
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

void InputThread::vibrate(const ipc::Vibrate &message)
{
	wanted_.update([&](Wanted &wanted) {
		wanted.vibration.ask(message, realTime());
		++wanted.changes;
	});
	devices_->wake();
}

void InputThread::stopVibrating()
{
	wanted_.update([](Wanted &wanted) {
		wanted.vibration.stop();
		++wanted.changes;
	});
	devices_->wake();
}

/// Tells the motors where that is news to them: somebody has asked, or what they were told is over.
void InputThread::drive()
{
	const XrTime now = realTime();
	const Wanted wanted = *wanted_.lock();
	const bool isOver = told_.rumble.duration > 0 && now >= told_.until;
	if (wanted.changes == told_.changes && !isOver) return;
	Rumble rumble = wanted.vibration.at(now);
	rumble.duration = std::min(rumble.duration, longestRumble);
	const bool isAtRest = rumble.duration == 0 && told_.rumble.duration == 0;
	told_ = {wanted.changes, rumble, now + rumble.duration};
	if (const auto gamepad = map_.gamepad(); gamepad && !isAtRest) devices_->rumble(*gamepad, rumble);
}

void InputThread::take(const InputReport &report)
{
	const Wishes wishes = map_.take(report);
	deeds_.tell(map_.table());
	if (wishes.rawPassthrough) deeds_.toggleRawPassthrough();
	if (wishes.recenter) deeds_.recenter();
}

void InputThread::run(const std::stop_token &stop)
try {
	while (!stop.stop_requested()) {
		drive();
		const XrTime now = realTime();
		const XrTime deadline = told_.rumble.duration > 0 ? std::min(now + readLimit, told_.until) : now + readLimit;
		InputReport report;
		if (devices_->read(report, deadline) == Outcome::ready) take(report);
	}
} catch (const std::exception &problem) {
	log::error("keyboards, mice and gamepads are read no more: {}", problem.what());
}

} // namespace arift
