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

TEST(Pose, RotationsAreExactAtEveryLength)
{
	const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 3));
	for (const double angle : {0.0, 1e-12, 1e-3, 0.5, 0.99999, 1.00001, 3.0, 20.0}) {
		const glm::dquat q = rotationOf(axis * angle);
		EXPECT_NEAR(q.w, std::cos(angle / 2), 1e-13) << angle;
		EXPECT_LT(glm::length(glm::dvec3(q.x, q.y, q.z) - axis * std::sin(angle / 2)), 1e-13) << angle;
	}
}

TEST(Pose, ProductsAndRotationsAreThoseOfTheirMatrices)
{
	const XrQuaternionf a = rotationAbout({0.3f, -0.9f, 0.2f}, 1.9), b = rotationAbout({-0.5f, 0.1f, 0.7f}, -2.4);
	const glm::dmat3 expected = glm::mat3_cast(toGlm(a)) * glm::mat3_cast(toGlm(b)), product = glm::mat3_cast(toGlm(a * b));
	const XrVector3f v{0.2f, -1.5f, 0.8f};
	EXPECT_LT(length(rotate(a * b, v) - toXr(expected * toGlm(v))), 1e-6f);
	for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(product[i] - expected[i]), 1e-6);
}

TEST(Pose, NormalizedIsOfUnitLengthFromEverywhere)
{
	for (const float scale : {1.0f, 0.9996f, 1.0004f, 0.3f, 70.0f}) {
		const XrQuaternionf q = normalized({0.1f * scale, -0.7f * scale, 0.5f * scale, 0.5f * scale});
		EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6) << scale;
		EXPECT_NEAR(q.y, -0.7, 1e-6) << scale;
	}
}
