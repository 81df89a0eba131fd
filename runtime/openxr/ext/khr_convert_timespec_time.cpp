#include "runtime/openxr/ext/khr_convert_timespec_time.h"
#include "runtime/openxr/space.h"
#include <cmath>
#include <optional>

namespace arift::openxr
{
namespace
{

/// A stepped clock has no relation to real time: there the conversion keeps the number, so that it still goes both ways.
ClockAnchor invertibleAnchor(const Instance &instance)
{
	const ClockAnchor anchor = instance.service.clock();
	return anchor.rate > 0 ? anchor : ClockAnchor{};
}

/// What one clock says when another says `time`: at `from` it said `to`, and it runs `rate` times as fast. Nothing for what no number says.
std::optional<int64_t> converted(int64_t time, int64_t from, int64_t to, double rate)
{
	constexpr double most = 9.2e18;
	int64_t since = 0, result = 0;
	if (__builtin_sub_overflow(time, from, &since)) return std::nullopt;
	if (rate != 1) {
		const double scaled = double(since) * rate;
		if (!(std::abs(scaled) < most)) return std::nullopt;
		since = int64_t(scaled);
	}
	if (__builtin_add_overflow(since, to, &result)) return std::nullopt;
	return result;
}

} // namespace

void convertTimespecTimeToTime(Instance &instance, const timespec *timespecTime, XrTime &time)
{
	if (!timespecTime) throw Error(XR_ERROR_VALIDATION_FAILURE, "timespecTime is null");
	const bool valid = timespecTime->tv_sec >= 0 && timespecTime->tv_sec < XR_INFINITE_DURATION / second && timespecTime->tv_nsec >= 0 &&
					   timespecTime->tv_nsec < second;
	if (!valid) throw Error(XR_ERROR_TIME_INVALID, "{} s and {} ns are no time", timespecTime->tv_sec, timespecTime->tv_nsec);
	const ClockAnchor anchor = invertibleAnchor(instance);
	const XrTime real = XrTime(timespecTime->tv_sec) * second + timespecTime->tv_nsec;
	const std::optional<XrTime> found = converted(real, anchor.realAnchor, anchor.xrAnchor, anchor.rate);
	if (!found) throw Error(XR_ERROR_TIME_INVALID, "{} s lie beyond the clock's last time", timespecTime->tv_sec);
	requireTime(*found);
	time = *found;
}

void convertTimeToTimespecTime(Instance &instance, XrTime time, timespec *timespecTime)
{
	if (!timespecTime) throw Error(XR_ERROR_VALIDATION_FAILURE, "timespecTime is null");
	requireTime(time);
	const ClockAnchor anchor = invertibleAnchor(instance);
	const std::optional<XrTime> real = converted(time, anchor.xrAnchor, anchor.realAnchor, 1 / anchor.rate);
	if (!real || *real < 0) throw Error(XR_ERROR_TIME_INVALID, "{} lies before the clock began, or beyond its last time", time);
	*timespecTime = {.tv_sec = time_t(*real / second), .tv_nsec = long(*real % second)};
}

} // namespace arift::openxr
