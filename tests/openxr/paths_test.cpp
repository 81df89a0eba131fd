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

TEST(InteractionProfiles, WhichAreThere)
{
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/khr/simple_controller", false));
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/valve/index_controller", false));
	EXPECT_FALSE(findInteractionProfile("/interaction_profiles/hp/mixed_reality_controller", false)) << "in the core since 1.1";
	EXPECT_TRUE(findInteractionProfile("/interaction_profiles/hp/mixed_reality_controller", true));
	EXPECT_FALSE(findInteractionProfile("/interaction_profiles/khr", true));
	EXPECT_FALSE(findInteractionProfile("/user/hand/left", true));
}

TEST(InteractionProfiles, WhatTheyHave)
{
	const InteractionProfile &touch = *findInteractionProfile("/interaction_profiles/oculus/touch_controller", false);
	EXPECT_TRUE(touch.has("/user/hand/left/input/x/click", false));
	EXPECT_FALSE(touch.has("/user/hand/right/input/x/click", false)) << "only the left one has an X";
	EXPECT_TRUE(touch.has("/user/hand/right/input/a/click", false));
	EXPECT_TRUE(touch.has("/user/hand/right/input/trigger/value", false));
	EXPECT_TRUE(touch.has("/user/hand/right/input/trigger", false)) << "the component may be left out";
	EXPECT_FALSE(touch.has("/user/hand/right/input/trig", false));
	for (const char *folder : {"/user/hand/right", "/user/hand/right/input", "/user/hand/right/output"})
		EXPECT_FALSE(touch.has(folder, true)) << folder << " is no input or output";
	EXPECT_FALSE(touch.has("/user/hand/right/input/trigger/click", false));
	EXPECT_TRUE(touch.has("/user/hand/left/output/haptic", false));
	EXPECT_FALSE(touch.has("/user/hand/left/input/output/haptic", false));
	EXPECT_FALSE(touch.has("/user/gamepad/input/a/click", false));
	EXPECT_FALSE(touch.has("/user/hand/left/input/grip_surface/pose", false));
	EXPECT_TRUE(touch.has("/user/hand/left/input/grip_surface/pose", true));
	const InteractionProfile &xbox = *findInteractionProfile("/interaction_profiles/microsoft/xbox_controller", true);
	EXPECT_TRUE(xbox.has("/user/gamepad/output/haptic_right_trigger", true));
	EXPECT_FALSE(xbox.has("/user/gamepad/input/grip_surface/pose", true));
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
