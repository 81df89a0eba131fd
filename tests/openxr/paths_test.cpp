// Paths, names and interaction profiles.
#include "runtime/openxr/event_queue.h"
#include "runtime/openxr/interaction_profiles.h"
#include "runtime/openxr/paths.h"
#include <gtest/gtest.h>

namespace arift::openxr
{
namespace
{

TEST(Paths, WellFormed)
{
	for (const char *path : {"/user", "/user/hand/left/input/trigger/value", "/a.b/c-d/e_f/0", "/..a", "/.../a."}) {
		const bool onlyDots = std::string_view(path).starts_with("/...");
		EXPECT_EQ(isWellFormedPath(path), !onlyDots) << path;
	}
	for (const char *path : {"", "/", "user", "/user/", "//user", "/User", "/user hand", "/.", "/..", "/a/../b", "/a//b", "/\xc3\xa4"})
		EXPECT_FALSE(isWellFormedPath(path)) << path;
	EXPECT_TRUE(isWellFormedPath("/" + std::string(XR_MAX_PATH_LENGTH - 2, 'a')));
	EXPECT_FALSE(isWellFormedPath("/" + std::string(XR_MAX_PATH_LENGTH - 1, 'a'))) << "no room for the terminator";
	EXPECT_TRUE(isWellFormedName("grab-object_1.b"));
	EXPECT_FALSE(isWellFormedName("grab/object"));
	EXPECT_FALSE(isWellFormedName("Grab"));
}

TEST(Paths, AtomsAreOnePerText)
{
	PathTable table;
	const XrPath left = table.atom("/user/hand/left");
	EXPECT_NE(left, XrPath(XR_NULL_PATH));
	EXPECT_EQ(table.atom(std::string("/user/hand/left")), left);
	EXPECT_NE(table.atom("/user/hand/right"), left);
	EXPECT_EQ(table.text(left), "/user/hand/left");
	EXPECT_THROW(table.text(XR_NULL_PATH), Error);
	EXPECT_THROW(table.text(3), Error);
	EXPECT_THROW(table.atom("/User"), Error);
}

const Features features1_0, features1_1{true, {}};

Features with(std::initializer_list<Extension> extensions)
{
	Features features;
	for (const Extension extension : extensions) features.extensions.enable(extension);
	return features;
}

TEST(InteractionProfiles, WhichAreThere)
{
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/khr/simple_controller", features1_0));
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/valve/index_controller", features1_0));
	const char *hp = "/interaction_profiles/hp/mixed_reality_controller";
	EXPECT_FALSE(findInteractionProfile(hp, features1_0)) << "in the core since 1.1";
	EXPECT_TRUE(findInteractionProfile(hp, features1_1));
	EXPECT_TRUE(findInteractionProfile(hp, with({Extension::EXT_hp_mixed_reality_controller})));
	EXPECT_FALSE(findInteractionProfile("/interaction_profiles/ext/hand_interaction_ext", features1_1));
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/ext/hand_interaction_ext", with({Extension::EXT_hand_interaction})));
	EXPECT_FALSE(findInteractionProfile("/interaction_profiles/khr", features1_1));
	EXPECT_FALSE(findInteractionProfile("/user/hand/left", features1_1));
}

/// What a path means for an action of that type; empty where the profile has no such path.
std::string meaning(const InteractionProfile &profile, const char *path, const Features &features,
					XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT)
{
	const auto component = resolveSource(profile, path, type, features);
	return component ? component->path : "";
}

TEST(InteractionProfiles, WhatTheyHave)
{
	const InteractionProfile &touch = *findInteractionProfile("/interaction_profiles/oculus/touch_controller", features1_0);
	EXPECT_EQ(meaning(touch, "/user/hand/left/input/x/click", features1_0), "/input/x/click");
	EXPECT_EQ(meaning(touch, "/user/hand/right/input/x/click", features1_0), "") << "only the left one has an X";
	EXPECT_EQ(meaning(touch, "/user/hand/right/input/a/click", features1_0), "/input/a/click");
	EXPECT_EQ(meaning(touch, "/user/hand/right/input/trigger", features1_0), "/input/trigger/value") << "the component may be left out";
	EXPECT_EQ(meaning(touch, "/user/hand/right/input/trig", features1_0), "");
	for (const char *folder : {"/user/hand/right", "/user/hand/right/input", "/user/hand/right/output", "/user/hand/rightinput/a/click"})
		EXPECT_EQ(meaning(touch, folder, features1_1), "") << folder << " is no input or output";
	EXPECT_EQ(meaning(touch, "/user/hand/right/input/trigger/click", features1_0), "");
	EXPECT_EQ(meaning(touch, "/user/hand/left/output/haptic", features1_0), "/output/haptic");
	EXPECT_EQ(meaning(touch, "/user/hand/left/input/output/haptic", features1_0), "");
	EXPECT_EQ(meaning(touch, "/user/gamepad/input/a/click", features1_0), "");
	const InteractionProfile &index = *findInteractionProfile("/interaction_profiles/valve/index_controller", features1_0);
	EXPECT_EQ(meaning(index, "/user/hand/left/input/trigger", features1_0, XR_ACTION_TYPE_FLOAT_INPUT), "/input/trigger/value");
	EXPECT_EQ(meaning(index, "/user/hand/left/input/trigger", features1_0, XR_ACTION_TYPE_BOOLEAN_INPUT), "/input/trigger/click");
	EXPECT_EQ(meaning(index, "/user/hand/left/input/grip", features1_0, XR_ACTION_TYPE_POSE_INPUT), "/input/grip/pose");
}

TEST(InteractionProfiles, WhatVersionsAndExtensionsAddToThem)
{
	const InteractionProfile &touch = *findInteractionProfile("/interaction_profiles/oculus/touch_controller", features1_0);
	const auto expectOnlyWith = [&](const char *path, const Features &features) {
		EXPECT_EQ(meaning(touch, path, features1_0), "") << path;
		EXPECT_NE(meaning(touch, path, features), "") << path;
	};
	expectOnlyWith("/user/hand/left/input/grip_surface/pose", features1_1);
	expectOnlyWith("/user/hand/left/input/grip_surface/pose", with({Extension::KHR_maintenance1}));
	expectOnlyWith("/user/hand/left/input/trigger/proximity", features1_1);
	expectOnlyWith("/user/hand/left/input/trigger/proximity_fb", with({Extension::FB_touch_controller_proximity}));
	expectOnlyWith("/user/hand/left/input/palm_ext/pose", with({Extension::EXT_palm_pose}));
	expectOnlyWith("/user/hand/left/input/poke_ext/pose", with({Extension::EXT_hand_interaction}));
	expectOnlyWith("/user/hand/left/input/thumbstick/dpad_up", with({Extension::EXT_dpad_binding}));
	EXPECT_EQ(meaning(touch, "/user/hand/left/input/thumbstick/dpad_center", with({Extension::EXT_dpad_binding})), "");
	const InteractionProfile &xbox = *findInteractionProfile("/interaction_profiles/microsoft/xbox_controller", features1_1);
	EXPECT_EQ(meaning(xbox, "/user/gamepad/output/haptic_right_trigger", features1_1), "/output/haptic_right_trigger");
	EXPECT_EQ(meaning(xbox, "/user/gamepad/input/grip_surface/pose", features1_1), "");
}

TEST(TopLevelUserPaths, SomeComeWithExtensions)
{
	EXPECT_TRUE(isTopLevelUserPath("/user/gamepad", features1_0));
	EXPECT_FALSE(isTopLevelUserPath("/user/hand", features1_1));
	EXPECT_FALSE(isTopLevelUserPath("/user/hand_htc/left", features1_1));
	EXPECT_TRUE(isTopLevelUserPath("/user/hand_htc/left", with({Extension::HTC_hand_interaction})));
}

TEST(Events, LostOnesAreTold)
{
	EventQueue queue;
	XrEventDataBuffer event{};
	EXPECT_FALSE(queue.pop(event));
	for (size_t i = 0; i < EventQueue::limit + 3; ++i)
		queue.push(XrEventDataInstanceLossPending{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, XrTime(i)});
	ASSERT_TRUE(queue.pop(event));
	ASSERT_EQ(event.type, XR_TYPE_EVENT_DATA_EVENTS_LOST);
	EXPECT_EQ(reinterpret_cast<XrEventDataEventsLost &>(event).lostEventCount, 3u);
	ASSERT_TRUE(queue.pop(event));
	EXPECT_EQ(reinterpret_cast<XrEventDataInstanceLossPending &>(event).lossTime, 0);
}

} // namespace
} // namespace arift::openxr
