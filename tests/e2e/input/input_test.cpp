// Devices of input, from their nodes to applications and back.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include "tests/fakes/evdev/fake_input_device.h"
#include "tests/openxr/application.h"
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

namespace arift::e2e
{
namespace
{

using fake::FakeInputDevice;
using fake::InputModel;

constexpr const char *resting = "[compositor]\ntarget = \"offscreen\"\n[synthetic]\nmotion = \"rest\"\n";

struct InputService : PrivateService {
	explicit InputService(const std::string &input)
		: PrivateService(resting + ("[input]\n" + input), {}, "service_with_fake_input"), folders(tree().root())
	{
		::setenv("XDG_RUNTIME_DIR", (tree().root() / "runtime").c_str(), 1); // for the application that this process is
	}
	/// What the status says of the first device.
	nlohmann::json device() { return status()["input"].at(0); }

	const fake::InputFolders folders;
};

/// A headless application with one action of each kind that these tests need.
struct Player : Application {
	/// `next`: of XrSessionCreateInfo.
	explicit Player(const void *next = nullptr) : Application({"XR_MND_headless", "XR_EXTX_overlay"}), played(session(next))
	{
		EXPECT_EQ(begin(played), XR_SUCCESS);
		states();
		const XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
		EXPECT_EQ(get<PFN_xrCreateActionSet>("xrCreateActionSet")(instance, &info, &set), XR_SUCCESS);
		select = action("select", XR_ACTION_TYPE_BOOLEAN_INPUT);
		pull = action("pull", XR_ACTION_TYPE_FLOAT_INPUT);
		shake = action("shake", XR_ACTION_TYPE_VIBRATION_OUTPUT);
		suggest("/interaction_profiles/khr/simple_controller", {{select, path("/user/hand/right/input/select/click")}});
		suggest("/interaction_profiles/microsoft/xbox_controller",
				{{pull, path("/user/gamepad/input/trigger_left/value")}, {shake, path("/user/gamepad/output/haptic_right")}});
		const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
		EXPECT_EQ(get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(played, &attach), XR_SUCCESS);
	}
	XrAction action(const char *name, XrActionType type) const
	{
		XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "", type, 0, nullptr, ""};
		std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
		std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "%s", name);
		XrAction made = XR_NULL_HANDLE;
		EXPECT_EQ(get<PFN_xrCreateAction>("xrCreateAction")(set, &info, &made), XR_SUCCESS);
		return made;
	}
	void suggest(const char *profile, const std::vector<XrActionSuggestedBinding> &bindings) const
	{
		const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, path(profile),
														uint32_t(bindings.size()), bindings.data()};
		EXPECT_EQ(get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(instance, &info), XR_SUCCESS);
	}
	XrActionStateBoolean selected() const
	{
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, select, XR_NULL_PATH};
		XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
		EXPECT_EQ(get<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean")(played, &info, &state), XR_SUCCESS);
		return state;
	}
	XrActionStateFloat pulled() const
	{
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pull, XR_NULL_PATH};
		XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
		EXPECT_EQ(get<PFN_xrGetActionStateFloat>("xrGetActionStateFloat")(played, &info, &state), XR_SUCCESS);
		return state;
	}
	/// Synchronizes as an application does in every frame, until it is as wanted; false where it is not within ten seconds.
	template <typename Wanted> bool soon(Wanted wanted) const
	{
		const XrActiveActionSet active{set, XR_NULL_PATH};
		const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
		for (const XrTime end = realTime() + 10 * second; realTime() < end; std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
			EXPECT_EQ(get<PFN_xrSyncActions>("xrSyncActions")(played, &info), XR_SUCCESS);
			if (wanted()) return true;
		}
		return false;
	}
	/// Whether an event of this type comes within ten seconds; those before it are dropped.
	bool hears(XrStructureType type, XrEventDataBuffer *heard = nullptr) const
	{
		XrEventDataBuffer event;
		return soon([&] {
			while (poll(event) == XR_SUCCESS) {
				if (heard) *heard = event;
				if (event.type == type) return true;
			}
			return false;
		});
	}

	const XrSession played;
	XrActionSet set = XR_NULL_HANDLE;
	XrAction select = XR_NULL_HANDLE, pull = XR_NULL_HANDLE, shake = XR_NULL_HANDLE;
};

} // namespace

TEST(Input, NothingIsReadUnlessItIsSwitchedOn)
{
	InputService service("simple_controller = \"right\"\n");
	const FakeInputDevice keyboard(service.folders, "event4", InputModel::keyboard());
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["input"].size() == 1; }));
	const nlohmann::json device = service.device();
	EXPECT_EQ(device["name"], "Test Keyboard");
	EXPECT_EQ(device["kind"], "keyboard");
	EXPECT_EQ(device["on"], false);
	EXPECT_EQ(device["problem"], "");
	EXPECT_FALSE(keyboard.isOpened()) << "it was listed without being opened";
	const std::string text = runArift(service.tree(), {"status"}).output;
	EXPECT_NE(text.find("Test Keyboard (keyboard, event4): off\n"), std::string::npos) << text;
}

TEST(Input, WhatMayNotBeReadIsSaidAndIsReadAsSoonAsItMay)
{
	InputService service("devices = [\"Test *\"]\nsimple_controller = \"right\"\n");
	FakeInputDevice keyboard(service.folders, "event0", InputModel::keyboard(), 0);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["input"].size() == 1; }));
	EXPECT_EQ(service.device()["on"], true);
	EXPECT_EQ(service.device()["problem"], "Permission denied");
	const std::string text = runArift(service.tree(), {"status"}).output;
	EXPECT_NE(text.find("on, but cannot be read: Permission denied"), std::string::npos) << text;
	keyboard.setPermissions(0400);
	keyboard.waitForReader();
	EXPECT_EQ(service.device()["problem"], "");
}

