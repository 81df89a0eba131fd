// What applications see of people without controllers: the service's devices as khr/simple_controller and microsoft/xbox_controller.
#include "tests/openxr/controllerless.h"

namespace arift
{
namespace
{

using ServiceDevices = Controllerless;

TEST_F(ServiceDevices, AHandIsASimpleControllerAsLongAsItIsThere)
{
	const XrAction select = action("select", XR_ACTION_TYPE_BOOLEAN_INPUT), menu = action("menu", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest(simple, {{select, "/user/hand/right/input/select/click"}, {menu, "/user/hand/right/input/menu/click"}});
	attach();
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(boolean(select).isActive) << "nothing is connected: bound but inactive";
	EXPECT_EQ(profileOf("/user/hand/right"), XrPath(XR_NULL_PATH));
	EXPECT_FALSE(hearsOfProfiles());

	ipc::InputTable table = tableWithRightHand();
	table.hands[1].select = 1;
	say(table);
	EXPECT_FALSE(boolean(select).isActive) << "states change with xrSyncActions alone";
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_TRUE(hearsOfProfiles());
	EXPECT_EQ(profileOf("/user/hand/right"), application.path(simple));
	EXPECT_TRUE(boolean(select).isActive && boolean(select).currentState && boolean(select).changedSinceLastSync);
	EXPECT_TRUE(boolean(menu).isActive && !boolean(menu).currentState);
	table.hands[1].select = 0;
	table.hands[1].menu = 1;
	say(table);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_TRUE(!boolean(select).currentState && boolean(select).changedSinceLastSync && boolean(menu).currentState);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(boolean(select).changedSinceLastSync);
	EXPECT_FALSE(hearsOfProfiles());

	say({});
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_TRUE(hearsOfProfiles());
	EXPECT_FALSE(boolean(menu).isActive);
	EXPECT_EQ(profileOf("/user/hand/right"), XrPath(XR_NULL_PATH));
}

TEST_F(ServiceDevices, WhatCouldNotBeReadIsNewsStillWhenItCan)
{
	const XrAction select = action("select", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest(simple, {{select, "/user/hand/right/input/select/click"}});
	attach();
	say({});
	ASSERT_EQ(sync(), XR_SUCCESS);
	// The page begins with its version. A page of the old values with the new version is one that cannot be read.
	using Page = ipc::Published<ipc::InputTable>;
	std::array<std::byte, sizeof(Page)> old{}, written{};
	void *const page = &service.client().input;
	std::memcpy(old.data(), page, sizeof(Page));
	say(tableWithRightHand());
	std::memcpy(written.data(), page, sizeof(Page));
	std::memcpy(old.data(), written.data(), sizeof(uint32_t));
	std::memcpy(page, old.data(), sizeof(Page));
	ASSERT_FALSE(service.client().input.read());
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(boolean(select).isActive);
	std::memcpy(page, written.data(), sizeof(Page));
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_TRUE(boolean(select).isActive);
}

TEST_F(ServiceDevices, AnApplicationThatSuggestedNothingForItHasNoSuchDevice)
{
	const XrAction select = action("select", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest(xbox, {{select, "/user/gamepad/input/a/click"}});
	attach();
	say(tableWithRightHand());
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(boolean(select).isActive);
	EXPECT_FALSE(hearsOfProfiles());
}

TEST_F(ServiceDevices, EveryPartOfAGamepadIsWhereItsProfileSays)
{
	const auto &names = gamepadButtonNames;
	EXPECT_STREQ(names[size_t(GamepadButton::view)], "view");
	EXPECT_STREQ(names[size_t(GamepadButton::b)], "b");
	EXPECT_STREQ(names[size_t(GamepadButton::dpadDown)], "dpad_down");
	EXPECT_STREQ(names[size_t(GamepadButton::shoulderLeft)], "shoulder_left");
	EXPECT_STREQ(names[size_t(GamepadButton::thumbstickRight)], "thumbstick_right");
	std::vector<XrAction> buttons;
	std::vector<std::string> sources;
	for (const char *name : names) {
		buttons.push_back(action((std::string("button_") + name).c_str(), XR_ACTION_TYPE_BOOLEAN_INPUT));
		sources.push_back(std::string("/user/gamepad/input/") + name + "/click");
	}
	const XrAction pull = action("pull", XR_ACTION_TYPE_FLOAT_INPUT), push = action("push", XR_ACTION_TYPE_FLOAT_INPUT);
	const XrAction walk = action("walk", XR_ACTION_TYPE_VECTOR2F_INPUT), look = action("look", XR_ACTION_TYPE_VECTOR2F_INPUT);
	const XrAction lookUp = action("look_up", XR_ACTION_TYPE_FLOAT_INPUT);
	std::vector<Suggested> all{{pull, "/user/gamepad/input/trigger_left/value"},
							   {push, "/user/gamepad/input/trigger_right/value"},
							   {walk, "/user/gamepad/input/thumbstick_left"},
							   {look, "/user/gamepad/input/thumbstick_right"},
							   {lookUp, "/user/gamepad/input/thumbstick_right/y"}};
	for (size_t i = 0; i < buttons.size(); ++i) all.push_back({buttons[i], sources[i].c_str()});
	suggest(xbox, all);
	attach();
	for (size_t held = 0; held < buttons.size(); ++held) {
		ipc::InputTable table = tableWithGamepad();
		table.gamepad.set(GamepadButton(held), true);
		say(table);
		ASSERT_EQ(sync(), XR_SUCCESS);
		for (size_t i = 0; i < buttons.size(); ++i) EXPECT_EQ(boolean(buttons[i]).currentState != 0, i == held) << names[i];
	}
	EXPECT_EQ(profileOf("/user/gamepad"), application.path(xbox));
	ipc::InputTable table = tableWithGamepad();
	table.gamepad.triggers = {0.25f, 0.75f};
	table.gamepad.thumbsticks = {XrVector2f{0.1f, 0.2f}, XrVector2f{0.3f, 0.4f}};
	say(table);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_EQ(number(pull).currentState, 0.25f);
	EXPECT_EQ(number(push).currentState, 0.75f);
	EXPECT_EQ(vector(walk).currentState.x, 0.1f);
	EXPECT_EQ(vector(walk).currentState.y, 0.2f);
	EXPECT_EQ(vector(look).currentState.x, 0.3f);
	EXPECT_EQ(number(lookUp).currentState, 0.4f);
	say({});
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(number(pull).isActive);
}

struct PosesOfAHand : Controllerless {
	PosesOfAHand() : Controllerless({"XR_EXT_palm_pose"}) {}
	XrSpaceLocation locate(XrAction pose, XrSpace base) const
	{
		XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, pose, XR_NULL_PATH, identityPose};
		XrSpace space = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &info, &space), XR_SUCCESS);
		XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
		EXPECT_EQ(get<PFN_xrLocateSpace>("xrLocateSpace")(space, base, realTime(), &location), XR_SUCCESS);
		return location;
	}
};

TEST_F(PosesOfAHand, MoveWithTheHead)
{
	const XrAction aim = action("aim", XR_ACTION_TYPE_POSE_INPUT), grip = action("grip", XR_ACTION_TYPE_POSE_INPUT);
	const XrAction palm = action("palm", XR_ACTION_TYPE_POSE_INPUT), surface = action("surface", XR_ACTION_TYPE_POSE_INPUT);
	suggest(simple, {{aim, "/user/hand/right/input/aim/pose"},
					 {grip, "/user/hand/right/input/grip/pose"},
					 {palm, "/user/hand/right/input/palm_ext/pose"},
					 {surface, "/user/hand/right/input/grip_surface/pose"}});
	attach();
	const XrSpace view = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW);
	const XrQuaternionf head = rotationAbout({0, 1, 0}, 1.0);
	const XrTime now = realTime();
	for (XrTime time = now - 100 * millisecond; time <= now; time += millisecond) service.poses().push({time, head, {0, 0, 0}, {0, 0, 0}});
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_FALSE(isPoseActive(aim));
	EXPECT_EQ(locate(aim, view).locationFlags, 0u) << "nobody's hand is nowhere";

