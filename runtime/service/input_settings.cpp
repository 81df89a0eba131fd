#include "runtime/service/input_settings.h"
#include "drivers/registry.h"
#include "runtime/base/toml.h"
#include "runtime/service/places.h"
#include <linux/input-event-codes.h>
#include <nlohmann/json.hpp>

namespace arift
{
namespace
{

std::vector<KeyCode> keys(TomlTable &input, const char *setting, const std::vector<KeyCode> &otherwise)
{
	if (!input.has(setting)) return otherwise;
	std::vector<KeyCode> codes;
	for (const std::string &name : input.texts(setting)) {
		const auto code = keyNamed(name);
		if (!code)
			input.complain(setting,
						   fmt::format("names that Linux gives to keys, such as \"KEY_SPACE\" or \"BTN_LEFT\", and \"{}\" is none", name));
		codes.push_back(*code);
	}
	return codes;
}

const char *nameOf(InputKind kind)
{
	switch (kind) {
	case InputKind::keyboard: return "keyboard";
	case InputKind::mouse: return "mouse";
	case InputKind::gamepad: return "gamepad";
	case InputKind::other: break;
	}
	return "other";
}

} // namespace

/// The service's own keys are such as nobody needs while typing.
InputSettings::InputSettings()
	: select{KEY_SPACE, BTN_LEFT, BTN_SOUTH},
	  menu{KEY_MENU, BTN_RIGHT, BTN_START},
	  recenter{KEY_SCROLLLOCK, BTN_MODE},
	  rawPassthrough{KEY_PAUSE}
{
}

InputSettings readInput(TomlTable &input)
{
	InputSettings settings;
	if (input.has("devices")) settings.devices = input.texts("devices");
	const size_t hand = input.choice("simple_controller", {"none", "left", "right"}, 0);
	if (hand > 0) settings.hand = uint32_t(hand - 1);
	settings.aim = Aim(input.choice("aim", {"head", "mouse"}, size_t(settings.aim)));
	settings.mouseSpeed = input.number("mouse_speed", 0.001, 10, settings.mouseSpeed);
	settings.select = keys(input, "select", settings.select);
	settings.menu = keys(input, "menu", settings.menu);
	settings.recenter = keys(input, "recenter", settings.recenter);
	settings.rawPassthrough = keys(input, "raw_passthrough", settings.rawPassthrough);
	input.finish();
	return settings;
}

nlohmann::json describeInput(const InputSettings &settings)
{
	nlohmann::json list = nlohmann::json::array();
	for (const InputDeviceInfo &device : listInputDevices(inputPlaces(), settings.devices))
		list.push_back({{"node", device.node},
						{"name", device.name},
						{"kind", nameOf(device.kind)},
						{"on", device.isOn},
						{"problem", device.problem}});
	return list;
}

} // namespace arift
