#include "runtime/service/status.h"
#include "runtime/base/clock.h"
#include "runtime/service/build.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace arift
{

namespace
{

const XrTime startedAt = realTime();

/// Figures are for people and tests: a microsecond is exact enough, and 0.1 is not 0.10000000000000001.
double rounded(double value) { return std::round(value * 1000) / 1000; }

} // namespace

nlohmann::json describe(const Figure &figure) { return {{"median", rounded(figure.median)}, {"p99", rounded(figure.p99)}}; }

nlohmann::json describeService(const Config &config, const FrameFigures &figures)
{
	nlohmann::json status;
	status["service"] = {
		{"pid", ::getpid()}, {"uptime", rounded(inSeconds(realTime() - startedAt))}, {"version", version}, {"build", buildId}};
	status["clock"] = {{"mode", nameOf(config.clock)}, {"rate", config.rate}};
	status["frames"] = {{"shown", figures.shown},
						{"perSecond", rounded(figures.perSecond)},
						{"missed", figures.missed},
						{"gaps", figures.gaps},
						{"longestGapMs", rounded(figures.longestGap)},
						{"withoutCamera", figures.withoutCamera},
						{"leftOut", figures.leftOut},
						{"cameraAgeMs", describe(figures.cameraAge)},
						{"poseAgeMs", describe(figures.poseAge)},
						{"composeMs", describe(figures.compose)},
						{"cpuMsPerFrame", figures.shown ? rounded(figures.cpuSeconds * 1000 / double(figures.shown)) : 0.0}};
	auto &stages = status["frames"]["stagesMs"];
	for (size_t stage = 0; stage < frameStageNames.size(); ++stage) stages[frameStageNames[stage]] = describe(figures.stages[stage]);
	return status;
}

void describeDevices(nlohmann::json &status, const std::vector<CameraStatus> &cameras, const TrackerStatus &tracker)
{
	status["cameras"] = nlohmann::json::array();
	for (const CameraStatus &camera : cameras)
		status["cameras"].push_back({{"name", camera.info.name},
									 {"open", camera.open},
									 {"frameRate", rounded(camera.frameRate)},
									 {"received", camera.received},
									 {"dropped", camera.info.dropped},
									 {"malformed", camera.info.malformed}});
	status["tracker"] = {{"name", tracker.info.name},
						 {"open", tracker.open},
						 {"rate", rounded(tracker.rate)},
						 {"lost", tracker.lost},
						 {"malformed", tracker.info.malformed}};
}

} // namespace arift
