#include "runtime/openxr/ext/khr_convert_timespec_time.h"
#include "runtime/openxr/space.h"

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

} // namespace

void convertTimespecTimeToTime(Instance &instance, const timespec *timespecTime, XrTime &time)
{
	if (!timespecTime) throw Error(XR_ERROR_VALIDATION_FAILURE, "timespecTime is null");
	const bool valid = timespecTime->tv_sec >= 0 && timespecTime->tv_sec < XR_INFINITE_DURATION / second && timespecTime->tv_nsec >= 0 &&
					   timespecTime->tv_nsec < second;
	if (!valid) throw Error(XR_ERROR_TIME_INVALID, "{} s and {} ns are no time", timespecTime->tv_sec, timespecTime->tv_nsec);
	const XrTime converted = invertibleAnchor(instance).at(XrTime(timespecTime->tv_sec) * second + timespecTime->tv_nsec);
	requireTime(converted);
	time = converted;
}

void convertTimeToTimespecTime(Instance &instance, XrTime time, timespec *timespecTime)
{
	if (!timespecTime) throw Error(XR_ERROR_VALIDATION_FAILURE, "timespecTime is null");
	requireTime(time);
	const ClockAnchor anchor = invertibleAnchor(instance);
	const XrTime real = anchor.rate == 1 ? anchor.realAnchor + (time - anchor.xrAnchor)
										 : anchor.realAnchor + XrDuration(double(time - anchor.xrAnchor) / anchor.rate);
	if (real < 0) throw Error(XR_ERROR_TIME_INVALID, "{} lies before the clock began", time);
	*timespecTime = {.tv_sec = time_t(real / second), .tv_nsec = long(real % second)};
}

} // namespace arift::openxr
