#include "runtime/service/devices.h"
#include "runtime/base/error.h"
#include "runtime/base/log.h"
#include "runtime/service/device_threads.h"
#include <nlohmann/json.hpp>

namespace arift
{
namespace
{

constexpr const char *automatic = "auto";

/// Nobody who has plugged in a headset wants to see a simulated one.
std::string problemOf(const Config &config, const std::optional<PluggedHeadset> &plugged)
{
	if (config.driver != automatic || !plugged) return {};
	return fmt::format("an {} is plugged into USB port {}, but this version has no driver that opens it: unplug it, or have a "
					   "simulated headset all the same (headset.driver = \"synthetic\" in the configuration)",
					   plugged->name, plugged->port);
}

} // namespace

Devices::Devices(Context context) : context_(std::move(context)), plugged_(findPluggedHeadset(context_.sysfs)), open_(choose()) {}

Devices::~Devices() = default;

Devices::Open Devices::choose() const
{
	Open chosen{.problem = problemOf(context_.config, plugged_), .driver = {}, .headset = {}};
	if (chosen.problem.empty()) chosen.driver = driverFor(context_.config, context_.rig, context_.clock);
	return chosen;
}

void Devices::open(Open &chosen) const
{
	if (!chosen.driver) {
		log::error("{}", chosen.problem);
		return;
	}
	chosen.headset = std::make_unique<Headset>(context_.rig, *chosen.driver, context_.clock, context_.poses, context_.feeds,
											   makeHostFrameBuffer, context_.trackerBegins);
	log::info("{} with rig \"{}\"", chosen.driver->name(), context_.rig.name);
}

/// Opening takes its time: nobody who asks is kept waiting.
void Devices::open()
{
	Open chosen = std::move(*open_.lock());
	open(chosen);
	*open_.lock() = std::move(chosen);
}

std::string Devices::name()
{
	const auto opened = open_.lock();
	return opened->driver ? opened->driver->name() : "no headset";
}

std::string Devices::problem() { return open_.lock()->problem; }

bool Devices::follow()
{
	auto plugged = findPluggedHeadset(context_.sysfs);
	if (plugged == plugged_) return false;
	plugged_ = std::move(plugged);
	if (context_.config.driver != automatic) return false;
	{
		Open gone;
		open_.update([&](Open &opened) {
			std::swap(gone, opened);
			opened.problem = "the headset is being exchanged";
		});
	} // its threads have ended: nobody else writes poses or images now
	Open next;
	try {
		next = choose();
		open(next);
	} catch (const std::exception &error) { // the world stays visible
		log::error("{}", error.what());
		next = {.problem = error.what(), .driver = {}, .headset = {}};
	}
	open_.update([&](Open &opened) { std::swap(next, opened); });
	return true;
}

void Devices::describe(nlohmann::json &status)
{
	const auto opened = open_.lock();
	status["headset"]["name"] = opened->driver ? opened->driver->name() : "none";
	status["headset"]["problem"] = opened->problem;
	if (opened->headset)
		describeDevices(status, opened->headset->cameras(), opened->headset->tracker());
	else
		describeDevices(status, {}, {});
}

} // namespace arift
