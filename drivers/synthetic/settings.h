// What the [synthetic] table of the configuration says about the simulated headset.
#pragma once
#include "drivers/synthetic/firmware.h"
#include "drivers/synthetic/scene.h"
#include <filesystem>
#include <memory>
#include <optional>

namespace arift
{
class TomlDocument;
}

namespace arift::synthetic
{

enum class MotionKind { rest, constant, natural, file };

struct Settings {
	MotionKind motion = MotionKind::natural;
	glm::dvec3 rate{0}; ///< rad/s, head axes; for `constant`
	std::filesystem::path motionFile;
	double motionDelay = 0;         ///< seconds at rest first
	std::optional<glm::dvec3> neck; ///< metres, head axes: the pivot that the head turns about; empty: where the Rig says
	uint64_t seed = 1;
	std::filesystem::path truth; ///< CSV to write; empty: none

	SensorErrors errors{.noise = true, .angularVelocityBias = {0.0026, 0.0009, -0.0017}};
	XrDuration trackerLatency = millisecond / 2; ///< from the newest sample to the host
	int reportRate = 500;                        ///< tracker reports a second

	double cameraRate = 43; ///< images a second: what two UI-1221LE on one USB 2 controller reach
	XrDuration exposure = 8 * millisecond;
	bool cameraNoise = true;
	XrDuration transferDelay = 21'300 * microsecond; ///< from the end of the exposure: 20.3 ms of readout at 20 MHz, and USB
	double cameraPhase = 0;                          ///< of the right camera against the left, in periods
	XrDuration cameraJitter = 0;                     ///< standard deviation of the error of reported mid-exposure times
	double blackLevel = 0;                           ///< raw value of darkness, 0..1
	std::vector<Marker> markers;
};

/// Reads [synthetic] of `configuration`; the defaults where either is absent. Opens none of the files it names. Throws InputError.
Settings readSettings(const std::shared_ptr<const TomlDocument> &configuration);

} // namespace arift::synthetic
