#include "runtime/service/application_settings.h"
#include "runtime/base/toml.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

constexpr std::array modeNames{"opaque", "alpha_blend", "additive"};
constexpr std::array modes{XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE};

ForcedPassthrough readForced(TomlTable &table)
{
	ForcedPassthrough forced;
	forced.mode = ipc::Forced(table.choice("passthrough", ipc::forcedNames, 0));
	const std::string colour = table.text("color", textOf(forced.key.colour));
	const auto parsed = colourOf(colour);
	if (!parsed) table.complain("color", "six hexadecimal digits, RRGGBB");
	forced.key.colour = *parsed;
	forced.key.tolerance = float(table.number("tolerance", 0, 1, ChromaKey().tolerance));
	forced.key.softness = float(table.number("softness", 0, 1, ChromaKey().softness));
	forced.opacity = float(table.number("opacity", 0, 1, 1));
	return forced;
}

double rounded(float value) { return std::round(double(value) * 1e4) / 1e4; }

} // namespace

std::vector<XrEnvironmentBlendMode> readBlendModes(TomlTable &table)
{
	constexpr const char *expected = R"(an array of "opaque", "alpha_blend" and "additive", at least one, none twice)";
	std::vector<XrEnvironmentBlendMode> found;
	for (const std::string &name : table.texts("blend_modes")) {
		const auto known = std::ranges::find(modeNames, name);
		if (known == modeNames.end()) table.complain("blend_modes", expected);
		const XrEnvironmentBlendMode mode = modes[size_t(known - modeNames.begin())];
		if (std::ranges::find(found, mode) != found.end()) table.complain("blend_modes", expected);
		found.push_back(mode);
	}
	if (found.empty()) table.complain("blend_modes", expected);
	return found;
}

ApplicationTable readApplications(TomlTable &applications)
{
	ApplicationTable all;
	for (const std::string &name : applications.keys()) {
		TomlTable table = applications.table(name.c_str());
		ApplicationSettings &settings = all[name];
		settings.passthrough = readForced(table);
		if (table.has("blend_modes")) settings.blendModes = readBlendModes(table);
		table.finish();
	}
	return all;
}

const char *nameOf(XrEnvironmentBlendMode mode)
{
	const auto known = std::ranges::find(modes, mode);
	return known == modes.end() ? "unknown" : modeNames[size_t(known - modes.begin())];
}

nlohmann::json describe(const ApplicationTable &applications)
{
	auto list = nlohmann::json::array();
	for (const auto &[name, settings] : applications) {
		const ForcedPassthrough &forced = settings.passthrough;
		nlohmann::json entry{{"name", name},
							 {"passthrough", nameOf(forced.mode)},
							 {"color", textOf(forced.key.colour)},
							 {"tolerance", rounded(forced.key.tolerance)},
							 {"softness", rounded(forced.key.softness)},
							 {"opacity", rounded(forced.opacity)}};
		for (const XrEnvironmentBlendMode mode : settings.blendModes) entry["blendModes"].push_back(nameOf(mode));
		list.push_back(std::move(entry));
	}
	return list;
}

} // namespace arift
