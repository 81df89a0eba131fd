// xrSyncActions and what it makes of devices that the application plays itself (XR_EXT_conformance_automation).
#include "runtime/motion/spaces.h"
#include "tests/openxr/headless_session.h"

namespace arift
{
namespace
{

struct Actions : testing::Test, HeadlessApplication {
	Actions() : HeadlessApplication({"XR_EXT_conformance_automation", "XR_EXT_active_action_set_priority"})
	{
		EXPECT_EQ(application.begin(session), XR_SUCCESS);
		application.states();
	}
	XrActionSet actionSet(const char *name, uint32_t priority = 0) const
	{
		XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "", "", priority};
		std::snprintf(info.actionSetName, sizeof info.actionSetName, "%s", name);
		std::snprintf(info.localizedActionSetName, sizeof info.localizedActionSetName, "%s", name);
		XrActionSet made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateActionSet>("xrCreateActionSet")(application.instance, &info, &made), XR_SUCCESS);
		return made;
	}
	XrAction action(XrActionSet set, const char *name, XrActionType type) const
	{
		const XrPath hands[] = {left, right};
		XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "", type, 2, hands, ""};
		std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
		std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "%s", name);
		XrAction made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateAction>("xrCreateAction")(set, &info, &made), XR_SUCCESS);
		return made;
	}
	void suggest(const std::vector<XrActionSuggestedBinding> &bindings) const
	{
		const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, profile,
														uint32_t(bindings.size()), bindings.data()};
		EXPECT_EQ(get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(application.instance, &info),
				  XR_SUCCESS);
	}
	void attach(const std::vector<XrActionSet> &sets) const
	{
		const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, uint32_t(sets.size()), sets.data()};
		EXPECT_EQ(get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(session, &info), XR_SUCCESS);
	}
	XrResult sync(const std::vector<XrActiveActionSet> &active, const void *next = nullptr) const
	{
		const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, next, uint32_t(active.size()), active.data()};
		return get<PFN_xrSyncActions>("xrSyncActions")(session, &info);
	}
	XrActionStateBoolean boolean(XrAction action, XrPath subaction = XR_NULL_PATH) const
	{
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, subaction};
		XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
		EXPECT_EQ(get<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean")(session, &info, &state), XR_SUCCESS);
		return state;
	}
	void setActive(XrPath user, bool isActive) const
	{
		const auto set = get<PFN_xrSetInputDeviceActiveEXT>("xrSetInputDeviceActiveEXT");
		EXPECT_EQ(set(session, profile, user, isActive ? XR_TRUE : XR_FALSE), XR_SUCCESS);
	}
	void press(XrPath user, XrPath source, bool isPressed) const
	{
		const auto set = get<PFN_xrSetInputDeviceStateBoolEXT>("xrSetInputDeviceStateBoolEXT");
		EXPECT_EQ(set(session, user, source, isPressed ? XR_TRUE : XR_FALSE), XR_SUCCESS);
	}
	XrPath currentProfile(XrPath user) const
	{
		XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE};
		EXPECT_EQ(get<PFN_xrGetCurrentInteractionProfile>("xrGetCurrentInteractionProfile")(session, user, &state), XR_SUCCESS);
		return state.interactionProfile;
	}

	const XrPath left = application.path("/user/hand/left"), right = application.path("/user/hand/right");
	const XrPath profile = application.path("/interaction_profiles/valve/index_controller");
	const XrPath leftA = application.path("/user/hand/left/input/a/click"), rightA = application.path("/user/hand/right/input/a/click");
	const XrPath leftTrigger = application.path("/user/hand/left/input/trigger/value");
	const XrPath leftStick = application.path("/user/hand/left/input/thumbstick");
};

