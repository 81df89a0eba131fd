#include "drivers/registry.h"
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
};
constexpr std::array entries{Entry{"synthetic", synthetic::makeDriver}, Entry{"replay", replay::makeDriver}};

} // namespace

std::vector<std::string> driverNames()
{
	std::vector<std::string> names;
	for (const Entry &entry : entries) names.emplace_back(entry.name);
	return names;
}

std::unique_ptr<Driver> makeDriver(const std::string &name, const DriverContext &context)
{
	std::string known;
	for (const Entry &entry : entries) {
		if (name == entry.name || name == "auto") return entry.make(context);
		known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", entry.name);
	}
	throw InputError("driver \"{}\" is unknown, expected \"auto\", {}", name, known);
}

} // namespace arift
