// One instant of head motion, as the tracker publishes it and as both processes read it.
#pragma once
#include "runtime/base/pose.h"

namespace arift
{

/// The head (the VIEW frame: midway between the eyes) as the orientation filter sees it. Frame "origin": y up against gravity, never moved;
/// recentring moves spaces, not samples. Position follows from the neck model and is not stored.
struct MotionSample {
	XrTime time = 0;
	XrQuaternionf headInOrigin = identityOrientation;
	XrVector3f angularVelocity{0, 0, 0};     ///< rad/s, in head axes, bias removed
	XrVector3f angularAcceleration{0, 0, 0}; ///< rad/s^2, in head axes
};

/// The head turns about a pivot fixed in the origin frame, OpenXR axes, metres. ANSUR-88 neck to eye, as LibOVR 0.4 has it: 0.0805 forward,
/// 0.075 up.
struct NeckModel {
	XrVector3f pivotInHead{0, -0.075f, 0.0805f};
	/// The pose of the head when it has turned to `headInOrigin`; at identity the head is at the origin.
	XrPosef head(const XrQuaternionf &headInOrigin) const { return {headInOrigin, pivotInHead - rotate(headInOrigin, pivotInHead)}; }
};

/// How an answer for a time was found.
enum class Found : uint32_t { none, exact, interpolated, predicted, frozen /**< the tracker is silent; the last known pose stands */ };

struct HeadMotion {
	Found found = Found::none;
	MotionSample at; ///< `at.time` is the time asked for
};

} // namespace arift
