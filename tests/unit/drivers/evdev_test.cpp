// Keyboards, mice and gamepads as the kernel offers them: listed without being opened, read when they are wanted, followed as they come and
// go.
#include "drivers/evdev/devices.h"
#include "drivers/evdev/gamepad.h"
#include "drivers/registry.h"
#include "tests/common/temporary_folder.h"
#include "tests/fakes/evdev/fake_input_device.h"
#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace arift::evdev
{
namespace
{

using fake::FakeInputDevice;
using fake::InputModel;

struct Evdev : testing::Test {
	const test::TemporaryFolder folder;
	const fake::InputFolders folders{folder.path()};
	const InputPlaces places{folders.devices, folders.sysfs};
	Devices devices{places, {"Test *"}};

	/// The next thing that any device says; the test fails where nobody does.
	InputReport next()
	{
		InputReport report;
		EXPECT_EQ(devices.read(report, realTime() + 10 * second), Outcome::ready);
		return report;
	}
	Outcome look()
	{
		InputReport report;
		return devices.read(report, realTime());
	}
};

TEST_F(Evdev, EveryDeviceIsListedWithWhatItIsAndWhetherItMayBeRead)
{
	const FakeInputDevice pad(folders, "event10", InputModel::gamepad()), mouse(folders, "event9", InputModel::mouse("A Mouse"));
	const FakeInputDevice keyboard(folders, "event2", InputModel::keyboard(), 0), lid(folders, "event0", InputModel{.name = "Lid Switch"});
	const auto all = describeNodes(places, {"Test K*", "A Mouse"});
	ASSERT_EQ(all.size(), 4u);
	const auto is = [&](size_t i, const char *node, const char *name, InputKind kind, bool isOn) {
		return all[i].node == node && all[i].name == name && all[i].kind == kind && all[i].isOn == isOn;
	};
	EXPECT_TRUE(is(0, "event0", "Lid Switch", InputKind::other, false));
	EXPECT_TRUE(is(1, "event2", "Test Keyboard", InputKind::keyboard, true));
	EXPECT_TRUE(is(2, "event9", "A Mouse", InputKind::mouse, true));
	EXPECT_TRUE(is(3, "event10", "Test Gamepad", InputKind::gamepad, false)) << "10 comes after 9";
	EXPECT_EQ(all[1].problem, "Permission denied");
	EXPECT_EQ(all[2].problem, "");
}

TEST_F(Evdev, WithoutAnyDeviceThereIsNothingWrong)
{
	EXPECT_EQ(look(), Outcome::timeout);
	EXPECT_TRUE(describeNodes({folder.path() / "nowhere", folder.path() / "nowhere"}, {"*"}).empty());
}

TEST_F(Evdev, KeysAndMovementsOfOneMomentComeTogether)
{
	FakeInputDevice keyboard(folders, "event0", InputModel::keyboard()), mouse(folders, "event1", InputModel::mouse());
	const InputReport first = next(), second = next();
	EXPECT_TRUE(first.isThere && second.isThere);
	EXPECT_EQ(first.kind, InputKind::keyboard);
	EXPECT_EQ(second.kind, InputKind::mouse);
	EXPECT_NE(first.device, second.device);
	keyboard.send({{EV_KEY, KEY_A, 1}, {EV_KEY, KEY_B, 1}});
	keyboard.send({{EV_KEY, KEY_A, 2}}); // repeated by the kernel: nothing new
	keyboard.send({{EV_KEY, KEY_A, 0}});
	const InputReport pressed = next(), repeated = next(), released = next();
	EXPECT_EQ(pressed.device, first.device);
	ASSERT_EQ(pressed.keys.size(), 2u);
	EXPECT_TRUE(pressed.keys[0].key == KEY_A && pressed.keys[0].isPressed && pressed.keys[1].key == KEY_B);
	EXPECT_TRUE(repeated.keys.empty());
	ASSERT_EQ(released.keys.size(), 1u);
	EXPECT_FALSE(released.keys[0].isPressed);
	mouse.send({{EV_REL, REL_X, 7}, {EV_REL, REL_Y, 4}});
	const InputReport moved = next();
	EXPECT_EQ(moved.device, second.device);
	EXPECT_EQ(moved.motion.x, 7);
	EXPECT_EQ(moved.motion.y, -4) << "up is positive";
}

TEST_F(Evdev, ADeviceThatIsNotWantedIsNotOpened)
{
	FakeInputDevice other(folders, "event0", InputModel::keyboard("Somebody's Keyboard")), ours(folders, "event1", InputModel::keyboard());
	next();
	EXPECT_EQ(look(), Outcome::timeout);
	EXPECT_TRUE(ours.isOpened() && !other.isOpened());
	ours.press(KEY_A);
	EXPECT_EQ(next().keys.size(), 1u);
}

TEST_F(Evdev, DevicesComeAndGoWhileTheyAreRead)
{
	EXPECT_EQ(look(), Outcome::timeout);
	uint32_t former = 0;
	for (int time = 0; time < 2; ++time) {
		{
			FakeInputDevice pad(folders, "event5", InputModel::gamepad());
			const InputReport come = next();
			EXPECT_TRUE(come.isThere && come.gamepad);
			EXPECT_NE(come.device, former) << "another one, though its node has the same name";
			former = come.device;
			pad.press(BTN_A);
			EXPECT_TRUE(next().gamepad->isPressed(GamepadButton::a));
			pad.setPermissions(0400); // no coming and no going
			EXPECT_EQ(look(), Outcome::timeout);
		}
		const InputReport gone = next();
		EXPECT_FALSE(gone.isThere);
		EXPECT_EQ(gone.device, former);
		EXPECT_EQ(look(), Outcome::timeout);
	}
}

TEST_F(Evdev, OneThatHasTakenTheNodeOfAnotherIsReadWhenThatIsGone)
{
	std::optional<FakeInputDevice> pad;
	pad.emplace(folders, "event5", InputModel::gamepad());
	const InputReport former = next();
	pad.reset();
	pad.emplace(folders, "event5", InputModel::gamepad()); // before anybody looked
	const InputReport gone = next(), come = next();
	EXPECT_TRUE(!gone.isThere && gone.device == former.device);
	EXPECT_TRUE(come.isThere && come.device != former.device);
}

TEST_F(Evdev, AFolderThatIsNotThereYetIsLookedForAgain)
{
	std::filesystem::remove_all(folders.devices);
	EXPECT_EQ(look(), Outcome::timeout);
	std::filesystem::create_directories(folders.devices);
	const FakeInputDevice keyboard(folders, "event0", InputModel::keyboard());
	EXPECT_TRUE(next().isThere);
}

TEST_F(Evdev, AnotherFolderInTheSamePlaceIsFollowedToo)
{
	EXPECT_EQ(look(), Outcome::timeout);
	std::filesystem::remove_all(folders.devices);
	std::filesystem::create_directories(folders.devices); // before anybody looked
	for (int time = 0; time < 2; ++time) EXPECT_EQ(look(), Outcome::timeout);
	const FakeInputDevice keyboard(folders, "event0", InputModel::keyboard());
	EXPECT_TRUE(next().isThere);
	std::filesystem::rename(folders.devices, folder.path() / "moved away");
	std::filesystem::create_directories(folders.devices);
	for (int time = 0; time < 3; ++time) look();
	const FakeInputDevice mouse(folders, "event1", InputModel::mouse());
	EXPECT_TRUE(next().isThere);
}

TEST_F(Evdev, WhatMayNotBeReadIsReadAsSoonAsItMay)
{
	const FakeInputDevice keyboard(folders, "event0", InputModel::keyboard(), 0);
	EXPECT_EQ(look(), Outcome::timeout);
	keyboard.setPermissions(0400);
	EXPECT_TRUE(next().isThere);
}

TEST_F(Evdev, WhatWasMissedIsAskedFor)
{
	FakeInputDevice keyboard(folders, "event0", InputModel::keyboard());
	next();
	keyboard.press(KEY_A);
	next();
	keyboard.overrun({{EV_KEY, KEY_A, 0}, {EV_KEY, KEY_B, 1}});
	const InputReport report = next();
	ASSERT_EQ(report.keys.size(), 2u) << "a key must not seem to be held for ever";
	EXPECT_TRUE(report.keys[0].key == KEY_A && !report.keys[0].isPressed);
	EXPECT_TRUE(report.keys[1].key == KEY_B && report.keys[1].isPressed);
}

TEST_F(Evdev, AWaitIsEndedByWake)
{
	std::jthread waker([this] { devices.wake(); });
	InputReport report;
	const XrTime begin = realTime();
	EXPECT_EQ(devices.read(report, begin + 60 * second), Outcome::timeout);
	EXPECT_LT(realTime() - begin, 30 * second);
}

TEST_F(Evdev, MotorsAreToldHowStrongAndHowLong)
{
	FakeInputDevice pad(folders, "event0", InputModel::gamepad());
	const uint32_t device = next().device;
	pad.waitForReader();
	devices.rumble(device, {.strong = 1, .weak = 0.5f, .duration = 250 * millisecond});
	EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0xffff, 0x8000, 250, true}));
	devices.rumble(device, {.strong = 0.25f, .weak = 0, .duration = 3600 * second});
	EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0x4000, 0, 0x7fff, true})) << "the same effect, as long as the kernel can";
	devices.rumble(device, {});
	EXPECT_EQ(pad.nextPlayed(), (FakeInputDevice::Played{0, 0, 0, false}));
	devices.rumble(device + 1, {.strong = 1, .weak = 1, .duration = second}); // nobody's
}

