// What a person decides about keyboards, mice and gamepads: the [input] table of the configuration.
#pragma once
#include "runtime/device/input_devices.h"
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace arift
{

class TomlTable;

enum class Aim { head, mouse };

struct InputSettings {
	/// Keys at their defaults.
	InputSettings();

	std::vector<std::string> devices;              ///< `devices`: names of those that are read, * and ? stand for any text and character
	std::optional<uint32_t> hand;                  ///< `simple_controller`: 0 the left, 1 the right
	Aim aim = Aim::head;                           ///< `aim`: where the hand points to
	double mouseSpeed = 0.1;                       ///< `mouse_speed`: degrees per count of the mouse
	std::vector<KeyCode> select, menu;             ///< of the hand
	std::vector<KeyCode> recenter, rawPassthrough; ///< `recenter`, `raw_passthrough`: of the service itself, whatever runs
	bool operator==(const InputSettings &) const = default;
};

/// Throws InputError.
InputSettings readInput(TomlTable &input);

/// For `arift status`: every device that there is, and whether it is on.
nlohmann::json describeInput(const InputSettings &settings);

} // namespace arift
