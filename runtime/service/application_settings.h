// What a user decides about single applications, by the name they give themselves (XrApplicationInfo::applicationName).
#pragma once
#include "runtime/base/colour.h"
#include "runtime/compositor/panel_inputs.h"
#include "runtime/ipc/messages.h"
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace arift
{

class TomlTable;

/// Put upon an application from outside.
struct ForcedPassthrough {
	ipc::Forced mode = ipc::Forced::off;
	ChromaKey key;
	float opacity = 1; ///< of the application's layers, 0..1
	bool operator==(const ForcedPassthrough &) const = default;
};

struct ApplicationSettings {
	ForcedPassthrough passthrough;
	std::vector<XrEnvironmentBlendMode> blendModes; ///< the favourite first; empty: those of all applications
};
using ApplicationTable = std::map<std::string, ApplicationSettings>;

/// A table of tables, each called like an application. Throws InputError.
ApplicationTable readApplications(TomlTable &applications);
/// `blend_modes` of a table. Throws InputError.
std::vector<XrEnvironmentBlendMode> readBlendModes(TomlTable &table);

const char *nameOf(XrEnvironmentBlendMode mode);

/// For `arift status`.
nlohmann::json describe(const ApplicationTable &applications);

} // namespace arift
