#include "runtime/openxr/service_devices.h"
#include <algorithm>

namespace arift::openxr
{
namespace
{

InputValue pressed(bool isPressed) { return {{isPressed ? 1.0f : 0.0f, 0}, {}}; }
InputValue at(const XrPosef &poseInView) { return {{}, Placed{SpaceKind::view, poseInView}}; }

/// The device of `user` where the application does not play it; null where it does, or where it is not there and never was.
InputDevice *ours(InputDevices &devices, XrPath user, bool isThere)
{
	const auto found = devices.find(user);
	if (found == devices.end()) return isThere ? &devices[user] : nullptr;
	return found->second.isPlayed ? nullptr : &found->second;
}

} // namespace

ServiceDevices::ServiceDevices(PathTable &paths)
	: simpleController_(paths.atom("/interaction_profiles/khr/simple_controller")),
	  xboxController_(paths.atom("/interaction_profiles/microsoft/xbox_controller")),
	  hands_{handAt(paths, "/user/hand/left"), handAt(paths, "/user/hand/right")},
	  gamepad_(gamepadAt(paths, "/user/gamepad"))
{
}

ServiceDevices::Hand ServiceDevices::handAt(PathTable &paths, const std::string &user)
{
	return {paths.atom(user),
			paths.atom(user + "/input/select/click"),
			paths.atom(user + "/input/menu/click"),
			paths.atom(user + "/input/aim/pose"),
			paths.atom(user + "/output/haptic"),
			{paths.atom(user + "/input/grip_surface/pose"), paths.atom(user + "/input/palm_ext/pose")}};
}

ServiceDevices::Gamepad ServiceDevices::gamepadAt(PathTable &paths, const std::string &user)
{
	Gamepad gamepad{.user = paths.atom(user),
					.buttons = {},
					.triggers = {paths.atom(user + "/input/trigger_left/value"), paths.atom(user + "/input/trigger_right/value")},
					.thumbsticks = {paths.atom(user + "/input/thumbstick_left"), paths.atom(user + "/input/thumbstick_right")},
					.outputs = {paths.atom(user + "/output/haptic_left"), paths.atom(user + "/output/haptic_right")}};
	for (size_t i = 0; i < gamepad.buttons.size(); ++i)
		gamepad.buttons[i] = paths.atom(user + "/input/" + gamepadButtonNames[i] + "/click");
	return gamepad;
}

void ServiceDevices::write(const ipc::InputTable &table, InputDevices &devices) const
{
	for (size_t i = 0; i < hands_.size(); ++i) {
		const Hand &hand = hands_[i];
		const ipc::HandState &state = table.hands[i];
		InputDevice *device = ours(devices, hand.user, state.isThere != 0);
		if (!device) continue;
		device->profile = simpleController_;
		device->isActive = state.isThere != 0;
		device->place = at(state.gripInView).place;
		device->values[hand.select] = pressed(state.select != 0);
		device->values[hand.menu] = pressed(state.menu != 0);
		device->values[hand.aim] = at(state.aimInView);
		for (const XrPath surface : hand.surfaces) device->values[surface].place = onSurface(*device->place);
	}
	InputDevice *device = ours(devices, gamepad_.user, table.hasGamepad != 0);
	if (!device) return;
	device->profile = xboxController_;
	device->isActive = table.hasGamepad != 0;
	for (size_t i = 0; i < gamepad_.buttons.size(); ++i)
		device->values[gamepad_.buttons[i]] = pressed(table.gamepad.isPressed(GamepadButton(i)));
	for (size_t side = 0; side < 2; ++side) {
		device->values[gamepad_.triggers[side]] = {{table.gamepad.triggers[side], 0}, {}};
		device->values[gamepad_.thumbsticks[side]] = {table.gamepad.thumbsticks[side], {}};
	}
}

void ServiceDevices::update(Input &input, const ipc::Published<ipc::InputTable> &page)
{
	if (page.version() == version_.load(std::memory_order_relaxed)) return;
	input.changeDevices([&](InputDevices &devices) {
		const uint32_t version = page.version();
		const auto table = page.read();
		if (!table) return; // it is news still, when it can be read
		write(*table, devices);
		version_.store(version, std::memory_order_relaxed); // what is written meanwhile is news next time
	});
}

uint32_t ServiceDevices::motorsOf(std::span<const XrPath> outputs) const
{
	constexpr uint32_t both = 3;
	uint32_t motors = 0;
	for (const XrPath output : outputs) {
		for (uint32_t side = 0; side < 2; ++side)
			if (output == gamepad_.outputs[side]) motors |= 1u << side;
		// A hand without a controller is felt in the gamepad, where there is one.
		for (const Hand &hand : hands_)
			if (output == hand.output) motors |= both;
	}
	return motors;
}

} // namespace arift::openxr