TEST_F(Evdev, OneThatMayOnlyBeReadHasNoMotors)
{
	FakeInputDevice pad(folders, "event0", InputModel::gamepad(), 0400);
	EXPECT_TRUE(next().isThere);
}

// ---- what a gamepad says

struct Closer {
	void operator()(libevdev *device) const { libevdev_free(device); }
};

/// A gamepad that is nowhere, with these axes.
std::unique_ptr<libevdev, Closer> padWith(const std::vector<InputModel::Axis> &axes, int vendor = 0x045e)
{
	std::unique_ptr<libevdev, Closer> pad(libevdev_new());
	libevdev_set_id_vendor(pad.get(), vendor);
	for (const auto &[code, minimum, maximum, flat, value] : axes) {
		const input_absinfo info{.value = value, .minimum = minimum, .maximum = maximum, .fuzz = 0, .flat = flat, .resolution = 0};
		libevdev_enable_event_code(pad.get(), EV_ABS, unsigned(code), &info);
	}
	for (unsigned key = BTN_GAMEPAD; key <= BTN_THUMBR; ++key) libevdev_enable_event_code(pad.get(), EV_KEY, key, nullptr);
	for (unsigned key = BTN_DPAD_UP; key <= BTN_DPAD_RIGHT; ++key) libevdev_enable_event_code(pad.get(), EV_KEY, key, nullptr);
	return pad;
}

