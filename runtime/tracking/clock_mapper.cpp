#include "runtime/tracking/clock_mapper.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace arift
{
namespace
{

constexpr size_t pointCount = 64;
constexpr double coarsestBucket = 0.25, finestBucket = 0.004; // seconds
constexpr double farOff = 20e6;                               // ns: no line that once fitted is so wrong
constexpr double longestLateness = 1e9;                       // ns
constexpr double widestSlope = 0.1;                           // relative to nominal

} // namespace

ClockMapper::ClockMapper(double nominalTickPeriod)
	: nominal_(nominalTickPeriod * 1e9),
	  finest_(std::max(1.0, finestBucket / nominalTickPeriod)),
	  coarsest_(std::max(1.0, coarsestBucket / nominalTickPeriod))
{
	points_.reserve(pointCount + 1);
	reset();
}

void ClockMapper::reset()
{
	points_.clear();
	bucketTicks_ = finest_;
	slope_ = nominal_;
	offset_ = meanLatency_ = 0;
	lateSince_ = -1;
}

void ClockMapper::add(int64_t tick, XrTime arrival)
{
	if (points_.empty()) {
		baseTick_ = tick;
		baseTime_ = arrival;
		lastTick_ = tick;
	}
	Point point{double(tick - baseTick_), double(arrival - baseTime_), 0, 1};
	if (point.tick < 0) return;
	if (belongsToAnotherClock(point)) {
		reset();
		return add(tick, arrival);
	}
	point.bucket = int64_t(point.tick / bucketTicks_);
	meanLatency_ += (std::max(0.0, above(point)) - meanLatency_) / 64;
	if (!points_.empty() && points_.back().bucket == point.bucket) {
		Point &newest = points_.back();
		point.reports = newest.reports + 1;
		if (above(point) < above(newest)) newest = point;
		newest.reports = point.reports;
		if (above(newest) < 0) fit();
		return;
	}
	points_.push_back(point);
	if (points_.size() > pointCount) merge();
	fit();
}

/// The host's clock stood still while the device's ran (suspend), or the other way round, and nobody said so. A backlog after a stall is
/// late as well, but comes all at once.
bool ClockMapper::belongsToAnotherClock(const Point &point)
{
	if (points_.empty() || points_.back().tick - points_.front().tick < 8 * coarsest_) return false;
	if (above(point) <= farOff)
		lateSince_ = -1;
	else if (lateSince_ < 0)
		lateSince_ = point.arrival;
	return above(point) < -farOff || (lateSince_ >= 0 && point.arrival - lateSince_ > longestLateness);
}

/// Makes room: pairs of buckets become one, keeping the report closest to the line; once they are coarse, the oldest goes.
void ClockMapper::merge()
{
	if (2 * bucketTicks_ > coarsest_) {
		points_.erase(points_.begin());
		return;
	}
	bucketTicks_ *= 2;
	size_t kept = 0;
	for (size_t i = 0; i < points_.size(); ++i) {
		Point point = points_[i];
		point.bucket = int64_t(point.tick / bucketTicks_);
		if (kept > 0 && points_[kept - 1].bucket == point.bucket) {
			const int reports = points_[kept - 1].reports + point.reports;
			if (above(point) < above(points_[kept - 1])) points_[kept - 1] = point;
			points_[kept - 1].reports = reports;
		} else {
			points_[kept++] = point;
		}
	}
	points_.resize(kept);
}

/// Of all lines below the points, the one with the least sum of distances is the edge of their lower hull at their mean tick.
void ClockMapper::fit()
{
	double mean = 0, reports = 0;
	std::array<const Point *, pointCount> hull;
	size_t corners = 0;
	for (const Point &point : points_) {
		mean += point.tick / double(points_.size());
		reports += point.reports;
		const auto concave = [&point](const Point &a, const Point &b) {
			return (b.arrival - a.arrival) * (point.tick - a.tick) >= (point.arrival - a.arrival) * (b.tick - a.tick);
		};
		while (corners >= 2 && concave(*hull[corners - 2], *hull[corners - 1])) --corners;
		hull[corners++] = &point;
	}
	slope_ = nominal_;
	const double span = points_.back().tick - points_.front().tick;
	if (corners >= 2 && span > 0) {
		size_t edge = 1;
		while (edge + 1 < corners && hull[edge]->tick < mean) ++edge;
		const double found = (hull[edge]->arrival - hull[edge - 1]->arrival) / (hull[edge]->tick - hull[edge - 1]->tick) - nominal_;
		// The two reports of the edge are late by the mean latency over their number; a difference that this explains is not believed.
		const double doubt = 8 * (meanLatency_ + 10e3) / (reports * span);
		const double believed = found * (found * found / (found * found + doubt * doubt));
		slope_ += std::clamp(believed, -widestSlope * nominal_, widestSlope * nominal_);
	}
	offset_ = points_.front().arrival - slope_ * points_.front().tick;
	for (const Point &point : points_) offset_ = std::min(offset_, point.arrival - slope_ * point.tick);
}

XrTime ClockMapper::timeOf(int64_t tick)
{
	const XrTime line = baseTime_ + XrTime(std::floor(offset_ + slope_ * double(tick - baseTick_)));
	const XrTime least = lastTime_ + std::max<XrTime>(1, XrTime(slope_ * double(std::clamp<int64_t>(tick - lastTick_, 0, 1000)) / 8));
	lastTick_ = tick;
	lastTime_ = std::max(line, least);
	return lastTime_;
}

} // namespace arift
