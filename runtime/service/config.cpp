#include "runtime/service/config.h"
#include "runtime/base/toml.h"
#include "runtime/ipc/runtime_directory.h"
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

namespace arift
{

namespace fs = std::filesystem;

namespace
{

constexpr std::array driverTables{"synthetic", "replay", "dk1", "ueye", "aravis", "v4l2"};

std::vector<XrEnvironmentBlendMode> blendModes(TomlTable &passthrough)
{
	constexpr const char *expected = R"(an array of "opaque", "alpha_blend" and "additive", at least one, none twice)";
	constexpr std::array names{"opaque", "alpha_blend", "additive"};
	constexpr std::array values{XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
								XR_ENVIRONMENT_BLEND_MODE_ADDITIVE};
	std::vector<XrEnvironmentBlendMode> modes;
	for (const std::string &name : passthrough.texts("blend_modes")) {
		const auto found = std::ranges::find(names, name);
		if (found == names.end()) passthrough.complain("blend_modes", expected);
		const XrEnvironmentBlendMode mode = values[size_t(found - names.begin())];
		if (std::ranges::find(modes, mode) != modes.end()) passthrough.complain("blend_modes", expected);
		modes.push_back(mode);
	}
	if (modes.empty()) passthrough.complain("blend_modes", expected);
	return modes;
}

Config decode(const toml::table &table, const std::string &label)
{
	Config config;
	TomlTable root(table, label, "");
	TomlTable headset = root.table("headset");
	config.driver = headset.text("driver", config.driver);
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
	if (passthrough.has("blend_modes")) config.blendModes = blendModes(passthrough);
	passthrough.finish();

	TomlTable compositor = root.table("compositor");
	config.target = TargetKind(compositor.choice("target", {"auto", "offscreen", "window"}, size_t(config.target)));
	compositor.finish();

	for (const char *driver : driverTables) root.table(driver); // each driver reads and checks its own
	if (TomlTable replay = root.table("replay"); replay.has("recording")) {
		const fs::path recording = replay.text("recording"), beside = fs::path(label).parent_path() / recording;
		config.recording = fs::exists(beside) ? beside : recording;
	}
	root.finish();
	return config;
}

/// "a.b=value" -> the table it stands for.
toml::table parseOverride(const std::string &text)
{
	const size_t equals = text.find('=');
	if (equals == std::string::npos || equals == 0)
		throw InputError("--set {}: expected KEY.PATH=VALUE, for instance --set clock.mode=stepped", text);
	const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
	try {
		return toml::parse(key + " = " + value);
	} catch (const toml::parse_error &) {
		try {
			return toml::parse(key + " = '''" + value + "'''"); // a bare word is a text
		} catch (const toml::parse_error &problem) {
			throw InputError("--set {}: {}", text, problem.description());
		}
	}
}

/// Paths are relative to the file that names them, and the merged file lies elsewhere: texts that name an existing file become absolute.
void anchorPaths(toml::table &table, const fs::path &folder)
{
	for (auto &&[key, value] : table) {
		if (toml::table *inner = value.as_table()) anchorPaths(*inner, folder);
		toml::value<std::string> *text = value.as_string();
		if (!text || text->get().find_first_of("/.") == std::string::npos) continue;
		std::error_code ignored;
		if (const fs::path path = folder / text->get(); fs::exists(path, ignored)) *text = path.string();
	}
}

void merge(toml::table &into, const toml::table &from)
{
	for (const auto &[key, value] : from) {
		toml::table *target = into[key.str()].as_table();
		if (target && value.is_table())
			merge(*target, *value.as_table());
		else
			into.insert_or_assign(key.str(), value);
	}
}

} // namespace

fs::path findConfig(const fs::path &given)
{
	if (!given.empty()) return fs::absolute(given);
	if (const char *named = std::getenv("ARIFT_CONFIG"); named && *named) return fs::absolute(named);
	const fs::path usual = ipc::configDirectory() / "config.toml";
	return fs::exists(usual) ? usual : fs::path();
}

Config readConfig(const fs::path &file, const std::vector<std::string> &overrides, const fs::path &mergedFile)
{
	toml::table table = file.empty() ? toml::table() : parseTomlFile(file);
	Config config = decode(table, file.string());
	config.file = file;
	if (overrides.empty()) return config;
	if (!file.empty()) anchorPaths(table, fs::absolute(file).parent_path());
	for (const std::string &text : overrides) {
		toml::table override = parseOverride(text);
		anchorPaths(override, fs::current_path());
		merge(table, override);
		config = decode(table, "--set " + text);
	}
	std::ofstream merged(mergedFile);
	merged << table << '\n';
	if (!merged.flush()) throw InputError("{}: cannot be written", mergedFile.string());
	config.file = mergedFile;
	return config;
}

const char *nameOf(ClockMode mode) { return mode == ClockMode::real ? "real" : mode == ClockMode::scaled ? "scaled" : "stepped"; }

} // namespace arift
