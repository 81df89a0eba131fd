#include "drivers/replay/played_tracker.h"
#include "runtime/base/pose.h"
#include <algorithm>
#include <cmath>

namespace arift::replay
{

PlayedTracker::PlayedTracker(Clock &clock, XrTime start, ImuPlayback playback)
	: clock_(clock), start_(start), playback_(std::move(playback))
{
	const XrTime now = clock.now();
	next_ = uint64_t(std::max<XrDuration>(0, (now - start) / playback_.length)) * playback_.samples.size();
	while (timeOf(next_) <= now && (playback_.loop || next_ < playback_.samples.size())) next_++;
}

ImuInfo PlayedTracker::info() const
{
	return {.name = playback_.name, .tickPeriod = 1 / playback_.rate, .sampleRate = playback_.rate, .isWorn = false};
}

XrTime PlayedTracker::timeOf(uint64_t index) const
{
	const size_t count = playback_.samples.size();
	return start_ + XrDuration(index / count) * playback_.length + playback_.samples[index % count].time;
}

Outcome PlayedTracker::read(ImuReport &report, XrTime deadline, std::stop_token stop)
{
	const size_t count = playback_.samples.size();
	if (!playback_.loop && next_ >= count) return Outcome::lost;
	const XrTime time = timeOf(next_);
	const bool isDue = clock_.sleepUntil(std::min(time, deadline), stop);
	if (!isDue || time > deadline || stop.stop_requested()) return Outcome::timeout;

	const RecordedImu &sample = playback_.samples[next_ % count];
	const int64_t nominal = std::llround(inSeconds(time - start_) * playback_.rate);
	const int64_t tick = isFirst_ ? nominal : std::max(lastTick_ + 1, nominal);
	report = {.arrival = time, .sampleCount = 1};
	report.samples[0] = {
		.tick = tick, .ticks = 1, .angularVelocity = toXr(sample.angularVelocity), .acceleration = toXr(sample.acceleration)};
	report.restarted = isFirst_ || next_ % count == 0;
	report.lostTicks = report.restarted ? 0 : uint32_t(tick - lastTick_ - 1);
	lastTick_ = tick;
	isFirst_ = false;
	next_++;
	return Outcome::ready;
}

} // namespace arift::replay
