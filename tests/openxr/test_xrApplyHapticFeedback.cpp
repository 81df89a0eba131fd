// xrApplyHapticFeedback and xrStopHapticFeedback: to the motors of the gamepad that the service reads.
#include "tests/openxr/controllerless.h"
#include <limits>

namespace arift
{
namespace
{

struct Haptics : Controllerless {
	Haptics()
	{
		const std::vector<XrPath> both{gamepad, right};
		shake = action("shake", XR_ACTION_TYPE_VIBRATION_OUTPUT, both);
		click = action("click", XR_ACTION_TYPE_BOOLEAN_INPUT);
		suggest(xbox, {{shake, "/user/gamepad/output/haptic_left"}, {click, "/user/gamepad/input/a/click"}});
		suggest(simple, {{shake, "/user/hand/right/output/haptic"}});
		attach();
	}
	XrResult apply(XrPath subaction, float amplitude, XrDuration duration) const
	{
		const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, shake, subaction};
		const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, duration, XR_FREQUENCY_UNSPECIFIED, amplitude};
		return get<PFN_xrApplyHapticFeedback>("xrApplyHapticFeedback")(session, &info,
																	   reinterpret_cast<const XrHapticBaseHeader *>(&vibration));
	}
	XrResult stop(XrAction action, XrPath subaction) const
	{
		const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, action, subaction};
		return get<PFN_xrStopHapticFeedback>("xrStopHapticFeedback")(session, &info);
	}
	ipc::Vibrate told(size_t count)
	{
		const auto record = service.waitFor([&](const FakeService::Record &now) { return now.vibrations.size() >= count; });
		return record.vibrations.size() >= count ? record.vibrations[count - 1] : ipc::Vibrate{};
	}

	const XrPath gamepad = application.path("/user/gamepad"), right = application.path("/user/hand/right");
	XrAction shake = XR_NULL_HANDLE, click = XR_NULL_HANDLE;
};

TEST_F(Haptics, ReachTheMotorsOfWhatIsThere)
{
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(XR_NULL_PATH, 1, second), XR_SUCCESS) << "nothing is connected, nothing is wrong";
	say(tableWithGamepad());
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(XR_NULL_PATH, 0.5f, second), XR_SUCCESS);
	const ipc::Vibrate left = told(1);
	EXPECT_EQ(left.motors, 1u) << "the output that is bound, and nothing was sent before";
	EXPECT_EQ(left.amplitude, 0.5f);
	EXPECT_EQ(left.duration, second);
	EXPECT_EQ(stop(shake, XR_NULL_PATH), XR_SUCCESS);
	EXPECT_EQ(told(2).duration, 0);
	EXPECT_EQ(told(2).motors, 1u);

	ipc::InputTable table = tableWithGamepad();
	table.hands[1].isThere = 1;
	say(table);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(right, 1, second), XR_SUCCESS);
	EXPECT_EQ(told(3).motors, 3u) << "a hand without a controller is felt in the gamepad";
	EXPECT_EQ(apply(gamepad, 1, second), XR_SUCCESS);
	EXPECT_EQ(told(4).motors, 1u) << "of one of two devices alone";
}

TEST_F(Haptics, WhatIsOutOfRangeIsBroughtIntoIt)
{
	say(tableWithGamepad());
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(XR_NULL_PATH, 7, XR_MIN_HAPTIC_DURATION), XR_SUCCESS);
	EXPECT_EQ(told(1).amplitude, 1);
	EXPECT_EQ(told(1).duration, -1);
	EXPECT_EQ(apply(XR_NULL_PATH, std::numeric_limits<float>::quiet_NaN(), -100), XR_SUCCESS);
	EXPECT_EQ(told(2).amplitude, 0);
	EXPECT_EQ(told(2).duration, -1);
}

TEST_F(Haptics, AStopThatTheServiceHasNoRoomForIsToldLater)
{
	EXPECT_EQ(get<PFN_xrDestroySession>("xrDestroySession")(session), XR_SUCCESS);
	service.stopReadingFrames();
	session = application.session();
	EXPECT_EQ(application.begin(session), XR_SUCCESS);
	application.states();
	attach();
	say(tableWithGamepad());
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(XR_NULL_PATH, 1, second), XR_SUCCESS) << "lost, and nothing was waited for";
	EXPECT_EQ(stop(shake, XR_NULL_PATH), XR_SUCCESS);
	service.readFrames();
	service.waitFor([](const FakeService::Record &now) { return !now.relinquished.empty(); }); // there is room
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(told(1).duration, 0);
	EXPECT_EQ(told(1).motors, 1u);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(apply(XR_NULL_PATH, 0.5f, second), XR_SUCCESS);
	EXPECT_EQ(told(2).amplitude, 0.5f) << "once is enough";
}

TEST_F(Haptics, WrongUseHasItsResult)
{
	EXPECT_EQ(stop(click, XR_NULL_PATH), XR_ERROR_ACTION_TYPE_MISMATCH);
	EXPECT_EQ(stop(shake, application.path("/user/hand/left")), XR_ERROR_PATH_UNSUPPORTED);
	const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, shake, XR_NULL_PATH};
	EXPECT_EQ(get<PFN_xrApplyHapticFeedback>("xrApplyHapticFeedback")(session, &info, nullptr), XR_ERROR_VALIDATION_FAILURE);
}

TEST(HapticsWithoutFocus, GoNowhere)
{
	HeadlessApplication head;
	XrActionSetCreateInfo setInfo{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
	XrActionSet set = XR_NULL_HANDLE;
	ASSERT_EQ(head.get<PFN_xrCreateActionSet>("xrCreateActionSet")(head.application.instance, &setInfo, &set), XR_SUCCESS);
	XrActionCreateInfo actionInfo{XR_TYPE_ACTION_CREATE_INFO, nullptr, "shake", XR_ACTION_TYPE_VIBRATION_OUTPUT, 0, nullptr, "Shake"};
	XrAction shake = XR_NULL_HANDLE;
	ASSERT_EQ(head.get<PFN_xrCreateAction>("xrCreateAction")(set, &actionInfo, &shake), XR_SUCCESS);
	const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
	ASSERT_EQ(head.get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(head.session, &attach), XR_SUCCESS);
	const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, shake, XR_NULL_PATH};
	EXPECT_EQ(head.get<PFN_xrStopHapticFeedback>("xrStopHapticFeedback")(head.session, &info), XR_SESSION_NOT_FOCUSED)
		<< "it was not begun";
}

} // namespace
} // namespace arift
