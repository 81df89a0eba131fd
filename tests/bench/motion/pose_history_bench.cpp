// What a pose costs: every view, layer and camera image asks for some. To stay below 200 ns.
#include "runtime/motion/pose_history.h"
#include "runtime/motion/view_poses.h"
#include <benchmark/benchmark.h>

using namespace arift;

namespace
{

const PoseRing &filledRing()
{
	static PoseRing ring;
	PoseWriter writer(ring);
	if (ring.written == 0) {
		for (int i = 1; i <= 10'000; ++i) writer.push({i * millisecond, rotationAbout({0, 1, 0}, 1e-3 * i), {0, 1, 0}, {0.1f, 0, 0}});
	}
	return ring;
}

/// Asked this long before (negative: after) the newest sample.
void poseAt(benchmark::State &state)
{
	const PoseHistory history(filledRing());
	const XrTime time = 10'000 * millisecond - state.range(0) * microsecond;
	for (auto _ : state) benchmark::DoNotOptimize(history.at(time));
}
BENCHMARK(poseAt)->ArgName("usBeforeNewest")->Arg(-40'000)->Arg(0)->Arg(500)->Arg(40'500)->Arg(3'000'500);

void push(benchmark::State &state)
{
	static PoseRing ring;
	PoseWriter writer(ring);
	MotionSample sample{second, identityOrientation, {0, 1, 0}, {0, 0, 0}};
	for (auto _ : state) {
		sample.time += millisecond;
		writer.push(sample);
	}
}
BENCHMARK(push);

void viewPose(benchmark::State &state)
{
	ipc::ViewTable views{};
	views.eyeInHead = views.cameraInHead = {identityPose, identityPose};
	const XrPosef head = headInOrigin(views, PoseHistory(filledRing()).at(5 * second));
	for (auto _ : state) benchmark::DoNotOptimize(viewInOrigin(views, 0, head, head));
}
BENCHMARK(viewPose);

} // namespace
