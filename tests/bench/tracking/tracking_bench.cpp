// What a sample costs: to stay below 260 ns for the filter (0.026 % of a core at 1000 Hz).
#include "runtime/tracking/head_tracker.h"
#include <benchmark/benchmark.h>

using namespace arift;

namespace
{

void filterSample(benchmark::State &state)
{
	OrientationFilter filter(1e-3);
	std::array<glm::dvec3, 1024> rates, accelerations;
	for (size_t i = 0; i < rates.size(); ++i) {
		const double phase = 2 * M_PI * double(i) / double(rates.size());
		rates[i] = {0.5 * std::sin(phase), 0.3, -0.2};
		accelerations[i] = {0.3, 9.7 + 0.01 * std::sin(7 * phase), 0.1};
	}
	size_t i = 0;
	for (auto _ : state) {
		filter.update(rates[i % rates.size()], accelerations[i % rates.size()], 1e-3);
		++i;
		benchmark::DoNotOptimize(filter);
	}
}
BENCHMARK(filterSample);

void trackerReport(benchmark::State &state)
{
	static PoseRing ring;
	PoseWriter writer(ring);
	HeadTracker tracker({}, {}, writer);
	ImuReport report{.arrival = second, .sampleCount = 1};
	int64_t tick = 0;
	for (auto _ : state) {
		report.samples[0] = {++tick, 1, {0.1f, float(tick % 100) * 1e-3f, 0}, {0, 9.8f, 0}};
		report.arrival += millisecond + (tick * 7919) % 100'000 - 50'000;
		tracker.add(report);
	}
}
BENCHMARK(trackerReport);

} // namespace
