#include "runtime/motion/prediction.h"
#include <gtest/gtest.h>

using namespace arift;

TEST(Prediction, ConstantRateIsExact)
{
	const MotionSample sample{second, rotationAbout({1, 0, 0}, 0.4), {0.3f, -2, 1}, {0, 0, 0}};
	for (const XrDuration ahead : {XrDuration(0), 20 * millisecond, 100 * millisecond}) {
		const MotionSample later = predict(sample, ahead);
		const glm::dquat expected = toGlm(sample.headInOrigin) * rotationOf(toGlm(sample.angularVelocity) * inSeconds(ahead));
		EXPECT_LT(angleBetween(later.headInOrigin, toXr(expected)), 1e-6);
		EXPECT_EQ(later.time, second + ahead);
	}
	EXPECT_EQ(predict(sample, -5).time, second);
	EXPECT_EQ(predict(sample, second).time, second + longestPrediction);
}

TEST(Prediction, MatchesTheNumericalIntegralOfAFadingAcceleration)
{
	const MotionSample sample{second, identityOrientation, {1, -2, 0.5f}, {20, 10, -15}};
	glm::dquat orientation(1, 0, 0, 0);
	glm::dvec3 rate = toGlm(sample.angularVelocity);
	constexpr double step = 1e-6;
	for (int i = 0; i < 50'000; ++i) {
		const double t = (i + 0.5) * step;
		const glm::dvec3 middle = rate + toGlm(sample.angularAcceleration) * (accelerationFading * (1 - std::exp(-t / accelerationFading)));
		orientation = glm::normalize(orientation * rotationOf(middle * step));
	}
	const MotionSample later = predict(sample, 50 * millisecond);
	EXPECT_LT(angleBetween(later.headInOrigin, toXr(orientation)), 2e-5);
	EXPECT_NEAR(later.angularVelocity.x, 1 + 20 * accelerationFading * (1 - std::exp(-0.05 / accelerationFading)), 1e-5);
	EXPECT_NEAR(later.angularAcceleration.x, 20 * std::exp(-0.05 / accelerationFading), 1e-5);
}
