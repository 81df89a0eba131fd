// What the calls cost that an application makes several times a frame, through the entry points, against live shared pages: a tracker
// writes a thousand samples per second, and every call asks for another time.
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"
#include <benchmark/benchmark.h>

namespace arift
{
namespace
{

struct Scene {
	FakeService service;
	Application application{{"XR_MND_headless"}};
	XrSession session = application.session();
	XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	XrSpace view = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW);
	const XrTime newest = realTime();

	Scene()
	{
		for (XrTime time = newest - second; time <= newest; time += millisecond) push(time);
		ipc::TimingTable timing{};
		timing.displayPeriod = 16'690'000;
		timing.latchBeforeDisplay = 20 * millisecond;
		timing.cameras = {ipc::CameraTiming{newest, 16 * millisecond, 10 * millisecond}, {newest, 16 * millisecond, 10 * millisecond}};
		service.system().timing.write(timing);
		ipc::ViewTable views = *service.system().views.read();
		views.viewOffset = 1;
		service.system().views.write(views);
		tracker_ = std::jthread([this](const std::stop_token &stop) {
			for (XrTime time = newest + millisecond; !stop.stop_requested(); time += millisecond) {
				while (realTime() < time) std::this_thread::sleep_for(std::chrono::nanoseconds(time - realTime()));
				push(time);
			}
		});
	}
	void push(XrTime time)
	{
		latest_ = time;
		service.poses().push({time, rotationAbout({0, 1, 0}, inSeconds(time % second)), {0, 1, 0}, {0, 0, 0}});
	}
	/// Another one each time, about two frames ahead.
	XrTime nextTime()
	{
		asked_ = (asked_ + 7919) % (8 * millisecond);
		return latest_ + 30 * millisecond + asked_;
	}

private:
	std::atomic<XrTime> latest_{0};
	XrDuration asked_ = 0;
	std::jthread tracker_;
};

void locateViews(benchmark::State &state)
{
	Scene scene;
	XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 0, scene.local};
	const auto locate = scene.application.get<PFN_xrLocateViews>("xrLocateViews");
	XrViewState viewState{XR_TYPE_VIEW_STATE};
	XrView views[2] = {{XR_TYPE_VIEW}, {XR_TYPE_VIEW}};
	uint32_t count = 0;
	for (auto _ : state) {
		info.displayTime = scene.nextTime();
		if (locate(scene.session, &info, &viewState, 2, &count, views) != XR_SUCCESS || viewState.viewStateFlags == 0)
			state.SkipWithError("xrLocateViews found nothing");
	}
}
BENCHMARK(locateViews);

void locateSpaceWithVelocity(benchmark::State &state)
{
	Scene scene;
	const auto locate = scene.application.get<PFN_xrLocateSpace>("xrLocateSpace");
	XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
	XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity};
	for (auto _ : state)
		if (locate(scene.view, scene.local, scene.nextTime(), &location) != XR_SUCCESS || location.locationFlags == 0)
			state.SkipWithError("xrLocateSpace found nothing");
}
BENCHMARK(locateSpaceWithVelocity);

void pollWithoutEvents(benchmark::State &state)
{
	Scene scene;
	scene.application.states();
	const auto poll = scene.application.get<PFN_xrPollEvent>("xrPollEvent");
	XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
	for (auto _ : state)
		if (poll(scene.application.instance, &event) != XR_EVENT_UNAVAILABLE) state.SkipWithError("an event came");
}
BENCHMARK(pollWithoutEvents);

} // namespace
} // namespace arift
