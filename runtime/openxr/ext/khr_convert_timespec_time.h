// XR_KHR_convert_timespec_time: XrTime against CLOCK_MONOTONIC.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

void convertTimespecTimeToTime(Instance &instance, const timespec *timespecTime, XrTime &time);
void convertTimeToTimespecTime(Instance &instance, XrTime time, timespec *timespecTime);

} // namespace arift::openxr
