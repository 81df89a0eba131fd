// Prints how far holograms are from the real things they are pinned to, in panel pixels, and says whether that is near enough.
// Without arguments: one quick measurement as a line of JSON. --table: every distance, rate and view offset. --quick: corners and middle.
// --stability: how far holograms stray within ten seconds where sensors have their errors; printed, also with a wrong neck and a recording.
#include "tests/e2e/registration/measurement.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

using namespace arift::e2e;

namespace
{

struct Bound {
	double median, p99; ///< panel pixels
};
Bound boundAt(double degreesPerSecond)
{
	return degreesPerSecond == 0 ? Bound{0.5, 1} : degreesPerSecond <= 100 ? Bound{1, 2} : Bound{1.5, 3};
}

/// Prints one line of the table; false where a bound is missed. `bound` null: printed only.
bool report(const Scenario &scenario, const Setting &setting, const Figures &figures, const Bound *bound)
{
	const bool enough = figures.samples >= 20 && figures.lonely * 20 <= figures.samples;
	const bool near = !bound || (figures.median <= bound->median && figures.p99 <= bound->p99);
	const char *verdict = !bound ? "" : !enough ? "TOO FEW" : near ? "ok" : "TOO FAR";
	std::printf(
		"[ FIGURE   ] %4.1f m %4.0f deg/s  offset %.0f, plane %3.1f m   median %6.3f  p99 %6.3f  max %6.3f px  mean (%+.3f, %+.3f)  "
		"%5zu samples in %zu pictures, %zu lonely  %s\n",
		scenario.distance, scenario.degreesPerSecond, setting.viewOffset, setting.passthroughDistance, figures.median, figures.p99,
		figures.largest, figures.mean.x(), figures.mean.y(), figures.samples, figures.pictures, figures.lonely, verdict);
	std::fflush(stdout);
	return !bound || (enough && near);
}

/// One distance and rate: seen from the cameras; from the eyes with the plane at the marker; from the eyes with it elsewhere.
bool row(double distance, double rate, size_t pictures, bool everything, const std::string &keep)
{
	const Scenario scenario{.distance = distance, .degreesPerSecond = rate};
	const Bound bound = boundAt(rate);
	Measurement measurement(scenario);
	const Setting camera{.viewOffset = 1, .passthroughDistance = 2}, plane{0, distance, 0.2}, elsewhere{0, distance == 2 ? 1.0 : 2.0, 0.2};
	bool good = report(scenario, camera, measurement.measure(camera, pictures), &bound);
	if (!keep.empty()) measurement.keepPicture(keep);
	good &= report(scenario, plane, measurement.measure(plane, pictures), &bound);
	if (everything) report(scenario, elsewhere, measurement.measure(elsewhere, pictures), nullptr);
	return good;
}

bool table(std::span<const double> distances, std::span<const double> rates, size_t pictures, bool everything, const std::string &keep)
{
	bool good = true;
	for (const double rate : rates)
		for (const double distance : distances) good &= row(distance, rate, pictures, everything, keep);
	return good;
}

/// How far holograms stray within ten seconds, with the sensors' errors; `bound` is for what the design promises, else printed only.
bool stability(const char *name, Scenario scenario, bool bounded)
{
	scenario.sensorErrors = true;
	scenario.restSeconds = 3; // long enough to learn the gyroscope's bias
	Measurement measurement(scenario);
	std::printf("stability, %s:\n", name);
	const Setting setting;
	const Bound bound = boundAt(scenario.degreesPerSecond);
	return report(scenario, setting, measurement.measureChange(setting, 10), bounded ? &bound : nullptr);
}
bool stabilityTable(std::span<const double> rates, const std::string &recording)
{
	bool good = true;
	for (const double rate : rates) good &= stability("sensors with their errors", {.degreesPerSecond = rate}, true);
	for (const double rate : rates)
		stability("the neck 20 mm longer than believed", {.degreesPerSecond = rate, .neckErrorMetres = 0.02}, false);
	if (!recording.empty()) stability(recording.c_str(), {.recording = recording}, false);
	return good;
}

void single()
{
	Measurement measurement({.distance = 2, .degreesPerSecond = 100});
	const Figures figures = measurement.measure({}, 30);
	std::printf("%s\n", nlohmann::json{{"median", figures.median}, {"p99", figures.p99}, {"samples", figures.samples}}.dump().c_str());
}

int run(std::span<char *> arguments)
{
	std::string mode, keep, recording;
	std::vector<double> distances, rates;
	for (size_t i = 1; i < arguments.size(); ++i) {
		const std::string_view name = arguments[i];
		const bool takesValue = name == "--distance" || name == "--rate" || name == "--keep" || name == "--recording";
		if (takesValue && i + 1 == arguments.size()) throw std::invalid_argument(std::string(name) + " wants a value");
		if (name == "--quick" || name == "--table" || name == "--stability" || name == "--json")
			mode = name;
		else if (name == "--distance")
			distances.push_back(std::stod(arguments[++i]));
		else if (name == "--rate")
			rates.push_back(std::stod(arguments[++i]));
		else if (name == "--keep")
			keep = arguments[++i];
		else if (name == "--recording")
			recording = arguments[++i];
		else
			throw std::invalid_argument("usage: registration_probe [--json | --quick | --table | --stability] [--distance METRES]... "
										"[--rate DEG_PER_S]... [--keep PPM] "
										"[--recording FILE]");
	}
	if (mode == "--stability") {
		if (rates.empty()) rates = {0.0, 100.0, 200.0};
		return stabilityTable(rates, recording) ? 0 : 1;
	}
	const bool chosen = !distances.empty() || !rates.empty();
	if (mode == "--json" || (mode.empty() && !chosen)) {
		single();
		return 0;
	}
	if (mode == "--quick" && !chosen) {
		const std::array good{row(2, 0, 15, false, keep), row(1, 100, 20, false, keep), row(0.4, 200, 25, false, keep),
							  row(5, 200, 25, false, keep)};
		return std::ranges::all_of(good, std::identity{}) ? 0 : 1;
	}
	if (distances.empty()) distances = {0.4, 1.0, 2.0, 5.0};
	if (rates.empty()) rates = {0.0, 100.0, 200.0};
	return table(distances, rates, mode == "--quick" ? 25 : 80, mode != "--quick", keep) ? 0 : 1;
}

} // namespace

int main(int count, char **arguments)
{
	try {
		return run({arguments, size_t(count)});
	} catch (const std::exception &problem) {
		std::fprintf(stderr, "registration_probe: %s\n", problem.what());
		return 2;
	}
}