TEST_F(Actions, ADevicesProfileIsToldWhenItComesAndGoes)
{
	const XrActionSet set = actionSet("game");
	const XrAction grab = action(set, "grab", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest({{grab, leftA}});
	attach({set});
	setActive(left, true);
	EXPECT_EQ(currentProfile(left), XrPath(XR_NULL_PATH)) << "before xrSyncActions nothing changes";
	XrEventDataBuffer event;
	for (const bool isThere : {true, false}) {
		setActive(left, isThere);
		ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
		EXPECT_EQ(currentProfile(left), isThere ? profile : XrPath(XR_NULL_PATH));
		ASSERT_EQ(application.poll(event), XR_SUCCESS);
		EXPECT_EQ(event.type, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);
		EXPECT_EQ(boolean(grab).isActive, isThere ? XrBool32(XR_TRUE) : XrBool32(XR_FALSE));
		ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
		EXPECT_EQ(application.poll(event), XR_EVENT_UNAVAILABLE);
	}
}

TEST_F(Actions, StatesChangeWithTheSynchronizationAlone)
{
	const XrActionSet set = actionSet("game");
	const XrAction grab = action(set, "grab", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest({{grab, leftA}, {grab, rightA}});
	attach({set});
	setActive(left, true);
	setActive(right, true);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	press(left, leftA, true);
	EXPECT_FALSE(boolean(grab).currentState);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	const XrActionStateBoolean both = boolean(grab), ofLeft = boolean(grab, left), ofRight = boolean(grab, right);
	EXPECT_TRUE(both.currentState && both.changedSinceLastSync && both.lastChangeTime > 0);
	EXPECT_TRUE(ofLeft.currentState && ofLeft.changedSinceLastSync);
	EXPECT_TRUE(ofRight.isActive && !ofRight.currentState && !ofRight.changedSinceLastSync);
	ASSERT_EQ(sync({{set, right}}), XR_SUCCESS);
	EXPECT_FALSE(boolean(grab, left).isActive) << "only the right hand is active";
	EXPECT_FALSE(boolean(grab).currentState);
	ASSERT_EQ(sync({}), XR_SUCCESS);
	EXPECT_FALSE(boolean(grab, right).isActive);
}

TEST_F(Actions, TheHigherPriorityHasASource)
{
	const XrActionSet low = actionSet("low", 1), high = actionSet("high", 2);
	const XrAction below = action(low, "below", XR_ACTION_TYPE_BOOLEAN_INPUT), other = action(low, "other", XR_ACTION_TYPE_BOOLEAN_INPUT);
	const XrAction above = action(high, "above", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest({{below, leftA}, {other, rightA}, {above, leftA}});
	attach({low, high});
	setActive(left, true);
	setActive(right, true);
	ASSERT_EQ(sync({{low, XR_NULL_PATH}, {high, XR_NULL_PATH}}), XR_SUCCESS);
	EXPECT_TRUE(boolean(above).isActive);
	EXPECT_FALSE(boolean(below).isActive);
	EXPECT_TRUE(boolean(other).isActive) << "nobody else wants its source";
	ASSERT_EQ(sync({{low, XR_NULL_PATH}}), XR_SUCCESS);
	EXPECT_TRUE(boolean(below).isActive);
	const XrActiveActionSetPriorityEXT override{low, 3};
	const XrActiveActionSetPrioritiesEXT priorities{XR_TYPE_ACTIVE_ACTION_SET_PRIORITIES_EXT, nullptr, 1, &override};
	ASSERT_EQ(sync({{low, XR_NULL_PATH}, {high, XR_NULL_PATH}}, &priorities), XR_SUCCESS);
	EXPECT_TRUE(boolean(below).isActive);
	EXPECT_FALSE(boolean(above).isActive);
}

TEST_F(Actions, NumbersAndVectorsAndPoses)
{
	const XrActionSet set = actionSet("game");
	const XrAction pull = action(set, "pull", XR_ACTION_TYPE_FLOAT_INPUT), fire = action(set, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT);
	const XrAction move = action(set, "move", XR_ACTION_TYPE_VECTOR2F_INPUT), turn = action(set, "turn", XR_ACTION_TYPE_FLOAT_INPUT);
	const XrAction hand = action(set, "hand", XR_ACTION_TYPE_POSE_INPUT);
	const XrPath grip = application.path("/user/hand/left/input/grip/pose");
	suggest({{pull, leftTrigger},
			 {fire, leftTrigger},
			 {move, leftStick},
			 {turn, application.path("/user/hand/left/input/thumbstick/x")},
			 {hand, grip}});
	attach({set});
	setActive(left, true);
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL, {identityOrientation, {1, 0, 0}});
	const auto setFloat = get<PFN_xrSetInputDeviceStateFloatEXT>("xrSetInputDeviceStateFloatEXT");
	ASSERT_EQ(setFloat(session, left, leftTrigger, 0.75f), XR_SUCCESS);
	ASSERT_EQ(get<PFN_xrSetInputDeviceStateVector2fEXT>("xrSetInputDeviceStateVector2fEXT")(session, left, leftStick, {0.25f, -0.5f}),
			  XR_SUCCESS);
	ASSERT_EQ(
		get<PFN_xrSetInputDeviceLocationEXT>("xrSetInputDeviceLocationEXT")(session, left, grip, local, {identityOrientation, {0, 0, -1}}),
		XR_SUCCESS);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pull, left};
	XrActionStateFloat number{XR_TYPE_ACTION_STATE_FLOAT};
	ASSERT_EQ(get<PFN_xrGetActionStateFloat>("xrGetActionStateFloat")(session, &info, &number), XR_SUCCESS);
	EXPECT_EQ(number.currentState, 0.75f);
	EXPECT_TRUE(boolean(fire).currentState);
	info.action = turn;
	ASSERT_EQ(get<PFN_xrGetActionStateFloat>("xrGetActionStateFloat")(session, &info, &number), XR_SUCCESS);
	EXPECT_EQ(number.currentState, 0.25f) << "of the vector";
	info.action = move;
	XrActionStateVector2f vector{XR_TYPE_ACTION_STATE_VECTOR2F};
	ASSERT_EQ(get<PFN_xrGetActionStateVector2f>("xrGetActionStateVector2f")(session, &info, &vector), XR_SUCCESS);
	EXPECT_EQ(vector.currentState.y, -0.5f);

	const XrActionSpaceCreateInfo spaceInfo{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, hand, left, {identityOrientation, {0, 2, 0}}};
	XrSpace space = XR_NULL_HANDLE;
	ASSERT_EQ(get<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &spaceInfo, &space), XR_SUCCESS);
	XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
	const auto locate = get<PFN_xrLocateSpace>("xrLocateSpace");
	ASSERT_EQ(locate(space, application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL), realTime(), &location), XR_SUCCESS);
	EXPECT_EQ(location.locationFlags, 15u);
	EXPECT_EQ(location.pose.position.x, 1);
	EXPECT_EQ(location.pose.position.y, 2);
	EXPECT_EQ(location.pose.position.z, -1);
	setActive(left, false);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	ASSERT_EQ(locate(space, local, realTime(), &location), XR_SUCCESS);
	EXPECT_EQ(location.locationFlags, 0u);
}

