#include "runtime/motion/view_poses.h"
#include <gtest/gtest.h>
#include <limits>

using namespace arift;

namespace
{

constexpr ipc::CameraTiming camera{.reference = 100 * second + 123, .period = 16'666'667, .delay = 22 * millisecond};
constexpr XrDuration latch = 25 * millisecond;

ipc::ViewTable table(float viewOffset)
{
	ipc::ViewTable views{};
	views.eyeInHead = {XrPosef{identityOrientation, {-0.032f, 0, 0}}, XrPosef{identityOrientation, {0.032f, 0, 0}}};
	views.cameraInHead = {XrPosef{rotationAbout({0, 1, 0}, 0.1), {-0.045f, 0.01f, -0.08f}},
						  XrPosef{identityOrientation, {0.045f, 0.01f, -0.08f}}};
	views.viewOffset = viewOffset;
	views.pivotInHead = NeckModel{}.pivotInHead;
	return views;
}

HeadMotion looking(double heading) { return {Found::exact, {second, rotationAbout({0, 1, 0}, heading), {0, 0, 0}, {0, 0, 0}}}; }

} // namespace

TEST(ExposureShown, IsTheNewestThatIsThereWhenTheCompositorTakesIt)
{
	const XrTime firstUse = camera.reference + camera.delay + latch;
	EXPECT_EQ(exposureShownAt(camera, firstUse, latch), camera.reference);
	EXPECT_EQ(exposureShownAt(camera, firstUse - 1, latch), camera.reference - camera.period);
	EXPECT_EQ(exposureShownAt(camera, firstUse + camera.period - 1, latch), camera.reference);
	EXPECT_EQ(exposureShownAt(camera, firstUse + 1000 * camera.period, latch), camera.reference + 1000 * camera.period);
	EXPECT_EQ(exposureShownAt(camera, firstUse - 50 * camera.period, latch), camera.reference - 50 * camera.period);
}

TEST(ExposureShown, WithoutCameraOrSenseItIsTheDisplayTime)
{
	constexpr XrTime last = std::numeric_limits<XrTime>::max(), first = std::numeric_limits<XrTime>::min();
	EXPECT_EQ(exposureShownAt({}, 5 * second, latch), 5 * second);
	EXPECT_EQ(exposureShownAt({.reference = 1, .period = -7, .delay = 0}, 5 * second, latch), 5 * second);
	EXPECT_EQ(exposureShownAt({.reference = 0, .period = millisecond, .delay = 3 * second}, 5 * second, latch), 5 * second);
	EXPECT_EQ(exposureShownAt({.reference = 0, .period = millisecond, .delay = -second}, 5 * second, 0), 5 * second);
	EXPECT_EQ(exposureShownAt({.reference = first, .period = last, .delay = first}, last, first), last);
	EXPECT_EQ(exposureShownAt({.reference = last, .period = last, .delay = last}, 5 * second, last), 5 * second);
}

TEST(ViewPose, OffsetZeroIsTheEyeAndOneTheCameraAtItsExposure)
{
	const ipc::ViewTable atEye = table(0), atCamera = table(1), between = table(0.25f);
	const XrPosef now = headInOrigin(atEye, looking(0.9)), then = headInOrigin(atEye, looking(0.6));
	for (uint32_t eye = 0; eye < 2; ++eye) {
		const XrPosef eyePose = now * atEye.eyeInHead[eye];
		const XrVector3f cameraThen = then * atEye.cameraInHead[eye].position;
		EXPECT_LT(length(viewInOrigin(atEye, eye, now, then).position - eyePose.position), 1e-6);
		EXPECT_LT(length(viewInOrigin(atCamera, eye, now, then).position - cameraThen), 1e-6);
		EXPECT_LT(length(viewInOrigin(between, eye, now, then).position - (eyePose.position * 0.75f + cameraThen * 0.25f)), 1e-6);
		for (const ipc::ViewTable &views : {atEye, atCamera, between}) {
			EXPECT_LT(angleBetween(viewInOrigin(views, eye, now, then).orientation, eyePose.orientation), 1e-6);
		}
	}
}

TEST(ViewPose, TheNeckCarriesTheHead)
{
	const XrPosef right = headInOrigin(table(0), looking(-1.5707963));
	EXPECT_LT(length(right.position - XrVector3f{0.0805f, 0, 0.0805f}), 1e-5); // the eyes swing about a neck 80.5 mm behind them
	EXPECT_LT(length(headInOrigin(table(0), looking(0)).position), 1e-7);
}
