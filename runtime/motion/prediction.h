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
	const double t = inSeconds(std::clamp<XrDuration>(ahead, 0, longestPrediction)), fading = accelerationFading;
	const double left = std::exp(-t / fading);
	const glm::dvec3 rate = toGlm(sample.angularVelocity), acceleration = toGlm(sample.angularAcceleration);
	const glm::dvec3 turn = rate * t + acceleration * (fading * (t - fading * (1 - left)));
	const glm::dvec3 coning = glm::cross(rate, acceleration) * (t * t * t / 12 * std::sqrt(left)); // within 1e-5 rad
	return {.time = sample.time + XrDuration(std::clamp<XrDuration>(ahead, 0, longestPrediction)),
			.headInOrigin = toXr(glm::normalize(toGlm(sample.headInOrigin) * rotationOf(turn + coning))),
			.angularVelocity = toXr(rate + acceleration * (fading * (1 - left))),
			.angularAcceleration = toXr(acceleration * left)};
}

} // namespace arift