TEST(Input, KeysAndGamepadsReachTheApplicationAndItsMotorsTurn)
{
	InputService service("devices = [\"Test *\"]\nsimple_controller = \"right\"\n");
	const Player player;
	EXPECT_TRUE(player.soon([&] { return !player.selected().isActive && !player.pulled().isActive; })) << "nothing is connected";
	FakeInputDevice keyboard(service.folders, "event0", InputModel::keyboard());
	keyboard.press(KEY_SPACE);
	EXPECT_TRUE(player.soon([&] { return player.selected().currentState != 0; }));
	EXPECT_TRUE(player.hears(XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED));
	keyboard.press(KEY_SPACE, false);
	EXPECT_TRUE(player.soon([&] { return player.selected().isActive && player.selected().currentState == 0; }));
	{
		FakeInputDevice pad(service.folders, "event1", InputModel::gamepad());
		pad.send({{EV_ABS, ABS_Z, 255}});
		EXPECT_TRUE(player.soon([&] { return player.pulled().currentState == 1; }));
		const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, player.shake, XR_NULL_PATH};
		const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, 60 * second, XR_FREQUENCY_UNSPECIFIED, 1};
		EXPECT_EQ(player.get<PFN_xrApplyHapticFeedback>("xrApplyHapticFeedback")(player.played, &info,
																				 reinterpret_cast<const XrHapticBaseHeader *>(&vibration)),
				  XR_SUCCESS);
		EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0, 0xffff, 30'000, true}));
		EXPECT_EQ(player.get<PFN_xrStopHapticFeedback>("xrStopHapticFeedback")(player.played, &info), XR_SUCCESS);
		EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0, 0, 0, false}));
	}
	EXPECT_TRUE(player.soon([&] { return !player.pulled().isActive; })) << "it was pulled out";
	EXPECT_TRUE(player.selected().isActive) << "the keyboard is still there";
	EXPECT_EQ(service.status()["input"].size(), 1u);
}

TEST(Input, AVibrationEndsWithTheApplicationThatAskedForIt)
{
	InputService service("devices = [\"Test *\"]\n");
	FakeInputDevice pad(service.folders, "event1", InputModel::gamepad());
	{
		const Player player;
		EXPECT_TRUE(player.soon([&] { return player.pulled().isActive != 0; }));
		const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, player.shake, XR_NULL_PATH};
		const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, 60 * second, XR_FREQUENCY_UNSPECIFIED, 0.5f};
		EXPECT_EQ(player.get<PFN_xrApplyHapticFeedback>("xrApplyHapticFeedback")(player.played, &info,
																				 reinterpret_cast<const XrHapticBaseHeader *>(&vibration)),
				  XR_SUCCESS);
		EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0, 0x8000, 30'000, true}));
	}
	EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0, 0, 0, false}));
}

TEST(Input, AnOverlayHasItBesideTheMainSessionAndHearsWhetherThatIsSeen)
{
	InputService service("devices = [\"Test *\"]\nsimple_controller = \"right\"\n");
	FakeInputDevice keyboard(service.folders, "event0", InputModel::keyboard());
	const XrSessionCreateInfoOverlayEXTX overlay{XR_TYPE_SESSION_CREATE_INFO_OVERLAY_EXTX, nullptr, 0, 1};
	const Player player(&overlay);
	ChildProcess cube = service.start("hologram_cube", {});
	ASSERT_TRUE(eventually(service, [](const auto &status) {
		return std::ranges::any_of(status["clients"], [](const auto &client) { return client["shown"] > 2; });
	})) << cube.output();
	XrEventDataBuffer event;
	ASSERT_TRUE(player.hears(XR_TYPE_EVENT_DATA_MAIN_SESSION_VISIBILITY_CHANGED_EXTX, &event));
	EXPECT_TRUE(reinterpret_cast<const XrEventDataMainSessionVisibilityChangedEXTX &>(event).visible);
	keyboard.press(KEY_SPACE);
	EXPECT_TRUE(player.soon([&] { return player.selected().currentState != 0; }));
	cube.stop();
	ASSERT_TRUE(player.hears(XR_TYPE_EVENT_DATA_MAIN_SESSION_VISIBILITY_CHANGED_EXTX, &event));
	EXPECT_FALSE(reinterpret_cast<const XrEventDataMainSessionVisibilityChangedEXTX &>(event).visible);
}

TEST(Input, TheServicesOwnKeysRecentreAndShowTheCamerasAlone)
{
	InputService service("devices = [\"Test *\"]\n");
	FakeInputDevice keyboard(service.folders, "event0", InputModel::keyboard());
	const Player player;
	keyboard.press(KEY_SCROLLLOCK);
	EXPECT_TRUE(player.hears(XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING));
	EXPECT_EQ(service.status()["passthrough"]["raw"], false);
	for (const bool raw : {true, false}) {
		keyboard.press(KEY_PAUSE);
		keyboard.press(KEY_PAUSE, false);
		EXPECT_TRUE(eventually(service, [&](const auto &status) { return status["passthrough"]["raw"] == raw; })) << raw;
	}
}

} // namespace arift::e2e
