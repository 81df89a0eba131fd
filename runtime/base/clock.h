// The one source of time. All code takes it from here: real, scaled, or stepped (a discrete-event simulation).
#pragma once
#include "runtime/base/xr.h"
#include <memory>
#include <stop_token>
#include <utility>

namespace arift
{

/// CLOCK_MONOTONIC now, in nanoseconds: for durations, heartbeats and limits, which are always real.
XrTime realTime();

/// How XrTime relates to CLOCK_MONOTONIC at this moment; what the shared page carries to other processes.
/// xr = xrAnchor + (monotonic - realAnchor) * rate; rate 1 with equal anchors is the identity, rate 0 is a stepped clock.
struct ClockAnchor {
	XrTime realAnchor = 0;
	XrTime xrAnchor = 0;
	double rate = 1;
	XrTime at(XrTime real) const
	{
		return rate == 1 ? xrAnchor + (real - realAnchor) : xrAnchor + XrDuration(double(real - realAnchor) * rate);
	}
};

class Clock
{
public:
	virtual ~Clock() = default;

	virtual XrTime now() const = 0;
	/// Sleeps until `time` has come or stop is requested; says whether the time has come.
	/// With a stepped clock only a thread that holds the clock may call this; it lets go while it sleeps.
	virtual bool sleepUntil(XrTime time, std::stop_token stop) = 0;
	virtual ClockAnchor anchor() const = 0;

	/// While anybody holds a stepped clock, time stands still; it steps to the earliest sleeper's time when nobody does.
	/// Every thread that sleeps on the clock holds it while it works, and so does every application between two xrWaitFrame.
	/// Real and scaled clocks take no notice.
	class Hold
	{
	public:
		explicit Hold(Clock &clock) : clock_(&clock) { clock.take(); }
		Hold(Hold &&other) noexcept : clock_(std::exchange(other.clock_, nullptr)) {}
		Hold &operator=(Hold &&other) noexcept
		{
			std::swap(clock_, other.clock_);
			return *this;
		}
		~Hold()
		{
			if (clock_) clock_->letGo();
		}

	private:
		Clock *clock_;
	};

protected:
	virtual void take() {}
	virtual void letGo() {}
};

std::unique_ptr<Clock> makeRealClock();
/// Runs `rate` times as fast as real time, from the real time at which it is made.
std::unique_ptr<Clock> makeScaledClock(double rate);
/// Steps from sleeper to sleeper, as fast as the machine can; starts at `start`.
std::unique_ptr<Clock> makeSteppedClock(XrTime start);

} // namespace arift
