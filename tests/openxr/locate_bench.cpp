// What the calls cost that an application makes several times a frame, through the entry points, against live shared pages.
#include "tests/openxr/live_head.h"
#include <benchmark/benchmark.h>

namespace arift
{
namespace
{

void locateViews(benchmark::State &state)
{
	LiveHead head;
	XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 0, head.local};
	const auto locate = head.application.get<PFN_xrLocateViews>("xrLocateViews");
	XrViewState viewState{XR_TYPE_VIEW_STATE};
	XrView views[2] = {{XR_TYPE_VIEW}, {XR_TYPE_VIEW}};
	uint32_t count = 0;
	for (auto _ : state) {
		info.displayTime = head.nextTime();
		if (locate(head.session, &info, &viewState, 2, &count, views) != XR_SUCCESS || viewState.viewStateFlags == 0)
			state.SkipWithError("xrLocateViews found nothing");
	}
}
BENCHMARK(locateViews);

void locateSpace(benchmark::State &state)
{
	LiveHead head;
	const auto locate = head.application.get<PFN_xrLocateSpace>("xrLocateSpace");
	XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
	XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, state.range(0) ? &velocity : nullptr};
	for (auto _ : state)
		if (locate(head.view, head.local, head.nextTime(), &location) != XR_SUCCESS || location.locationFlags == 0)
			state.SkipWithError("xrLocateSpace found nothing");
}
BENCHMARK(locateSpace)->ArgName("velocity")->Arg(0)->Arg(1);

void pollWithoutEvents(benchmark::State &state)
{
	LiveHead head;
	head.application.states();
	const auto poll = head.application.get<PFN_xrPollEvent>("xrPollEvent");
	XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
	for (auto _ : state)
		if (poll(head.application.instance, &event) != XR_EVENT_UNAVAILABLE) state.SkipWithError("an event came");
}
BENCHMARK(pollWithoutEvents);

} // namespace
} // namespace arift
