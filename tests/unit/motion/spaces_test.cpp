#include "runtime/motion/spaces.h"
#include <gtest/gtest.h>

using namespace arift;

namespace
{

ipc::ViewTable standing()
{
	ipc::ViewTable views{};
	views.pivotInHead = NeckModel{}.pivotInHead;
	views.floorBelowLocal = 1.6f;
	return views;
}

HeadMotion looking(const XrQuaternionf &orientation, const XrVector3f &rate = {0, 0, 0})
{
	return {Found::exact, {second, orientation, rate, {0, 0, 0}}};
}

void expectNear(const XrVector3f &a, const XrVector3f &b, double tolerance = 1e-5)
{
	EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " " << b.z;
}

} // namespace

TEST(Spaces, FloorAndStageLieBelowLocal)
{
	const ipc::ViewTable views = standing();
	expectNear(localInOrigin(views).position, {0, 0, 0});
	expectNear(localFloorInOrigin(views).position, {0, -1.6f, 0});
	expectNear(stageInOrigin(views).position, {0, -1.6f, 0});
}

TEST(Spaces, RecentringTakesHeadingOnlyAndLeavesFloorAndStageWhereTheyAre)
{
	const XrQuaternionf heading = rotationAbout({0, 1, 0}, 1.2);
	const HeadMotion head = looking(heading * rotationAbout({1, 0, 0}, -0.7));
	const ipc::ViewTable before = standing(), after = recentred(before, head);
	EXPECT_EQ(after.recenterCount, before.recenterCount + 1);
	EXPECT_LT(angleBetween(after.localInOrigin.orientation, heading), 1e-6);
	EXPECT_NEAR(after.localInOrigin.position.y, 0, 1e-6);
	EXPECT_NEAR(localFloorInOrigin(after).position.y, -1.6, 1e-6);
	expectNear(stageInOrigin(after).position, stageInOrigin(before).position);

	const FrameMotion level = relativeTo({localInOrigin(after)}, viewSpaceInOrigin(after, looking(heading)));
	expectNear(level.pose.position, {0, 0, 0});
	EXPECT_LT(angleBetween(level.pose.orientation, identityOrientation), 1e-6);
}

TEST(Spaces, ViewVelocityIsTheDerivativeOfItsPose)
{
	const ipc::ViewTable views = standing();
	const XrQuaternionf orientation = rotationAbout({0.3f, 0.8f, -0.5f}, 1.1);
	const XrVector3f rate{1.5f, -2, 0.7f};
	const double step = 1e-3;
	const auto after = [&](double t) {
		const glm::dquat q = toGlm(orientation) * rotationOf(toGlm(rate) * t);
		return viewSpaceInOrigin(views, looking(toXr(q), rate));
	};
	const FrameMotion now = after(0);
	expectNear(now.linearVelocity, (after(step).pose.position - after(-step).pose.position) * float(0.5 / step), 1e-3);
	expectNear(now.angularVelocity, rotate(orientation, rate), 1e-5);
	EXPECT_GT(length(now.linearVelocity), 0.1);
}

TEST(Spaces, CarriedAndRelativeFramesMoveAsTheirPosesDo)
{
	const XrPosef offset{rotationAbout({1, 2, 3}, 0.4), {0.2f, -0.1f, -1.5f}};
	const auto base = [](double t) {
		return FrameMotion{{rotationAbout({0, 1, 0}, 0.8 * t), {float(0.3 * t), 0, 1}}, {0.3f, 0, 0}, {0, 0.8f, 0}};
	};
	const auto frame = [&](double t) {
		const FrameMotion parent{{rotationAbout({1, 0, 0}, -1.1 * t), {0, float(t), 2}}, {0, 1, 0}, {-1.1f, 0, 0}};
		return carried(parent, offset);
	};
	const double t = 0.6, step = 1e-3;
	const FrameMotion seen = relativeTo(base(t), frame(t));
	const FrameMotion later = relativeTo(base(t + step), frame(t + step)), earlier = relativeTo(base(t - step), frame(t - step));
	expectNear(seen.linearVelocity, (later.pose.position - earlier.pose.position) * float(0.5 / step), 2e-3);
	const glm::dquat turned = toGlm(later.pose.orientation) * glm::conjugate(toGlm(earlier.pose.orientation));
	const double sign = turned.w < 0 ? -1 : 1;
	expectNear(seen.angularVelocity, toXr(glm::dvec3(turned.x, turned.y, turned.z) * (sign / step)), 2e-3);
}
