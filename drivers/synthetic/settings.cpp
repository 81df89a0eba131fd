#include "drivers/synthetic/settings.h"
#include "runtime/base/toml_document.h"
#include <algorithm>
#include <glm/geometric.hpp>

namespace arift::synthetic
{

namespace
{

constexpr double degree = M_PI / 180;
constexpr size_t mostMarkers = 64;

glm::dvec3 vectorOf(const std::vector<double> &numbers) { return {numbers[0], numbers[1], numbers[2]}; }

XrDuration milliseconds(TomlTable &table, const char *key, double high, XrDuration otherwise)
{
	return fromSeconds(table.number(key, 0, high, inSeconds(otherwise) * 1e3) * 1e-3);
}

void readMotion(TomlTable &table, Settings &settings)
{
	settings.motion = MotionKind(table.choice("motion", {"rest", "constant", "natural", "file"}, size_t(settings.motion)));
	const bool isConstant = settings.motion == MotionKind::constant, isFile = settings.motion == MotionKind::file;
	if (table.has("rate") || isConstant) settings.rate = vectorOf(table.numbers("rate", 3)) * degree;
	if (table.has("motion_file") || isFile) settings.motionFile = table.path("motion_file");
	settings.motionDelay = table.number("motion_delay", 0, 3600, settings.motionDelay);
	if (table.has("neck")) settings.neck = vectorOf(table.numbers("neck", 3));
	settings.seed = uint64_t(table.integer("seed", 0, INT64_MAX, int64_t(settings.seed)));
	if (table.has("truth")) settings.truth = table.path("truth");
}

void readTracker(TomlTable &table, Settings &settings)
{
	SensorErrors &errors = settings.errors;
	errors.noise = table.boolean("tracker_noise", errors.noise);
	errors.quantisation = table.boolean("tracker_quantisation", errors.quantisation);
	errors.seed = settings.seed;
	if (table.has("gyro_bias")) errors.angularVelocityBias = vectorOf(table.numbers("gyro_bias", 3)) * degree;
	if (table.has("accel_bias")) errors.accelerationBias = vectorOf(table.numbers("accel_bias", 3));
	settings.trackerLatency = milliseconds(table, "tracker_latency_ms", 1000, settings.trackerLatency);
	const int64_t rate = table.integer("sample_rate", 250, 1000, settings.reportRate);
	if (rate != 250 && rate != 500 && rate != 1000) table.complain("sample_rate", "250, 500 or 1000");
	settings.reportRate = int(rate);
}

Marker readMarker(TomlTable &table)
{
	const glm::dvec3 position = vectorOf(table.numbers("position", 3));
	if (glm::length(position) < 0.05) table.complain("position", "a point at least 0.05 m from the world's origin, which the marker faces");
	const Marker marker{position, table.number("radius", 0.001, 1)};
	table.finish();
	return marker;
}

void readCameras(TomlTable &table, Settings &settings)
{
	settings.cameraRate = table.number("camera_rate", 0.1, 500, settings.cameraRate);
	settings.exposure =
		milliseconds(table, "exposure_ms", 1000 / settings.cameraRate, std::min(settings.exposure, fromSeconds(1 / settings.cameraRate)));
	settings.cameraNoise = table.boolean("camera_noise", settings.cameraNoise);
	settings.transferDelay = milliseconds(table, "transfer_delay_ms", 10'000, settings.transferDelay);
	settings.cameraPhase = table.number("camera_phase", 0, 1, settings.cameraPhase);
	settings.cameraJitter = milliseconds(table, "camera_jitter_ms", 100, settings.cameraJitter);
	settings.blackLevel = table.number("black_level", 0, 0.5, settings.blackLevel);
	auto markers = table.tables("markers");
	if (markers.size() > mostMarkers) table.complain("markers", fmt::format("at most {} markers", mostMarkers));
	for (TomlTable &marker : markers) settings.markers.push_back(readMarker(marker));
}

} // namespace

Settings readSettings(const std::shared_ptr<const TomlDocument> &configuration)
{
	Settings settings;
	TomlTable table = rootOf(configuration).table("synthetic");
	readMotion(table, settings);
	readTracker(table, settings);
	readCameras(table, settings);
	table.finish();
	return settings;
}

} // namespace arift::synthetic