TEST(Gamepad, AxesAreFlatAtRestAndReachTheirEnds)
{
	const input_absinfo stick{.value = 0, .minimum = -100, .maximum = 100, .fuzz = 0, .flat = 20, .resolution = 0};
	EXPECT_EQ(centredAxis(stick, 10), 0);
	EXPECT_EQ(centredAxis(stick, 20), 0);
	EXPECT_EQ(centredAxis(stick, -20), 0);
	EXPECT_FLOAT_EQ(centredAxis(stick, 60), 0.5f) << "the way left begins at the edge of the flat part";
	EXPECT_FLOAT_EQ(centredAxis(stick, 100), 1);
	EXPECT_FLOAT_EQ(centredAxis(stick, -100), -1);
	EXPECT_FLOAT_EQ(centredAxis(stick, -1000), -1);
	const input_absinfo bytes{.value = 0, .minimum = 0, .maximum = 254, .fuzz = 0, .flat = 0, .resolution = 0};
	EXPECT_EQ(centredAxis(bytes, 127), 0) << "the middle is not always 0";
	const input_absinfo trigger{.value = 0, .minimum = 0, .maximum = 255, .fuzz = 0, .flat = 55, .resolution = 0};
	EXPECT_EQ(pulledAxis(trigger, 55), 0);
	EXPECT_FLOAT_EQ(pulledAxis(trigger, 155), 0.5f);
	EXPECT_FLOAT_EQ(pulledAxis(trigger, 255), 1);
	const input_absinfo nothing{};
	EXPECT_EQ(centredAxis(nothing, 5), 0);
	EXPECT_EQ(pulledAxis(nothing, 5), 0);
}

