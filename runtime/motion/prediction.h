// Where the head will be: one sample carried forward. Pure functions, used by the service and by the client library alike.
#pragma once
#include "runtime/motion/motion_sample.h"
#include <algorithm>

namespace arift
{

/// Nothing is predicted further than this; later times get the pose at this horizon.
constexpr XrDuration longestPrediction = 100 * millisecond;

/// The angular acceleration is held to fade with this time constant: a head that speeds up will soon slow down.
constexpr double accelerationFading = 0.1; ///< seconds

/// `sample` carried forward by `ahead` (0 to longestPrediction; clamped). Rate and acceleration stay those of head axes:
/// w(t) = w + a T (1 - e^(-t/T)), and the rotation is its second-order Magnus expansion.
inline MotionSample predict(const MotionSample &sample, XrDuration ahead)
{
	const XrDuration clamped = std::clamp<XrDuration>(ahead, 0, longestPrediction);
	const float t = float(inSeconds(clamped)), fading = float(accelerationFading);
	const float half = std::exp(-t / (2 * fading)), left = half * half; // of the acceleration: half-way, and at the end
	const XrVector3f &rate = sample.angularVelocity, &acceleration = sample.angularAcceleration;
	const float gained = fading * (1 - left); // rate for each unit of acceleration
	const XrVector3f turn = rate * t + acceleration * (fading * (t - gained));
	const XrVector3f coning = cross(rate, acceleration) * (t * t * t / 12 * half); // within 1e-5 rad
	return {.time = sample.time + clamped,
			.headInOrigin = normalized(sample.headInOrigin * toXr(rotationOf(toGlm(turn + coning)))),
			.angularVelocity = rate + acceleration * gained,
			.angularAcceleration = acceleration * left};
}

} // namespace arift
