// The threads that read one device each, and open it again when it is lost.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/service/headset.h"
#include <deque>
#include <mutex>

namespace arift
{

/// How long to wait before a lost device is tried again: 100 ms, then twice as long each time, at most five seconds. Pure.
class BackOff
{
public:
	XrDuration next() { return std::exchange(wait_, std::min(2 * wait_, 5 * second)); }
	void reset() { wait_ = 100 * millisecond; }

private:
	XrDuration wait_ = 100 * millisecond;
};

/// Events per second from their times; over about the last two seconds. Pure.
class RateMeter
{
public:
	void add(XrTime time, uint32_t events = 1);
	double rate() const;

private:
	struct Tick {
		XrTime time;
		uint64_t total;
	};
	std::deque<Tick> ticks_;
	uint64_t total_ = 0;
};

/// Drivers are thread-bound and shared by the devices' threads: opening again is one at a time.
class DriverDoor
{
public:
	explicit DriverDoor(Driver &driver) : driver_(driver) {}
	std::unique_ptr<ImuTracker> openTracker();
	std::unique_ptr<Camera> openCamera(uint32_t eye, const FrameAllocator &allocate);

private:
	std::mutex mutex_;
	Driver &driver_;
};

struct Headset::CameraThread {
	CameraThread(const Rig &rig, DriverDoor &door, Clock &clock, CameraFeed &feed, FrameAllocator allocate, uint32_t eye);
	void start();
	CameraStatus status() { return *status_.lock(); }

private:
	void run(std::stop_token stop);
	bool reopen(BackOff &backOff, std::stop_token stop);
	Outcome readOne(const std::stop_token &stop);
	void take(CameraFrame frame);

	const RigCamera &calibration_;
	DriverDoor &door_;
	Clock &clock_;
	CameraFeed &feed_;
	const FrameAllocator allocate_;
	const uint32_t eye_;
	std::unique_ptr<Camera> camera_;
	RateMeter rate_;
	Guarded<CameraStatus> status_{};
	std::jthread thread_;
};

struct Headset::TrackerThread {
	TrackerThread(const Rig &rig, DriverDoor &door, Clock &clock, PoseRing &poses, std::function<void()> begins);
	void start();
	TrackerStatus status() { return *status_.lock(); }

private:
	void run(std::stop_token stop);
	bool reopen(BackOff &backOff, std::stop_token stop);
	Outcome readOne(ImuReport &report, const std::stop_token &stop);

	const Rig &rig_;
	DriverDoor &door_;
	Clock &clock_;
	PoseRing &poses_;
	const std::function<void()> begins_;
	std::unique_ptr<ImuTracker> tracker_;
	Guarded<TrackerStatus> status_{};
	std::jthread thread_;
};

} // namespace arift
