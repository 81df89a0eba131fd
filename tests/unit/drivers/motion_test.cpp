// Head motion: the derivatives are those of the pose, the neck stands still, recordings are followed.
#include "drivers/synthetic/motion.h"
#include "drivers/synthetic/recorded_motion.h"
#include "tests/unit/drivers/support.h"
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::synthetic;

namespace
{

constexpr glm::dvec3 neck{0, -0.075, 0.0805};

/// Angular velocity, angular acceleration and linear acceleration against differences of the poses around.
void expectDerivatives(const HeadMotion &motion, double from, double to, double tolerance)
{
	constexpr double h = 1e-4;
	for (double t = from; t < to; t += 0.0137) {
		const HeadState before = motion.at(t - h), here = motion.at(t), after = motion.at(t + h);
		glm::dquat turn = glm::conjugate(before.orientation) * after.orientation;
		if (turn.w < 0) turn = -turn;
		const glm::dvec3 velocity = glm::dvec3{turn.x, turn.y, turn.z} / h; // of the middle, in head axes up to second order
		ASSERT_LT(glm::length(velocity - here.angularVelocity), tolerance) << "t = " << t;
		const glm::dvec3 acceleration = (after.angularVelocity - before.angularVelocity) / (2 * h);
		ASSERT_LT(glm::length(acceleration - here.angularAcceleration), 10 * tolerance) << "t = " << t;
		const glm::dvec3 linear = (after.position - 2.0 * here.position + before.position) / (h * h);
		ASSERT_LT(glm::length(linear - here.acceleration), 10 * tolerance) << "t = " << t;
	}
}

Trajectory recorded(double length, double rate)
{
	const auto natural = makeNatural(9, 0, neck);
	Trajectory trajectory;
	for (double t = 0; t <= length; t += 1 / rate) {
		const HeadState head = natural->at(t + 5);
		trajectory.push_back({t, head.orientation, head.position});
	}
	return fromStart(trajectory);
}

} // namespace

TEST(Motion, DerivativesAreThoseOfThePose)
{
	expectDerivatives(*makeConstantRate({0.3, 3.5, -0.2}, 0, neck), -1, 2, 1e-4);
	expectDerivatives(*makeConstantRate({0, 3.5, 0}, 1, neck), 0.5, 2, 1e-3);
	for (const uint64_t seed : {1, 2, 3}) expectDerivatives(*makeNatural(seed, 0.5, neck), 0, 12, 1e-4);
	expectDerivatives(*makeRecorded(recorded(6, 200), 0.5), 0, 7, 3e-3);
}

TEST(Motion, TheNeckStandsStill)
{
	const auto natural = makeNatural(1, 0, neck);
	for (double t = 0; t < 20; t += 0.1) {
		const HeadState head = natural->at(t);
		EXPECT_LT(glm::length(head.position + head.orientation * neck - neck), 1e-12) << t;
	}
}

TEST(Motion, BeginsAtRestAfterTheDelay)
{
	for (const auto &motion :
		 {std::shared_ptr<HeadMotion>(makeNatural(1, 2, neck)), std::shared_ptr<HeadMotion>(makeConstantRate({0, 3, 0}, 2, neck))}) {
		EXPECT_EQ(motion->at(1.9).position, glm::dvec3(0));
		EXPECT_EQ(glm::length(motion->at(1.9).angularVelocity), 0);
		EXPECT_GT(glm::length(motion->at(2.5).angularVelocity), 0);
	}
	EXPECT_NEAR(makeConstantRate({0, 3, 0}, 2, neck)->at(3).angularVelocity.y, 3, 1e-12);
	EXPECT_NEAR(makeConstantRate({0, 3, 0}, 0, neck)->at(0).angularVelocity.y, 3, 1e-12) << "without a delay it turns already";
}

