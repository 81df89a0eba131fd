// From the tracker's reports to head motion.
#pragma once
#include "runtime/device/imu_tracker.h"
#include "runtime/motion/pose_history.h"
#include "runtime/optics/rig.h"
#include "runtime/tracking/clock_mapper.h"
#include "runtime/tracking/magnetic_heading.h"
#include "runtime/tracking/orientation_filter.h"
#include "runtime/tracking/rate_fit.h"

namespace arift
{

struct HeadTrackerSettings {
	OrientationParameters orientation;
	MagneticParameters magnetic;
	bool magneticHeading = false; ///< indoors a heading that drifts slowly is better than one that is pulled about
	/// Metres, head axes, from the pivot in the neck to the tracker: what turning about the pivot accelerates is no sign of where up is.
	/// Zero where the tracker does not turn about one.
	glm::dvec3 leverInHead{0};
};

struct TrackerHealth {
	double rate = 0;        ///< samples per second, over the last second or so
	uint64_t samples = 0;   ///< used
	uint64_t lostTicks = 0; ///< that the device or the bus swallowed
	uint64_t discarded = 0; ///< samples that came out of order or without a finite rate
	XrTime lastSample = 0;  ///< time of the newest one published; 0: none
	bool resting = false;
	glm::dvec3 bias{0}; ///< rad/s, tracker axes, beyond the calibration's
};

/// Reports in, motion out: maps ticks to host time, calibrates, filters and pushes each sample. The origin frame is y up; the head looks
/// along -z at the first sample. Thread-bound: the tracker's thread feeds it and asks for its health.
class HeadTracker
{
public:
	HeadTracker(const ImuInfo &info, const ImuCalibration &calibration, PoseWriter &history, const HeadTrackerSettings &settings = {});

	/// Samples that are not later than those before are dropped; missing ones are bridged up to a quarter of a second with the mean rate
	/// around the gap; after a longer gap the inclination is found anew and the heading stands.
	void add(const ImuReport &report);

	const TrackerHealth &health() const { return health_; }

private:
	void addSample(const ImuSample &sample);
	void bridge(int64_t lostTicks, const glm::dvec3 &rate);
	void correctHeading(const XrVector3f &field);
	glm::dvec3 forceOfTurning(const glm::dvec3 &rate) const;
	void publish(int64_t tick, const glm::dvec3 &rate, double period);

	ImuCalibration calibration_;
	PoseWriter &history_;
	HeadTrackerSettings settings_;
	glm::dquat headInImu_, imuInHead_;

	ClockMapper clock_;
	OrientationFilter filter_;
	MagneticHeading magnetic_;
	RateFit fit_;
	glm::dvec3 turnAcceleration_{0};    ///< rad/s^2, head axes, at the last sample
	bool started_ = false;              ///< the first sample has set the heading
	glm::dquat originTurn_{1, 0, 0, 0}; ///< the filter's earth (z up, arbitrary heading) in the origin frame
	double magneticStart_ = 0;          ///< the first magnetic heading: the origin does not turn to north
	bool continues_ = false;            ///< lastTick_ is the end of the interval before
	int64_t lastTick_ = 0;
	glm::dvec3 lastRate_{0};
	double sinceField_ = 0; ///< seconds
	TrackerHealth health_;
};

} // namespace arift
