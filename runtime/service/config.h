// What a person decides about the service: the configuration file, and what the command line puts above it.
#pragma once
#include "runtime/base/xr.h"
#include "runtime/service/application_settings.h"
#include "runtime/service/input_settings.h"
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace arift
{

class TomlDocument;

enum class ClockMode { real, scaled, stepped };
enum class TargetKind { automatic, offscreen, window };
enum class ImageSharing { automatic, copies };

struct Config {
	std::shared_ptr<const TomlDocument> document; ///< all of it, drivers' tables too; null: everything at its default

	std::string driver = "auto";                   ///< [headset] driver
	std::string rig = "arift";                     ///< [headset] rig: a name in calib/rigs, a path, or "recording"
	std::filesystem::path recording;               ///< [replay] recording
	ClockMode clock = ClockMode::real;             ///< [clock] mode
	double rate = 1;                               ///< [clock] rate, scaled only
	double passthroughDistance = 2;                ///< [passthrough] distance, metres
	double viewOffset = 1;                         ///< [passthrough] view_offset, 0 eye .. 1 camera
	std::vector<XrEnvironmentBlendMode> blendModes{///< [passthrough] blend_modes, the favourite first
												   XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
												   XR_ENVIRONMENT_BLEND_MODE_ADDITIVE};
	ApplicationTable applications;                 ///< [applications."NAME"], and all of applications.toml
	double eyeHeight = 1.6;                        ///< [space] eye_height, metres
	std::array<double, 2> bounds{2, 2};            ///< [space] bounds, metres
	TargetKind target = TargetKind::automatic;     ///< [compositor] target
	bool nearerOver = true;                        ///< [compositor] applications: by distance, else by start
	ImageSharing images = ImageSharing::automatic; ///< [swapchains] images
	InputSettings input;                           ///< [input]
};

/// Where the configuration is looked for: `given`, else $ARIFT_CONFIG, else config.toml in the configuration directory if it is there.
std::filesystem::path findConfig(const std::filesystem::path &given);

/// Of the user: applications.toml in the configuration directory.
std::filesystem::path applicationsFile();

/// Files beside the configuration, each where there is such a file.
struct FurtherFiles {
	std::filesystem::path applications; ///< a table for each application, called like it
	std::filesystem::path programs;     ///< what programs have set (Overrides)
};

/// Reads `file` (may be empty: everything at its default); above it what `further` files say, in their order; above all `overrides`
/// ("clock.mode=stepped", values as in TOML, quotes optional). Relative paths begin beside their file, those of overrides at the working
/// directory. Throws InputError with file and line or override, value and what was expected; unknown keys are errors, in the tables of
/// drivers that are not used too.
Config readConfig(const std::filesystem::path &file, const std::vector<std::string> &overrides, const FurtherFiles &further = {});

const char *nameOf(ClockMode mode);

} // namespace arift
