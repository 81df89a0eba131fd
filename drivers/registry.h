// Every driver there is, by name.
#pragma once
#include "runtime/device/driver.h"
#include "runtime/device/input_devices.h"
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arift
{

/// Names for makeDriver, in the order in which they are worth trying.
std::vector<std::string> driverNames();

/// Checks every driver's table of the configuration, whichever driver is used. Opens nothing. Throws InputError.
void checkDriverSettings(const std::shared_ptr<const TomlDocument> &configuration);

/// A headset of hardware, as the kernel lists it.
struct PluggedHeadset {
	std::string name; ///< for people
	std::string port; ///< of USB
	bool operator==(const PluggedHeadset &) const = default;
};
/// The one that is plugged in; nothing where none is. `sysfs`: the kernel's list (/sys). Opens nothing.
std::optional<PluggedHeadset> findPluggedHeadset(const std::filesystem::path &sysfs);

/// "auto" takes the first of them, for no driver of hardware that could be plugged in is built in yet. Opens no device yet. Throws
/// InputError for an unknown name and for wrong settings. The context's clock outlives the driver and its devices.
std::unique_ptr<Driver> makeDriver(const std::string &name, const DriverContext &context);

// ---- keyboards, mice, gamepads

/// All that there are, for people; `wanted` are names (* and ? stand for any text and any character) of those that are switched on. Opens
/// nothing.
std::vector<InputDeviceInfo> listInputDevices(const InputPlaces &places, const std::vector<std::string> &wanted);
/// Reads those that are wanted, now and later. Throws std::system_error when the process has no descriptors left.
std::unique_ptr<InputDevices> makeInputDevices(const InputPlaces &places, const std::vector<std::string> &wanted);
/// Of a name that Linux gives it: KEY_SPACE, BTN_LEFT.
std::optional<KeyCode> keyNamed(const std::string &name);

} // namespace arift
