#include "runtime/base/pose.h"
#include "runtime/tracking/orientation_filter.h"
#include <gtest/gtest.h>
#include <random>

using namespace arift;

namespace
{

constexpr double period = 1e-3;
constexpr double gravity = 9.80665;
const glm::dquat level(1, 0, 0, 0);

double inclinationError(const glm::dquat &estimate, const glm::dquat &truth)
{
	const glm::dquat e = estimate * glm::conjugate(truth);
	return 2 * std::acos(std::min(1.0, std::hypot(e.w, e.z))) / degree;
}

/// Specific force of a sensor at rest in this orientation (sensor in earth, z up).
glm::dvec3 weight(const glm::dquat &orientation) { return glm::conjugate(orientation) * glm::dvec3(0, 0, gravity); }

/// The noise of an MPU-6000 at 256 Hz bandwidth.
class Noise
{
public:
	glm::dvec3 rate() { return {rate_(random_), rate_(random_), rate_(random_)}; }
	glm::dvec3 acceleration() { return {acceleration_(random_), acceleration_(random_), acceleration_(random_)}; }

private:
	std::mt19937 random_{7};
	std::normal_distribution<double> rate_{0, 1.4e-3}, acceleration_{0, 0.063};
};

void rest(OrientationFilter &filter, const glm::dquat &orientation, double seconds, const glm::dvec3 &bias = glm::dvec3(0))
{
	Noise noise;
	for (double t = 0; t < seconds; t += period) filter.update(bias + noise.rate(), weight(orientation) + noise.acceleration(), period);
}

} // namespace

TEST(LowPass, IsTheBilinearButterworthInDirectForm)
{
	const double tau = 0.3, c = std::tan(period / (std::sqrt(2.0) * tau)), d = c * c + std::sqrt(2.0) * c + 1;
	const double b0 = c * c / d, a1 = 2 * (c * c - 1) / d, a2 = (1 - std::sqrt(2.0) * c + c * c) / d;
	LowPass<1> lowPass;
	double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
	for (int i = 0; i < 3000; ++i) {
		const double x = std::sin(0.01 * i) + (i % 7);
		const double y = b0 * (x + 2 * x1 + x2) - a1 * y1 - a2 * y2;
		EXPECT_NEAR(lowPass.step({x}, {tau, period})[0], y, 1e-9);
		x2 = x1, x1 = x, y2 = y1, y1 = y;
	}
}

TEST(LowPass, DoesNotJumpWhenItsTimeConstantChanges)
{
	LowPass<1> lowPass;
	lowPass.settle({5});
	for (const double tau : {0.05, 10.0, 0.1, 100.0}) EXPECT_NEAR(lowPass.step({5}, {tau, period})[0], 5, 1e-12);
}

TEST(OrientationFilter, FindsUpWithinHalfASecondHoweverItLies)
{
	for (const auto &axis : {glm::dvec3(1, 0, 0), glm::dvec3(-0.6, 0.8, 0)}) {
		for (const double tilt : {0.0, 30.0, 90.0, 150.0, 180.0}) {
			const glm::dquat truth = rotationOf(axis * (tilt * degree));
			OrientationFilter filter(period);
			rest(filter, truth, 0.5);
			EXPECT_LT(inclinationError(filter.orientation(), truth), 0.1) << tilt;
		}
	}
}