TEST(Motion, NaturalMotionIsAPersons)
{
	double fastest = 0, farthest = 0, sum = 0;
	const auto natural = makeNatural(1, 0, neck);
	int count = 0;
	for (double t = 2; t < 120; t += 0.01, count++) {
		const HeadState head = natural->at(t);
		const double speed = glm::length(head.angularVelocity) * 180 / M_PI;
		fastest = std::max(fastest, speed);
		sum += speed;
		farthest = std::max(farthest, angleBetween(toXr(head.orientation), identityOrientation) * 180 / M_PI);
	}
	EXPECT_GT(fastest, 50);
	EXPECT_LT(fastest, 120);
	EXPECT_GT(sum / count, 10);
	EXPECT_GT(farthest, 30);
	EXPECT_LT(farthest, 70);
	const HeadState same = makeNatural(1, 0, neck)->at(7), other = makeNatural(2, 0, neck)->at(7);
	EXPECT_EQ(same.orientation, natural->at(7).orientation);
	EXPECT_NE(other.orientation, natural->at(7).orientation);
}

TEST(Motion, AnImuFeelsGravityTurningAndItsLever)
{
	const HeadState still;
	const ImuTruth rest = imuTruth(still, identityPose);
	EXPECT_NEAR(rest.specificForce.y, 9.80665, 1e-12);
	const HeadState turning = makeConstantRate({0, 2, 0}, 0, {0, 0, 0})->at(0);
	const ImuTruth lever = imuTruth(turning, {identityOrientation, {0, 0, -0.1f}}); // a tenth of a metre before the pivot
	EXPECT_NEAR(lever.specificForce.z, 2 * 2 * 0.1, 1e-7) << "towards the pivot";
	EXPECT_NEAR(lever.angularVelocity.y, 2, 1e-12);
	const XrPosef rolled{rotationAbout({0, 0, 1}, M_PI / 2), {0, 0, 0}};
	EXPECT_NEAR(imuTruth(still, rolled).specificForce.x, 9.80665, 1e-5);
}

TEST(Motion, ARecordingIsFollowed)
{
	const Trajectory trajectory = recorded(6, 200);
	const auto motion = makeRecorded(trajectory, 1);
	for (const TimedPose &pose : trajectory) {
		const HeadState head = motion->at(pose.seconds + 1);
		EXPECT_LT(angleBetween(toXr(head.orientation), toXr(pose.orientation)), 0.004) << pose.seconds;
		EXPECT_LT(glm::length(head.position - pose.position), 0.001) << pose.seconds;
	}
	EXPECT_LT(glm::length(motion->at(-5).position), 0.001);
	EXPECT_LT(glm::length(motion->at(100).angularVelocity), 1e-9) << "at rest behind its end";
}

TEST(Trajectory, InterpolatesAndBridgesGaps)
{
	const Trajectory trajectory{{0, {1, 0, 0, 0}, {0, 0, 0}}, {1, rotationOf({0, 1, 0}), {2, 0, 0}}};
	const TimedPose middle = interpolate(trajectory, 0.25);
	EXPECT_NEAR(middle.position.x, 0.5, 1e-12);
	EXPECT_NEAR(angleBetween(toXr(middle.orientation), rotationAbout({0, 1, 0}, 0.25)), 0, 1e-6);
	EXPECT_EQ(interpolate(trajectory, -1).position.x, 0);
	EXPECT_EQ(interpolate(trajectory, 5).position.x, 2);
}

TEST(Trajectory, BeginsAtTheOriginLookingAhead)
{
	const Trajectory moved =
		fromStart({{0, rotationOf({0, 2, 0}) * rotationOf({0.3, 0, 0}), {1, 2, 3}}, {1, rotationOf({0, 2.5, 0}), {1, 2, 2}}});
	EXPECT_NEAR(glm::length(moved[0].position), 0, 1e-12);
	EXPECT_NEAR(angleBetween(toXr(moved[0].orientation), rotationAbout({1, 0, 0}, 0.3)), 0, 1e-6) << "its pitch stays";
	EXPECT_NEAR(angleBetween(toXr(moved[1].orientation), rotationAbout({0, 1, 0}, 0.5)), 0, 1e-6);
	EXPECT_NEAR(glm::length(moved[1].position - glm::conjugate(rotationOf({0, 2, 0})) * glm::dvec3{0, 0, -1}), 0, 1e-6);
}
