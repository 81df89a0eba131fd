// A head that a tracker follows while the test runs: a thousand samples per second, as a service publishes them, and cameras whose
// exposures the views refer to.
#pragma once
#include "runtime/motion/spaces.h"
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"

namespace arift
{

struct LiveHead {
	FakeService service;
	Application application{{"XR_MND_headless"}};
	const XrSession session = application.session();
	const XrSpace local = application.space(session, XR_REFERENCE_SPACE_TYPE_LOCAL);
	const XrSpace view = application.space(session, XR_REFERENCE_SPACE_TYPE_VIEW);
	const XrTime start = realTime();

	LiveHead()
	{
		for (XrTime time = start - second; time <= start; time += millisecond) push(time);
		ipc::TimingTable timing{};
		timing.displayPeriod = 16'690'000;
		timing.latchBeforeDisplay = 20 * millisecond;
		timing.cameras = {ipc::CameraTiming{start, 16 * millisecond, 10 * millisecond}, {start, 16 * millisecond, 10 * millisecond}};
		service.system().timing.write(timing);
		ipc::ViewTable views = *service.system().views.read();
		views.viewOffset = 1;
		service.system().views.write(views);
		tracker_ = std::jthread([this](const std::stop_token &stop) {
			for (XrTime time = start + millisecond; !stop.stop_requested(); time += millisecond) {
				while (realTime() < time) std::this_thread::sleep_for(std::chrono::nanoseconds(time - realTime()));
				push(time);
			}
		});
	}
	/// It turns about the vertical, at one radian per second.
	XrQuaternionf headAt(XrTime time) const { return rotationAbout({0, 1, 0}, inSeconds(time - start)); }
	/// A time about two frames ahead, another one with every call.
	XrTime nextTime()
	{
		asked_ = (asked_ + 7919) % (8 * millisecond);
		return newest_.load(std::memory_order_relaxed) + 30 * millisecond + asked_;
	}

private:
	void push(XrTime time)
	{
		service.poses().push({time, headAt(time), {0, 1, 0}, {0, 0, 0}});
		newest_ = time;
	}
	std::atomic<XrTime> newest_{0};
	XrDuration asked_ = 0;
	std::jthread tracker_;
};

} // namespace arift
