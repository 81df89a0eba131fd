// Device ticks to host time.
#pragma once
#include "runtime/base/xr.h"
#include <cstdint>
#include <vector>

namespace arift
{

/// Reports reach the host late, by a little or (a stalled host, a backlog) by much, but never early: so the mapping is a line that touches
/// their arrivals from below. It is the one with the least sum of distances (Moon, Skelly & Towsley, INFOCOM 1999), over the last 16 s,
/// which also measures the tick's true period. What remains is the least latency itself, which cannot be seen from one side.
/// Deterministic: the same reports give the same times.
class ClockMapper
{
public:
	/// `nominalTickPeriod` in seconds; the true one may differ by some percent.
	explicit ClockMapper(double nominalTickPeriod);

	/// The newest sample of a report and when the host had it. Ticks must not fall.
	void add(int64_t tick, XrTime arrival);
	/// When this tick was. To be asked in rising order: time rises strictly with it, whatever the line has learnt between.
	XrTime timeOf(int64_t tick);
	/// Seconds per tick, as measured so far.
	double tickPeriod() const { return slope_ * 1e-9; }
	/// The device's ticks begin anew.
	void reset();

private:
	/// The report with the least latency among some consecutive ones.
	struct Point {
		double tick;    ///< since base
		double arrival; ///< ns since base
		int64_t bucket;
		int reports;
	};
	double above(const Point &point) const { return point.arrival - offset_ - slope_ * point.tick; }
	bool belongsToAnotherClock(const Point &point);
	void merge();
	void fit();

	double nominal_; ///< ns per tick
	double finest_;  ///< ticks per bucket at first
	double coarsest_;

	std::vector<Point> points_;
	double bucketTicks_ = 0;
	int64_t baseTick_ = 0;
	XrTime baseTime_ = 0;
	double slope_ = 0, offset_ = 0; ///< ns per tick, ns since base at base
	double meanLatency_ = 0;        ///< ns above the line
	double lateSince_ = -1;         ///< ns since base: from when on all reports were far above the line; negative: they are not

	int64_t lastTick_ = 0;
	XrTime lastTime_ = 0;
};

} // namespace arift