TEST_F(Actions, ADeviceIsSomewhereUntilItIsPlaced)
{
	const XrActionSet set = actionSet("game");
	const XrAction grip = action(set, "grip", XR_ACTION_TYPE_POSE_INPUT), surface = action(set, "surface", XR_ACTION_TYPE_POSE_INPUT);
	suggest({{grip, application.path("/user/hand/left/input/grip/pose")},
			 {surface, application.path("/user/hand/left/input/grip_surface/pose")}});
	attach({set});
	setActive(left, true);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	XrSpace spaces[2]{};
	for (int i = 0; i < 2; ++i) {
		const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, i ? surface : grip, left, identityPose};
		ASSERT_EQ(get<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &info, &spaces[i]), XR_SUCCESS);
	}
	XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
	ASSERT_EQ(get<PFN_xrLocateSpace>("xrLocateSpace")(spaces[1], spaces[0], realTime(), &location), XR_SUCCESS);
	EXPECT_EQ(location.locationFlags, 15u);
	EXPECT_NEAR(rotate(location.pose.orientation, {0, 1, 0}).z, -0.7071f, 1e-4f) << "the back of the hand leans forward";
	EXPECT_NEAR(length(location.pose.position), 0, 1e-6f);
}

TEST_F(Actions, ASpaceOfBothHandsStaysWithTheOneItBeganWith)
{
	const XrActionSet set = actionSet("game");
	const XrAction grip = action(set, "grip", XR_ACTION_TYPE_POSE_INPUT);
	suggest({{grip, application.path("/user/hand/left/input/grip/pose")}, {grip, application.path("/user/hand/right/input/grip/pose")}});
	attach({set});
	const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, grip, XR_NULL_PATH, identityPose};
	XrSpace space = XR_NULL_HANDLE;
	ASSERT_EQ(get<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &info, &space), XR_SUCCESS);
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const auto whereWith = [&](bool leftThere, bool rightThere) {
		setActive(left, leftThere);
		setActive(right, rightThere);
		EXPECT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
		XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
		EXPECT_EQ(get<PFN_xrLocateSpace>("xrLocateSpace")(space, local, realTime(), &location), XR_SUCCESS);
		return location.locationFlags ? location.pose.position.x : 0;
	};
	EXPECT_GT(whereWith(false, true), 0) << "the right hand";
	EXPECT_GT(whereWith(true, true), 0);
	EXPECT_EQ(whereWith(true, false), 0) << "nowhere";
	EXPECT_GT(whereWith(true, true), 0);
}

TEST_F(Actions, WhatIsBoundHasANameForPeople)
{
	const XrActionSet set = actionSet("game");
	const XrAction grab = action(set, "grab", XR_ACTION_TYPE_BOOLEAN_INPUT);
	suggest({{grab, application.path("/user/hand/left/input/a")}});
	attach({set});
	setActive(left, true);
	ASSERT_EQ(sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
	const XrBoundSourcesForActionEnumerateInfo which{XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO, nullptr, grab};
	uint32_t count = 0;
	XrPath source = XR_NULL_PATH;
	ASSERT_EQ(get<PFN_xrEnumerateBoundSourcesForAction>("xrEnumerateBoundSourcesForAction")(session, &which, 1, &count, &source),
			  XR_SUCCESS);
	ASSERT_EQ(count, 1u);
	EXPECT_EQ(source, leftA) << "the component that was left out";
	const XrInputSourceLocalizedNameGetInfo info{XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO, nullptr, source, 7};
	char name[128]{};
	ASSERT_EQ(get<PFN_xrGetInputSourceLocalizedName>("xrGetInputSourceLocalizedName")(session, &info, 128, &count, name), XR_SUCCESS);
	EXPECT_STREQ(name, "Left Hand Valve Index Controller A Click");
	XrInputSourceLocalizedNameGetInfo other = info;
	other.sourcePath = application.path("/nobody/input/a/click");
	EXPECT_EQ(get<PFN_xrGetInputSourceLocalizedName>("xrGetInputSourceLocalizedName")(session, &other, 128, &count, name),
			  XR_ERROR_PATH_UNSUPPORTED);
}

} // namespace
} // namespace arift