TEST(Gamepad, SticksAndTriggersLieWhereTheKernelPutsThem)
{
	const auto usual = padWith({{ABS_X, -10, 10, 0, 10},
								{ABS_Y, -10, 10, 0, 10},
								{ABS_RX, -10, 10, 0, -10},
								{ABS_RY, -10, 10, 0, -10},
								{ABS_Z, 0, 10, 0, 5},
								{ABS_RZ, 0, 10, 0, 10}});
	const GamepadState state = gamepadStateOf(usual.get());
	EXPECT_EQ(state.thumbsticks[0].x, 1);
	EXPECT_EQ(state.thumbsticks[0].y, -1) << "the kernel's y goes down";
	EXPECT_EQ(state.thumbsticks[1].x, -1);
	EXPECT_EQ(state.thumbsticks[1].y, 1);
	EXPECT_FLOAT_EQ(state.triggers[0], 0.5f);
	EXPECT_EQ(state.triggers[1], 1);
	const auto other = padWith({{ABS_X, -10, 10, 0, 0}, {ABS_Y, -10, 10, 0, 0}, {ABS_Z, -10, 10, 0, 10}, {ABS_RZ, -10, 10, 0, -10}});
	libevdev_set_event_value(other.get(), EV_KEY, BTN_TL2, 1);
	const GamepadState without = gamepadStateOf(other.get());
	EXPECT_EQ(without.thumbsticks[1].x, 1);
	EXPECT_EQ(without.thumbsticks[1].y, 1);
	EXPECT_EQ(without.triggers[0], 1) << "a button";
	EXPECT_EQ(without.triggers[1], 0);
}

TEST(Gamepad, ButtonsGoByNameOrByPlace)
{
	const auto pressed = [](int vendor, unsigned code) {
		const auto pad = padWith({{ABS_HAT0X, -1, 1, 0, 0}, {ABS_HAT0Y, -1, 1, 0, 0}}, vendor);
		libevdev_set_event_value(pad.get(), EV_KEY, code, 1);
		return gamepadStateOf(pad.get()).buttons;
	};
	const auto bit = [](GamepadButton button) { return 1u << uint32_t(button); };
	using enum GamepadButton;
	EXPECT_EQ(pressed(0x045e, BTN_X), bit(x));
	EXPECT_EQ(pressed(0x054c, BTN_WEST), bit(x)) << "a square lies where X does";
	EXPECT_EQ(pressed(0x054c, BTN_NORTH), bit(y));
	EXPECT_EQ(pressed(0x045e, BTN_START), bit(menu));
	EXPECT_EQ(pressed(0x045e, BTN_SELECT), bit(view));
	EXPECT_EQ(pressed(0x045e, BTN_THUMBR), bit(thumbstickRight));
	EXPECT_EQ(pressed(0x045e, BTN_DPAD_UP), bit(dpadUp));
	const auto hat = padWith({{ABS_HAT0X, -1, 1, 0, -1}, {ABS_HAT0Y, -1, 1, 0, 1}});
	EXPECT_EQ(gamepadStateOf(hat.get()).buttons, bit(dpadLeft) | bit(dpadDown));
}

TEST(Keys, GoByTheirNameInLinux)
{
	EXPECT_EQ(keyNamed("KEY_SPACE"), std::optional<KeyCode>(KEY_SPACE));
	EXPECT_EQ(keyNamed("BTN_SOUTH"), std::optional<KeyCode>(BTN_SOUTH));
	EXPECT_EQ(keyNamed("space"), std::nullopt);
	EXPECT_EQ(keyNamed("REL_X"), std::nullopt);
}

} // namespace
} // namespace arift::evdev
