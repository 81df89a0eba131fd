// What a head tracker is: blocks until the next report. Drivers own no threads, filter nothing and know no calibration.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/device/outcome.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace arift
{

constexpr double standardGravity = 9.80665; ///< m/s^2

/// Inertial measurement in the tracker's own axes, before calibration.
struct ImuSample {
	int64_t tick = 0;           ///< device ticks at the end of the interval it stands for, unwrapped, never falling
	int32_t ticks = 1;          ///< length of that interval; more than 1 where the device averaged a backlog
	XrVector3f angularVelocity; ///< rad/s
	XrVector3f acceleration;    ///< specific force, m/s^2: (0, +9.81, 0) when level and at rest
};

/// What one read delivers, oldest sample first.
struct ImuReport {
	XrTime arrival = 0; ///< when the host had it
	std::array<ImuSample, 3> samples;
	uint32_t sampleCount = 0;                ///< 1 to 3
	std::optional<XrVector3f> magneticField; ///< tesla, tracker axes; of the newest sample
	float temperature = 0;                   ///< degrees Celsius
	uint32_t lostTicks = 0;                  ///< ticks missing between the report before and this one
	bool restarted = false;                  ///< ticks begin anew: forget the mapping to host time
};

struct ImuInfo {
	std::string name;         ///< for people: "Oculus Rift DK1 tracker AAAAAAAAAAAA"
	double tickPeriod = 1e-3; ///< nominal seconds per tick
	double sampleRate = 1000; ///< nominal samples per second
	bool isWorn = true;       ///< on a head, which turns about its neck; false for the recording of something carried otherwise
	uint64_t malformed = 0;   ///< reports dropped so far because they could not be decoded
};

class ImuTracker
{
public:
	virtual ~ImuTracker() = default;
	virtual ImuInfo info() const = 0;
	/// Thread-bound. Blocks until a report is there, `deadline` has come or stop is requested (both: timeout).
	virtual Outcome read(ImuReport &report, XrTime deadline, std::stop_token stop) = 0;
};

} // namespace arift
