#include "drivers/registry.h"
#include "drivers/dk1/presence.h"
#include "drivers/evdev/devices.h"
#include "drivers/replay/driver.h"
#include "drivers/synthetic/driver.h"
#include "runtime/base/error.h"
#include <array>

namespace arift
{

namespace
{

struct Entry {
	const char *name;
	std::unique_ptr<Driver> (*make)(const DriverContext &);
	void (*check)(const std::shared_ptr<const TomlDocument> &);
};
constexpr std::array entries{Entry{"synthetic", synthetic::makeDriver, synthetic::checkSettings},
							 Entry{"replay", replay::makeDriver, replay::checkSettings}};

} // namespace

std::vector<std::string> driverNames()
{
	std::vector<std::string> names;
	for (const Entry &entry : entries) names.emplace_back(entry.name);
	return names;
}

void checkDriverSettings(const std::shared_ptr<const TomlDocument> &configuration)
{
	for (const Entry &entry : entries) entry.check(configuration);
}

std::optional<PluggedHeadset> findPluggedHeadset(const std::filesystem::path &sysfs)
{
	const auto tracker = dk1::findTracker(sysfs);
	return tracker ? std::optional(PluggedHeadset{"Oculus Rift DK1", tracker->port}) : std::nullopt;
}

std::unique_ptr<Driver> makeDriver(const std::string &name, const DriverContext &context)
{
	std::string known = "\"auto\"";
	for (const Entry &entry : entries) {
		if (name == entry.name || name == "auto") return entry.make(context);
		known += fmt::format(", \"{}\"", entry.name);
	}
	throw InputError("driver \"{}\" is unknown, expected one of {}", name, known);
}

std::vector<InputDeviceInfo> listInputDevices(const InputPlaces &places, const std::vector<std::string> &wanted)
{
	return evdev::describeNodes(places, wanted);
}

std::unique_ptr<InputDevices> makeInputDevices(const InputPlaces &places, const std::vector<std::string> &wanted)
{
	return std::make_unique<evdev::Devices>(places, wanted);
}

std::optional<KeyCode> keyNamed(const std::string &name)
{
	const int code = libevdev_event_code_from_name(EV_KEY, name.c_str());
	return code > 0 ? std::optional(KeyCode(code)) : std::nullopt;
}

} // namespace arift
