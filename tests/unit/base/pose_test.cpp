#include "runtime/base/pose.h"
#include <gtest/gtest.h>

using namespace arift;

TEST(Pose, ComposesAndInverts)
{
	const XrPosef head{rotationAbout({0, 1, 0}, M_PI / 2), {1, 2, 3}}; // looks along -x
	const XrVector3f ahead = head * XrVector3f{0, 0, -1};
	EXPECT_NEAR(ahead.x, 0, 1e-6);
	EXPECT_NEAR(ahead.y, 2, 1e-6);
	EXPECT_NEAR(ahead.z, 3, 1e-6);
	const XrPosef same = head * inverse(head);
	EXPECT_NEAR(length(same.position), 0, 1e-6);
	EXPECT_NEAR(angleBetween(same.orientation, identityOrientation), 0, 1e-6);
}

TEST(Pose, HeadingKeepsOnlyTheTurnAboutTheVertical)
{
	const XrQuaternionf q = rotationAbout({0, 1, 0}, 0.7) * rotationAbout({1, 0, 0}, 0.4);
	EXPECT_NEAR(angleBetween(headingOf(q), rotationAbout({0, 1, 0}, 0.7)), 0, 1e-6);
}

TEST(Pose, RejectsWhatIsNoPose)
{
	EXPECT_TRUE(isValidPose(identityPose));
	EXPECT_FALSE(isValidPose({{0, 0, 0, 0}, {0, 0, 0}}));
	EXPECT_FALSE(isValidPose({{0, 0, 0, 1.02f}, {0, 0, 0}}));
	EXPECT_FALSE(isValidPose({{0, 0, 0, 1}, {NAN, 0, 0}}));
}
