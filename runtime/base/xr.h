// OpenXR's own types, used as they are everywhere in the project. Never includes a graphics API.
#pragma once
#define XR_USE_TIMESPEC
#ifndef XR_NO_PROTOTYPES
#define XR_NO_PROTOTYPES
#endif
#include <ctime>
#include <openxr/openxr.h>

namespace arift
{

constexpr XrDuration nanosecond = 1;
constexpr XrDuration microsecond = 1'000;
constexpr XrDuration millisecond = 1'000'000;
constexpr XrDuration second = 1'000'000'000;

constexpr double inSeconds(XrDuration duration) { return double(duration) * 1e-9; }
constexpr XrDuration fromSeconds(double seconds) { return XrDuration(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)); }

} // namespace arift
