#include "runtime/service/config.h"
#include "drivers/registry.h"
#include "runtime/base/toml_document.h"
#include "runtime/base/user_directories.h"
#include <algorithm>
#include <array>
#include <cstdlib>

namespace arift
{

namespace fs = std::filesystem;

namespace
{

std::array<double, 2> bounds(TomlTable &space)
{
	const std::vector<double> metres = space.numbers("bounds", 2);
	for (const double extent : metres)
		if (!(extent >= 0 && extent <= 100)) space.complain("bounds", "width and depth in metres, each from 0 to 100");
	return {metres[0], metres[1]};
}

std::string driver(TomlTable &headset)
{
	const std::string name = headset.text("driver", Config().driver);
	std::string expected = "\"auto\"";
	bool isKnown = name == "auto";
	for (const std::string &known : driverNames()) {
		expected += fmt::format(", \"{}\"", known);
		isKnown |= name == known;
	}
	if (!isKnown) headset.complain("driver", "one of " + expected);
	return name;
}

Config decode(std::shared_ptr<const TomlDocument> document)
{
	Config config;
	TomlTable root = document->root();
	TomlTable headset = root.table("headset");
	config.driver = driver(headset);
	config.rig = headset.text("rig", config.rig);
	headset.finish();

	TomlTable clock = root.table("clock");
	config.clock = ClockMode(clock.choice("mode", {"real", "scaled", "stepped"}, size_t(config.clock)));
	if (clock.has("rate") && config.clock != ClockMode::scaled) clock.complain("rate", R"(no rate unless clock.mode = "scaled")");
	config.rate = clock.number("rate", 0.001, 100, config.rate);
	clock.finish();

	TomlTable passthrough = root.table("passthrough");
	config.passthroughDistance = passthrough.number("distance", 0.1, 1000, config.passthroughDistance);
	config.viewOffset = passthrough.number("view_offset", 0, 1, config.viewOffset);
	if (passthrough.has("blend_modes")) config.blendModes = readBlendModes(passthrough);
	passthrough.finish();

	TomlTable applications = root.table("applications");
	config.applications = readApplications(applications);

	TomlTable space = root.table("space");
	config.eyeHeight = space.number("eye_height", 0, 3, config.eyeHeight);
	if (space.has("bounds")) config.bounds = bounds(space);
	space.finish();

	TomlTable compositor = root.table("compositor");
	config.target = TargetKind(compositor.choice("target", {"auto", "offscreen", "window"}, size_t(config.target)));
	config.nearerOver = compositor.choice("applications", {"by_distance", "by_start"}, config.nearerOver ? 0 : 1) == 0;
	compositor.finish();

	TomlTable swapchains = root.table("swapchains");
	config.images = ImageSharing(swapchains.choice("images", {"auto", "copy"}, size_t(config.images)));
	swapchains.finish();

	TomlTable input = root.table("input");
	config.input = readInput(input);

	for (const std::string &name : driverNames()) root.table(name.c_str());
	checkDriverSettings(document);
	if (TomlTable replay = root.table("replay"); replay.has("recording")) config.recording = replay.path("recording");
	root.finish();
	config.document = std::move(document);
	return config;
}

} // namespace

fs::path findConfig(const fs::path &given)
{
	if (!given.empty()) return fs::absolute(given);
	if (const char *named = std::getenv("ARIFT_CONFIG"); named && *named) return fs::absolute(named);
	const fs::path usual = configDirectory() / "config.toml";
	return fs::exists(usual) ? usual : fs::path();
}

fs::path applicationsFile() { return configDirectory() / "applications.toml"; }

Config readConfig(const fs::path &file, const std::vector<std::string> &overrides, const FurtherFiles &further)
{
	const auto document = file.empty() ? std::make_shared<TomlDocument>() : std::make_shared<TomlDocument>(file);
	if (fs::exists(further.applications)) document->add(further.applications, "applications");
	if (fs::exists(further.programs)) document->add(further.programs);
	for (const std::string &setting : overrides) document->set(setting);
	return decode(document);
}

const char *nameOf(ClockMode mode) { return mode == ClockMode::real ? "real" : mode == ClockMode::scaled ? "scaled" : "stepped"; }

} // namespace arift
