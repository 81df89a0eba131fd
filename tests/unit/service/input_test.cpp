// What keys, mice and gamepads mean, what motors are told over time, and the thread between devices and applications.
#include "runtime/base/error.h"
#include "runtime/base/toml_document.h"
#include "runtime/service/input_thread.h"
#include <algorithm>
#include <deque>
#include <gtest/gtest.h>
#include <limits>
#include <linux/input-event-codes.h>

namespace arift
{
namespace
{

constexpr size_t left = 0, right = 1;

InputSettings rightHand(Aim aim = Aim::head)
{
	InputSettings settings;
	settings.devices = {"*"};
	settings.hand = right;
	settings.aim = aim;
	return settings;
}
InputReport key(KeyCode code, bool isPressed, uint32_t device = 1, InputKind kind = InputKind::keyboard)
{
	return {.device = device, .kind = kind, .keys = {{code, isPressed}}, .gamepad = {}};
}
InputReport moved(float x, float y) { return {.device = 2, .kind = InputKind::mouse, .keys = {}, .motion = {x, y}, .gamepad = {}}; }
InputReport come(uint32_t device, InputKind kind = InputKind::keyboard)
{
	return {.device = device, .kind = kind, .keys = {}, .gamepad = {}};
}
InputReport gone(uint32_t device) { return {.device = device, .isThere = false, .keys = {}, .gamepad = {}}; }
InputReport pad(uint32_t device, const GamepadState &state)
{
	return {.device = device, .kind = InputKind::gamepad, .keys = {}, .gamepad = state};
}

} // namespace

TEST(InputMap, AHandIsThereAsLongAsAnyDeviceIs)
{
	InputMap map(rightHand());
	EXPECT_FALSE(map.table().hands[right].isThere);
	map.take(come(1));
	map.take(come(2));
	EXPECT_TRUE(map.table().hands[right].isThere);
	EXPECT_FALSE(map.table().hands[left].isThere);
	map.take(gone(1));
	EXPECT_TRUE(map.table().hands[right].isThere);
	map.take(gone(2));
	EXPECT_FALSE(map.table().hands[right].isThere);
	InputMap without((InputSettings()));
	without.take(come(1));
	EXPECT_FALSE(without.table().hands[right].isThere) << "only where the configuration wants it";
}

TEST(InputMap, SelectAndMenuAreHeldByAnyOfTheirKeysOnAnyDevice)
{
	InputMap map(rightHand());
	const auto &hand = map.table().hands[right];
	map.take(key(KEY_SPACE, true));
	EXPECT_TRUE(hand.select && !hand.menu);
	map.take(key(BTN_LEFT, true, 2, InputKind::mouse));
	map.take(key(KEY_SPACE, false));
	EXPECT_TRUE(hand.select) << "the mouse still holds it";
	map.take(gone(2));
	EXPECT_FALSE(hand.select) << "what is pulled out holds nothing";
	map.take(key(KEY_MENU, true));
	EXPECT_TRUE(hand.menu && !hand.select);
	map.take(key(KEY_A, true));
	EXPECT_FALSE(hand.select) << "a key of nothing";
}

TEST(InputMap, TheRayIsTheHeadsOrAMouseMovesItWithinWhatIsSeen)
{
	InputMap head(rightHand()), mouse(rightHand(Aim::mouse));
	for (InputMap *map : {&head, &mouse}) map->take(moved(100, 50));
	const XrVector3f ahead = rotate(head.table().hands[right].aimInView.orientation, {0, 0, -1});
	EXPECT_EQ(ahead.z, -1);
	const XrVector3f ray = rotate(mouse.table().hands[right].aimInView.orientation, {0, 0, -1});
	EXPECT_NEAR(std::atan2(ray.x, -ray.z), 10 * 0.0174533, 1e-4) << "10 degrees to the right";
	EXPECT_NEAR(std::asin(ray.y), 5 * 0.0174533, 1e-4) << "5 up";
	mouse.take(moved(1e6f, 0));
	const XrVector3f edge = rotate(mouse.table().hands[right].aimInView.orientation, {0, 0, -1});
	EXPECT_NEAR(std::atan2(edge.x, -edge.z), 40 * 0.0174533, 1e-4);
	mouse.take(key(KEY_SCROLLLOCK, true));
	EXPECT_EQ(rotate(mouse.table().hands[right].aimInView.orientation, {0, 0, -1}).z, -1) << "recentred as well";
	const XrVector3f grip = mouse.table().hands[right].gripInView.position;
	EXPECT_TRUE(grip.x > 0 && grip.y < 0 && grip.z < 0) << "below the right eye, in reach";
}

TEST(InputMap, TheServicesOwnKeysCountWhenTheyGoDown)
{
	InputMap map((InputSettings()));
	EXPECT_TRUE(map.take(key(KEY_SCROLLLOCK, true)).recenter);
	EXPECT_FALSE(map.take(key(KEY_SCROLLLOCK, false)).recenter);
	const Wishes raw = map.take(key(KEY_PAUSE, true));
	EXPECT_TRUE(raw.rawPassthrough && !raw.recenter);
	EXPECT_FALSE(map.take(come(1)).rawPassthrough) << "held is not pressed again";
}

TEST(InputMap, TheGamepadIsTheOneThatWasThereFirst)
{
	InputMap map((InputSettings()));
	EXPECT_FALSE(map.table().hasGamepad || map.gamepad());
	GamepadState older, newer;
	older.set(GamepadButton::a, true);
	newer.triggers = {0, 1};
	map.take(come(1));
	map.take(pad(2, older));
	map.take(pad(3, newer));
	EXPECT_EQ(map.gamepad(), 2u);
	EXPECT_TRUE(map.table().hasGamepad && map.table().gamepad.isPressed(GamepadButton::a));
	map.take(gone(2));
	EXPECT_EQ(map.gamepad(), 3u);
	EXPECT_EQ(map.table().gamepad.triggers[1], 1);
	map.take(gone(3));
	EXPECT_FALSE(map.table().hasGamepad);
	EXPECT_EQ(map.table().gamepad.triggers[1], 0);
}

TEST(Vibration, EachMotorGoesOnForItsOwnTime)
{
	Vibration vibration;
	EXPECT_EQ(vibration.at(0).duration, 0);
	vibration.ask(1, {.motors = 1, .amplitude = 0.5f, .duration = 100}, 1'000'000'000);
	const XrTime start = 1'000'000'000;
	EXPECT_EQ(vibration.at(start).duration, Vibration::shortest) << "a tenth of a microsecond is felt by nobody";
	vibration.ask(1, {.motors = 1, .amplitude = 0.5f, .duration = second}, start);
	vibration.ask(1, {.motors = 2, .amplitude = 1, .duration = 2 * second}, start);
	const Rumble both = vibration.at(start + second / 2), weak = vibration.at(start + second);
	EXPECT_TRUE(both.strong == 0.5f && both.weak == 1 && both.duration == second / 2);
	EXPECT_TRUE(weak.strong == 0 && weak.weak == 1 && weak.duration == second);
	vibration.ask(1, {.motors = 2, .amplitude = 0, .duration = 0}, start);
	EXPECT_TRUE(vibration.at(start).strong == 0.5f && vibration.at(start).weak == 0);
	vibration.ask(1, {.motors = 3, .amplitude = 1, .duration = std::numeric_limits<XrDuration>::max()}, start);
	EXPECT_EQ(vibration.at(start).duration, Vibration::longest) << "nobody's motor turns for ever";
	EXPECT_EQ(vibration.at(start + Vibration::longest).duration, 0);
}

TEST(Vibration, WhoMayNoLongerLosesItsOwnMotorsForGood)
{
	Vibration vibration;
	vibration.ask(1, {.motors = 1, .amplitude = 1, .duration = second}, 0);
	vibration.ask(2, {.motors = 2, .amplitude = 0.5f, .duration = second}, 0);
	vibration.keepThoseOf([](uint32_t session) { return session == 2; });
	vibration.keepThoseOf([](uint32_t) { return true; });
	EXPECT_TRUE(vibration.at(0).strong == 0 && vibration.at(0).weak == 0.5f);
}

namespace
{

/// Devices that say what a test puts in, and note what their motors are told.
struct PlayedDevices final : InputDevices {
	struct State {
		std::deque<InputReport> reports;
		std::vector<Rumble> rumbles;
		bool isWoken = false, isBroken = false;
	};
	explicit PlayedDevices(Guarded<State> &shared) : state(shared) {}
	Outcome read(InputReport &report, XrTime deadline) override
	{
		auto access = state.lock();
		const auto isThere = [](const State &now) { return now.isWoken || now.isBroken || !now.reports.empty(); };
		access.waitFor({}, std::chrono::nanoseconds(std::max<XrDuration>(deadline - realTime(), 0)), isThere);
		if (access->isBroken) throw std::runtime_error("the devices cannot be polled");
		access->isWoken = false;
		if (access->reports.empty()) return Outcome::timeout;
		report = access->reports.front();
		access->reports.pop_front();
		return Outcome::ready;
	}
	void rumble(uint32_t device, const Rumble &rumble) override
	{
		EXPECT_EQ(device, 7u);
		state.update([&](State &now) { now.rumbles.push_back(rumble); });
	}
	void wake() override
	{
		state.update([](State &now) { now.isWoken = true; });
	}
	Guarded<State> &state;
};

struct Deeds {
	ipc::InputTable told;
	int recentred = 0, toggled = 0;
	uint32_t focused = 1;                    ///< the session that has the focus
	std::function<void()> onceAsked = [] {}; ///< what happens just after the thread has asked who that is
};

struct Input : testing::Test {
	void say(const InputReport &report)
	{
		played.update([&](PlayedDevices::State &state) { state.reports.push_back(report); });
	}
	template <typename Ready> bool isDone(Ready ready) { return deeds.lock().waitFor({}, std::chrono::seconds(10), ready); }
	bool hasRumbled(size_t times)
	{
		return played.lock().waitFor({}, std::chrono::seconds(10), [&](const auto &state) { return state.rumbles.size() >= times; });
	}
	Rumble rumble(size_t i) { return played.lock()->rumbles.at(i); }

	Guarded<PlayedDevices::State> played;
	Guarded<Deeds> deeds;
	InputThread thread{rightHand(), std::make_unique<PlayedDevices>(played),
					   InputThread::Deeds{[this](const ipc::InputTable &table) { deeds.update([&](Deeds &now) { now.told = table; }); },
										  [this] { deeds.update([](Deeds &now) { ++now.recentred; }); },
										  [this] { deeds.update([](Deeds &now) { ++now.toggled; }); },
										  [this](uint32_t session) { return hasFocus(session); }}};

	bool hasFocus(uint32_t session)
	{
		bool is = false;
		std::function<void()> then = [] {};
		deeds.update([&](Deeds &now) {
			is = session == now.focused;
			then.swap(now.onceAsked);
		});
		then();
		return is;
	}
	void moveFocus(uint32_t session)
	{
		deeds.update([&](Deeds &now) { now.focused = session; });
		thread.focusMoved();
	}
	void bringGamepad()
	{
		say(pad(7, {}));
		ASSERT_TRUE(isDone([](const Deeds &now) { return now.told.hasGamepad != 0; }));
	}
};

} // namespace

TEST_F(Input, WhatDevicesSayIsToldAndDone)
{
	say(key(KEY_SPACE, true));
	EXPECT_TRUE(isDone([](const Deeds &now) { return now.told.hands[right].select != 0; }));
	say(key(KEY_SCROLLLOCK, true));
	EXPECT_TRUE(isDone([](const Deeds &now) { return now.recentred == 1; }));
	say(key(KEY_PAUSE, true));
	EXPECT_TRUE(isDone([](const Deeds &now) { return now.toggled == 1; }));
	EXPECT_EQ(deeds.lock()->recentred, 1);
}

TEST_F(Input, MotorsAreToldAtOnceAndAgainWhenOneOfThemEnds)
{
	bringGamepad();
	thread.vibrate(1, {.motors = 1, .amplitude = 1, .duration = 50 * millisecond});
	ASSERT_TRUE(hasRumbled(1));
	EXPECT_TRUE(rumble(0).strong == 1 && rumble(0).weak == 0);
	EXPECT_LE(rumble(0).duration, 50 * millisecond);
	ASSERT_TRUE(hasRumbled(2)) << "told to stop when its time is over";
	EXPECT_EQ(rumble(1).duration, 0);
	thread.vibrate(1, {.motors = 3, .amplitude = 1, .duration = 3600 * second});
	ASSERT_TRUE(hasRumbled(3));
	EXPECT_EQ(rumble(2).duration, 30 * second) << "should the service die, they stop";
}

TEST_F(Input, MotorsStopWithTheFocusAndDoNotBeginAgain)
{
	bringGamepad();
	thread.vibrate(1, {.motors = 3, .amplitude = 1, .duration = 3600 * second});
	ASSERT_TRUE(hasRumbled(1));
	moveFocus(2);
	ASSERT_TRUE(hasRumbled(2));
	EXPECT_EQ(rumble(1).duration, 0);
	moveFocus(1);
	thread.vibrate(1, {.motors = 2, .amplitude = 0.5f, .duration = second});
	ASSERT_TRUE(hasRumbled(3));
	EXPECT_TRUE(rumble(2).strong == 0 && rumble(2).weak == 0.5f);
}

TEST_F(Input, AFocusThatMovesWhileItIsAskedForStopsWhatHasJustBegun)
{
	bringGamepad();
	deeds.update([&](Deeds &now) { now.onceAsked = [this] { moveFocus(2); }; });
	thread.vibrate(1, {.motors = 1, .amplitude = 1, .duration = 3600 * second});
	ASSERT_TRUE(hasRumbled(2));
	EXPECT_EQ(rumble(0).strong, 1) << "the session had the focus when its motor was told";
	EXPECT_EQ(rumble(1).duration, 0);
	// What was asked for with the focus and comes when it has moved is not felt at all: the next that is, is what is asked for then.
	thread.vibrate(1, {.motors = 1, .amplitude = 1, .duration = second});
	thread.vibrate(2, {.motors = 2, .amplitude = 0.25f, .duration = second});
	ASSERT_TRUE(hasRumbled(3));
	EXPECT_TRUE(rumble(2).strong == 0 && rumble(2).weak == 0.25f);
}

TEST_F(Input, WhenNobodyReadsAnyMoreNoKeyIsHeldAndNoMotorTurns)
{
	bringGamepad();
	say(key(KEY_SPACE, true));
	ASSERT_TRUE(isDone([](const Deeds &now) { return now.told.hands[right].select != 0; }));
	thread.vibrate(1, {.motors = 1, .amplitude = 1, .duration = 3600 * second});
	ASSERT_TRUE(hasRumbled(1));
	played.update([](PlayedDevices::State &now) { now.isBroken = true; });
	EXPECT_TRUE(isDone([](const Deeds &now) { return !now.told.hands[right].isThere && !now.told.hasGamepad; }));
	EXPECT_FALSE(deeds.lock()->told.hands[right].select);
	ASSERT_TRUE(hasRumbled(2));
	EXPECT_EQ(rumble(1).duration, 0);
}

TEST(InputSettings, AreReadWithEveryNumberAndNameChecked)
{
	const auto read = [](const char *setting) {
		TomlDocument document;
		if (*setting) document.set(setting);
		TomlTable root = document.root(), input = root.table("input");
		return readInput(input);
	};
	const auto complaint = [&](const char *setting) {
		try {
			read(setting);
		} catch (const InputError &problem) {
			return std::string(problem.what());
		}
		return std::string();
	};
	EXPECT_EQ(read(""), InputSettings());
	EXPECT_TRUE(read("").devices.empty()) << "nothing is read unless it is asked for";
	EXPECT_EQ(read("input.simple_controller=left").hand, std::optional<uint32_t>(left));
	EXPECT_EQ(read("input.aim=mouse").aim, Aim::mouse);
	EXPECT_EQ(read("input.select=['KEY_A']").select, std::vector<KeyCode>{KEY_A});
	EXPECT_EQ(read("input.menu=['KEY_B']").menu, std::vector<KeyCode>{KEY_B});
	EXPECT_EQ(read("input.recenter=[]").recenter, std::vector<KeyCode>{});
	EXPECT_EQ(read("input.raw_passthrough=['BTN_MODE']").rawPassthrough, std::vector<KeyCode>{BTN_MODE});
	EXPECT_EQ(read("input.devices=['*Mouse']").devices, std::vector<std::string>{"*Mouse"});
	EXPECT_EQ(complaint("input.recenter=['F9']"),
			  "--set input.recenter=['F9']: input.recenter = [ 'F9' ], expected names that Linux gives to keys, such as \"KEY_SPACE\" or "
			  "\"BTN_LEFT\", and \"F9\" is none");
	EXPECT_NE(complaint("input.mouse_speed=0").find("expected a number from 0.001 to 10"), std::string::npos);
	EXPECT_NE(complaint("input.simple_controller=both").find("\"none\", \"left\", \"right\""), std::string::npos);
	EXPECT_NE(complaint("input.key=1").find("unknown key input.key"), std::string::npos);
}

} // namespace arift