	ipc::InputTable table = tableWithRightHand();
	table.hands[1].aimInView = {rotationAbout({1, 0, 0}, 0.5), {0, 0, 0}};
	table.hands[1].gripInView = {table.hands[1].aimInView.orientation, {0.2f, -0.3f, -0.4f}};
	say(table);
	ASSERT_EQ(sync(), XR_SUCCESS);
	EXPECT_TRUE(isPoseActive(aim) && isPoseActive(grip));
	const XrSpaceLocation aimed = locate(aim, view), held = locate(grip, view), inPalm = locate(palm, view);
	EXPECT_NE(aimed.locationFlags & XR_SPACE_LOCATION_ORIENTATION_VALID_BIT, 0u);
	EXPECT_NEAR(angleBetween(aimed.pose.orientation, rotationAbout({1, 0, 0}, 0.5)), 0, 1e-3);
	EXPECT_NEAR(length(aimed.pose.position), 0, 1e-4);
	EXPECT_NEAR(held.pose.position.x, 0.2, 1e-4);
	EXPECT_NEAR(held.pose.position.z, -0.4, 1e-4);
	EXPECT_NEAR(angleBetween(inPalm.pose.orientation, held.pose.orientation), 0.7854, 1e-3) << "turned against the grip";
	EXPECT_NEAR(angleBetween(locate(surface, view).pose.orientation, inPalm.pose.orientation), 0, 1e-3);
	const XrSpaceLocation inRoom = locate(aim, application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL));
	EXPECT_NEAR(angleBetween(inRoom.pose.orientation, head * rotationAbout({1, 0, 0}, 0.5)), 0, 1e-3);
}

struct PlayedHand : Controllerless {
	PlayedHand() : Controllerless({"XR_EXT_conformance_automation"}) {}
};

TEST_F(PlayedHand, StaysAsItsApplicationPlaysIt)
{
	const XrAction select = action("select", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest(simple, {{select, "/user/hand/right/input/select/click"}});
	attach();
	const XrPath right = application.path("/user/hand/right");
	EXPECT_EQ(get<PFN_xrSetInputDeviceActiveEXT>("xrSetInputDeviceActiveEXT")(session, application.path(simple), right, XR_TRUE),
			  XR_SUCCESS);
	EXPECT_EQ(get<PFN_xrSetInputDeviceStateBoolEXT>("xrSetInputDeviceStateBoolEXT")(
				  session, right, application.path("/user/hand/right/input/select/click"), XR_TRUE),
			  XR_SUCCESS);
	for (const bool isThere : {true, false}) {
		say(isThere ? tableWithRightHand() : ipc::InputTable());
		ASSERT_EQ(sync(), XR_SUCCESS);
		EXPECT_TRUE(boolean(select).isActive && boolean(select).currentState);
	}
}

} // namespace
} // namespace arift
