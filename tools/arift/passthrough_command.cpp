#include "runtime/base/colour.h"
#include "runtime/base/error.h"
#include "runtime/ipc/request.h"
#include "tools/arift/commands.h"
#include "tools/arift/monitor.h"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>

namespace arift::tools
{

namespace
{

/// What the service has for an application, or every default where it has nothing.
nlohmann::json settingsOf(const nlohmann::json &status, const std::string &application)
{
	for (const auto &entry : status["applications"])
		if (entry["name"] == application) return entry;
	const ipc::ForcePassthrough unset;
	return {{"color", textOf(unset.colour)}, {"tolerance", unset.tolerance}, {"softness", unset.softness}, {"opacity", unset.opacity}};
}

bool isConnected(const nlohmann::json &status, const std::string &application)
{
	return std::ranges::any_of(status["clients"], [&](const auto &client) { return client["name"] == application; });
}

std::string sentence(const nlohmann::json &settings)
{
	const auto mode = settings["passthrough"].get<std::string>();
	std::string text = mode;
	if (mode == nameOf(ipc::Forced::chroma))
		text += fmt::format(", color {}, tolerance {}, softness {}", settings["color"].get<std::string>(),
							settings["tolerance"].get<double>(), settings["softness"].get<double>());
	if (mode != nameOf(ipc::Forced::off)) text += fmt::format(", opacity {}", settings["opacity"].get<double>());
	if (settings.contains("blendModes")) {
		text += "; blend modes";
		for (const auto &name : settings["blendModes"]) text += " " + name.get<std::string>();
	}
	return text;
}

float requireShare(const char *option, double value)
{
	if (!(value >= 0 && value <= 1)) throw InputError("--{} {}: expected a number from 0 to 1", option, value);
	return float(value);
}

std::array<float, 3> requireColour(const std::string &text)
{
	const auto colour = colourOf(text);
	if (!colour) throw InputError("--color {}: expected six hexadecimal digits RRGGBB, for instance 00FF00", text);
	return *colour;
}

} // namespace

void listPassthrough()
{
	Monitor monitor;
	const nlohmann::json status = statusOf(monitor);
	std::cout << (status["passthrough"]["raw"].get<bool>() ? "raw: the cameras alone are shown\n" : "");
	for (const auto &entry : status["applications"]) {
		const auto name = entry["name"].get<std::string>();
		std::cout << fmt::format("{}: {}{}\n", name, sentence(entry), isConnected(status, name) ? "" : " (not connected)");
	}
	for (const auto &client : status["clients"]) {
		const auto name = client["name"].get<std::string>();
		const bool isListed = std::ranges::any_of(status["applications"], [&](const auto &entry) { return entry["name"] == name; });
		if (!isListed) std::cout << fmt::format("{}: off\n", name);
	}
	if (status["applications"].empty() && status["clients"].empty()) std::cout << "no application is connected, and none has settings\n";
}

void forcePassthrough(const PassthroughOptions &options)
{
	const auto mode = std::ranges::find(ipc::forcedNames, options.mode);
	if (mode == ipc::forcedNames.end()) throw InputError("{}: expected {}", options.mode, fmt::join(ipc::forcedNames, ", "));
	if (options.application.empty() || options.application.size() >= sizeof(ipc::ForcePassthrough::application))
		throw InputError("\"{}\": expected the name of an application, up to {} characters", options.application,
						 sizeof(ipc::ForcePassthrough::application) - 1);
	Monitor monitor;
	const nlohmann::json status = statusOf(monitor), settings = settingsOf(status, options.application);
	ipc::ForcePassthrough request;
	ipc::copyText(request.application, options.application);
	request.mode = ipc::Forced(mode - ipc::forcedNames.begin());
	request.colour = requireColour(options.colour.value_or(settings["color"].get<std::string>()));
	request.tolerance = requireShare("tolerance", options.tolerance.value_or(settings["tolerance"].get<double>()));
	request.softness = requireShare("softness", options.softness.value_or(settings["softness"].get<double>()));
	request.opacity = requireShare("opacity", options.opacity.value_or(settings["opacity"].get<double>()));
	monitor.ask<ipc::Done>(request);
	if (!isConnected(status, options.application))
		std::cout << fmt::format("no application of the name \"{}\" is connected: kept for when it comes\n", options.application);
}

} // namespace arift::tools