TEST(OrientationFilter, ConstantRateIsExact)
{
	OrientationFilter filter(period);
	const glm::dvec3 rate(0, 200 * degree, 0);
	glm::dquat truth = level;
	const glm::dvec3 up(0, gravity, 0); // turns about the vertical, which is the sensor's y
	for (int i = 0; i < 60'000; ++i) filter.update(rate, up, period);
	OrientationFilter still(period);
	still.update(glm::dvec3(0), up, period);
	truth = still.orientation() * rotationOf(rate * 60.0);
	EXPECT_LT(angleBetween(toXr(filter.orientation()), toXr(truth)) / degree, 0.05);
	EXPECT_LT(glm::length(filter.bias()) / degree, 1e-3);
}

TEST(OrientationFilter, FindsTheBiasAtRest)
{
	const glm::dvec3 bias(-0.0412516, 0.0256156, 0.0005428); // a real DK1's, uncalibrated
	OrientationFilter filter(period);
	rest(filter, rotationOf({0.3, -0.4, 0}), 6, bias);
	EXPECT_TRUE(filter.state().resting);
	EXPECT_LT(glm::length(filter.bias() - bias) / degree, 0.03);
	rest(filter, rotationOf({0.3, -0.4, 0}), 20, bias);
	EXPECT_LT(glm::length(filter.bias() - bias) / degree, 0.01);
	EXPECT_LT(inclinationError(filter.orientation(), rotationOf({0.3, -0.4, 0})), 0.1);
}

TEST(OrientationFilter, TheUnknownBiasHasLeftNoTiltASecondAfterTheFirstRest)
{
	const glm::dquat lying = rotationOf({0.3, -0.4, 0});
	OrientationFilter filter(period);
	rest(filter, lying, 3, glm::dvec3(1.5, -1, 0.5) * degree); // at rest from about 1.5 s on
	EXPECT_LT(inclinationError(filter.orientation(), lying), 0.03);
}

TEST(OrientationFilter, SlowTurningIsNotTakenForBiasOnceTheBiasIsKnown)
{
	OrientationFilter filter(period);
	rest(filter, level, 5);
	for (int i = 0; i < 20'000; ++i) filter.update({0, 0, 10 * degree}, weight(level), period);
	EXPECT_LT(glm::length(filter.bias()) / degree, 0.1);
	EXPECT_FALSE(filter.state().resting);
}

TEST(OrientationFilter, ALargeBiasIsFoundInMotionToo)
{
	OrientationFilter filter(period);
	const glm::dvec3 bias(2 * degree, -1 * degree, 0);
	Noise noise;
	glm::dquat truth = level;
	for (int i = 0; i < 120'000; ++i) {
		const double t = i * period;
		const glm::dvec3 rate(0.8 * std::sin(2.1 * t), 0.9 * std::cos(1.3 * t), 0.5 * std::sin(0.7 * t));
		truth = glm::normalize(truth * rotationOf(rate * period));
		const glm::dvec3 swing(1.5 * std::sin(5 * t), 1.5 * std::cos(4 * t), 0);
		filter.update(rate + bias + noise.rate(), weight(truth) + swing + noise.acceleration(), period);
	}
	EXPECT_FALSE(filter.state().rested);
	EXPECT_LT(glm::length(filter.bias() - bias) / degree, 0.8);
	EXPECT_LT(inclinationError(filter.orientation(), truth), 3.0);
}

TEST(OrientationFilter, WalkingDoesNotTiltTheWorld)
{
	OrientationFilter filter(period);
	rest(filter, level, 10);
	Noise noise;
	double worst = 0;
	for (int i = 0; i < 30'000; ++i) { // 2 s of speeding up at 0.5 m/s^2, 2 s of slowing down, steps at 2 Hz
		const double t = i * period, sustained = std::fmod(t, 4) < 2 ? 0.5 : -0.5;
		const glm::dvec3 walking(sustained, 0, 2 * std::sin(12.6 * t));
		filter.update(noise.rate(), weight(level) + walking + noise.acceleration(), period);
		worst = std::max(worst, inclinationError(filter.orientation(), level));
	}
	EXPECT_LT(worst, 0.6);
}

TEST(OrientationFilter, NonsenseNeitherStaysNorSpreads)
{
	OrientationFilter filter(period);
	rest(filter, level, 3);
	const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
	for (int i = 0; i < 50; ++i) {
		filter.update({nan, 0, 0}, weight(level), period);
		filter.update({0, infinity, 0}, weight(level), period);
		filter.update({0, 0, 0}, {nan, nan, nan}, period);
		filter.update({0, 0, 0}, {0, 0, infinity}, period);
		filter.update({0, 0, 0}, {0, 0, 0}, period);
		filter.update({0, 0, 0}, weight(level), nan);
		filter.update({0, 0, 0}, weight(level), -period);
		filter.update({0, 0, 0}, weight(level), 0);
	}
	EXPECT_LT(inclinationError(filter.orientation(), level), 0.2);
	EXPECT_TRUE(std::isfinite(filter.bias().x));
}

TEST(OrientationFilter, NonsenseFromTheFirstSampleOn)
{
	OrientationFilter filter(period);
	const double nan = std::nan("");
	for (int i = 0; i < 100; ++i) filter.update(glm::dvec3(nan), glm::dvec3(nan), period);
	EXPECT_FALSE(filter.state().settled);
	const glm::dquat truth = rotationOf({0.7, 0, 0});
	rest(filter, truth, 1);
	EXPECT_LT(inclinationError(filter.orientation(), truth), 0.1);
}

TEST(OrientationFilter, AfterAGapUpIsFoundAtOnceAndHeadingStands)
{
	OrientationFilter filter(period);
	const glm::dquat before = rotationOf({0, 0, 0.8}), tilted = before * rotationOf({0.9, 0, 0});
	rest(filter, level, 5);
	for (int i = 0; i < 1000; ++i) filter.update({0, 0, 0.8}, weight(level), period);
	filter.update({0, 0, 0}, weight(tilted), 3.0); // three seconds are missing, in which the head was tilted
	rest(filter, tilted, 0.5);
	EXPECT_LT(inclinationError(filter.orientation(), tilted), 0.2);
	const glm::dvec3 right = filter.orientation() * glm::dvec3(1, 0, 0); // the tilt's axis: its direction is the heading
	EXPECT_NEAR(std::atan2(right.y, right.x), 0.8, 0.02);
}

TEST(OrientationFilter, RecoversFromSaturation)
{
	OrientationFilter filter(period);
	rest(filter, level, 5);
	glm::dquat truth = level;
	for (int i = 0; i < 100; ++i) { // turns at 50 rad/s, of which the gyroscope shows 34.9
		truth = glm::normalize(truth * rotationOf({50 * period, 0, 0}));
		filter.update({34.9, 0, 0}, weight(truth), period);
	}
	EXPECT_GT(inclinationError(filter.orientation(), truth), 20);
	rest(filter, truth, 4);
	EXPECT_LT(inclinationError(filter.orientation(), truth), 1.0);
	EXPECT_LT(glm::length(filter.bias()) / degree, 0.2);
}
