// How the simulated head moves: pose and exact derivatives at any time.
#pragma once
#include "runtime/base/pose.h"
#include <memory>

namespace arift::synthetic
{

/// The head at one instant. World: y up, the head at rest at its origin looking along -z.
struct HeadState {
	glm::dquat orientation{1, 0, 0, 0}; ///< head in world
	glm::dvec3 position{0};             ///< metres, world
	glm::dvec3 acceleration{0};         ///< m/s^2, world
	glm::dvec3 angularVelocity{0};      ///< rad/s, head axes
	glm::dvec3 angularAcceleration{0};  ///< rad/s^2, head axes

	XrPosef pose() const { return {toXr(orientation), toXr(position)}; }
};

class HeadMotion
{
public:
	virtual ~HeadMotion() = default;
	/// `seconds` since the headset was opened; any value. Thread-safe.
	virtual HeadState at(double seconds) const = 0;
};

/// `neckInHead`: the pivot the head turns about; it stands still where it is at rest.
std::unique_ptr<HeadMotion> makeRest();
/// Turns about `rate` (rad/s, axis times speed). With a delay it rests, then speeds up within a quarter of a second; without, it always
/// turns.
std::unique_ptr<HeadMotion> makeConstantRate(const glm::dvec3 &rate, double delay, const glm::dvec3 &neckInHead);
/// Somebody looking around: sums of sines of incommensurate frequencies, up to about 90 deg/s; `seed` chooses them.
std::unique_ptr<HeadMotion> makeNatural(uint64_t seed, double delay, const glm::dvec3 &neckInHead);

/// What an accelerometer and a gyroscope at `imuInHead` feel, in the tracker's axes.
struct ImuTruth {
	glm::dvec3 specificForce, angularVelocity;
};
ImuTruth imuTruth(const HeadState &head, const XrPosef &imuInHead);

} // namespace arift::synthetic
