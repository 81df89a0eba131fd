#include "runtime/base/clock.h"
#include <condition_variable>
#include <list>
#include <mutex>
#include <time.h>

namespace arift
{

XrTime realTime()
{
	timespec now{};
	clock_gettime(CLOCK_MONOTONIC, &now);
	return XrTime(now.tv_sec) * second + now.tv_nsec;
}

namespace
{

/// Real and scaled time: sleeps on a condition variable so that a stop request ends the sleep at once.
class RunningClock final : public Clock
{
public:
	explicit RunningClock(double rate) : anchor_(anchorFor(rate)) {}

	XrTime now() const override { return anchor_.at(realTime()); }
	ClockAnchor anchor() const override { return anchor_; }

	bool sleepUntil(XrTime time, std::stop_token stop) override
	{
		const XrTime realDeadline = anchor_.realAnchor + XrDuration(double(time - anchor_.xrAnchor) / anchor_.rate);
		// What could wait for the stop token itself, condition_variable_any, allocates memory in its constructor.
		std::mutex mutex;
		std::condition_variable wake;
		const std::stop_callback onStop(stop, [&] {
			const std::lock_guard lock(mutex);
			wake.notify_all();
		});
		std::unique_lock lock(mutex);
		for (XrDuration left; (left = realDeadline - realTime()) > 0 && !stop.stop_requested();)
			wake.wait_for(lock, std::chrono::nanoseconds(left));
		return realTime() >= realDeadline;
	}

private:
	static ClockAnchor anchorFor(double rate)
	{
		if (rate == 1) return {};
		const XrTime now = realTime();
		return {now, now, rate};
	}
	const ClockAnchor anchor_;
};

class SteppedClock final : public Clock
{
public:
	explicit SteppedClock(XrTime start) : now_(start) {}

	XrTime now() const override
	{
		std::lock_guard lock(mutex_);
		return now_;
	}
	ClockAnchor anchor() const override { return {0, now(), 0}; }

	bool sleepUntil(XrTime time, std::stop_token stop) override
	{
		std::unique_lock lock(mutex_);
		if (time <= now_) return true;
		const auto self = sleepers_.insert(sleepers_.end(), Sleeper{time, false});
		holds_--;
		stepIfFree();
		changed_.wait(lock, stop, [&] { return self->due; });
		const bool due = self->due;
		if (!due) holds_++; // a due sleeper was counted when the clock stepped
		sleepers_.erase(self);
		return due;
	}

protected:
	void take() override
	{
		std::lock_guard lock(mutex_);
		holds_++;
	}
	void letGo() override
	{
		std::lock_guard lock(mutex_);
		holds_--;
		stepIfFree();
	}

private:
	struct Sleeper {
		XrTime time;
		bool due;
	};

	/// Whoever is due holds the clock from the moment of the step, before it has even woken: no step can pass it by.
	void stepIfFree()
	{
		if (holds_ > 0) return;
		XrTime next = XR_INFINITE_DURATION;
		for (const Sleeper &sleeper : sleepers_)
			if (!sleeper.due && sleeper.time < next) next = sleeper.time;
		if (next == XR_INFINITE_DURATION) return;
		now_ = next;
		for (Sleeper &sleeper : sleepers_)
			if (!sleeper.due && sleeper.time <= now_) {
				sleeper.due = true;
				holds_++;
			}
		changed_.notify_all();
	}

	mutable std::mutex mutex_;
	std::condition_variable_any changed_;
	std::list<Sleeper> sleepers_;
	XrTime now_;
	int holds_ = 0;
};

} // namespace

std::unique_ptr<Clock> makeRealClock() { return std::make_unique<RunningClock>(1.0); }
std::unique_ptr<Clock> makeScaledClock(double rate) { return std::make_unique<RunningClock>(rate); }
std::unique_ptr<Clock> makeSteppedClock(XrTime start) { return std::make_unique<SteppedClock>(start); }

} // namespace arift
