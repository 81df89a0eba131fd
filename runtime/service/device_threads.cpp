#include "runtime/service/device_threads.h"
#include "runtime/base/log.h"
#include "runtime/motion/pose_history.h"
#include "runtime/tracking/head_tracker.h"

namespace arift
{

namespace
{

/// Reads are asked to end this often even when nothing comes, so that figures stay fresh.
constexpr XrDuration readLimit = second;

/// The tracker is taken to be where the head's origin is: Rigs do not say more, and it is within centimetres of that.
HeadTrackerSettings trackingOf(const Rig &rig, const ImuInfo &info)
{
	HeadTrackerSettings settings;
	if (info.isWorn) settings.leverInHead = -toGlm(rig.pivotInHead);
	return settings;
}

} // namespace

void RateMeter::add(XrTime time, uint32_t events)
{
	total_ += events;
	ticks_.push_back({time, total_});
	while (ticks_.size() > 2 && time - ticks_.front().time > 2 * second) ticks_.pop_front();
}

double RateMeter::rate() const
{
	if (ticks_.size() < 2 || ticks_.back().time <= ticks_.front().time) return 0;
	return double(ticks_.back().total - ticks_.front().total) / inSeconds(ticks_.back().time - ticks_.front().time);
}

std::unique_ptr<ImuTracker> DriverDoor::openTracker()
{
	std::lock_guard lock(mutex_);
	return driver_.openTracker();
}

std::unique_ptr<Camera> DriverDoor::openCamera(uint32_t eye, const FrameAllocator &allocate)
{
	std::lock_guard lock(mutex_);
	return driver_.openCamera(eye, allocate);
}

// ---- camera

Headset::CameraThread::CameraThread(const Rig &rig, DriverDoor &door, Clock &clock, CameraFeed &feed, FrameAllocator allocate, uint32_t eye)
	: calibration_(rig.cameras[eye]),
	  door_(door),
	  clock_(clock),
	  feed_(feed),
	  allocate_(std::move(allocate)),
	  eye_(eye),
	  camera_(door.openCamera(eye, allocate_))
{
	if (!camera_) {
		log::warning("{} camera: not there", eye_ == 0 ? "left" : "right");
		return;
	}
	status_.update([&](CameraStatus &status) { status = {.open = true, .info = camera_->info()}; });
}

void Headset::CameraThread::start()
{
	thread_ = std::jthread([this, hold = Clock::Hold(clock_)](std::stop_token stop) { run(std::move(stop)); });
}

void Headset::CameraThread::take(CameraFrame frame)
{
	frame.midExposure += calibration_.timeOffset;
	if (calibration_.bayer >= 0) frame.format = PixelFormat(calibration_.bayer);
	rate_.add(frame.midExposure);
	const CameraInfo info = camera_->info();
	feed_.put({std::move(frame), info.blackLevel, info.whiteBalance, info.linear}, clock_.now());
	status_.update([&](CameraStatus &status) {
		status.info = info;
		status.frameRate = rate_.rate();
		status.received++;
	});
}

bool Headset::CameraThread::reopen(BackOff &backOff, std::stop_token stop)
{
	if (!clock_.sleepUntil(clock_.now() + backOff.next(), std::move(stop))) return false;
	try {
		camera_ = door_.openCamera(eye_, allocate_);
	} catch (const std::exception &problem) {
		log::warning("{} camera: {}", eye_ == 0 ? "left" : "right", problem.what());
	}
	if (!camera_) return true;
	log::info("{} camera: open again", eye_ == 0 ? "left" : "right");
	status_.update([&](CameraStatus &status) { status.open = true; });
	return true;
}

/// A driver that throws has lost its device.
Outcome Headset::CameraThread::readOne(const std::stop_token &stop)
{
	try {
		CameraFrame frame;
		const Outcome outcome = camera_->read(frame, clock_.now() + readLimit, stop);
		if (outcome == Outcome::ready) take(std::move(frame));
		return outcome;
	} catch (const std::exception &problem) {
		log::error("{} camera: {}", eye_ == 0 ? "left" : "right", problem.what());
		return Outcome::lost;
	}
}

void Headset::CameraThread::run(std::stop_token stop)
{
	BackOff backOff;
	while (!stop.stop_requested()) {
		if (!camera_) {
			if (!reopen(backOff, stop)) return;
			continue;
		}
		switch (readOne(stop)) {
		case Outcome::timeout: break;
		case Outcome::ready: backOff.reset(); break;
		case Outcome::lost:
			log::warning("{} camera: lost", eye_ == 0 ? "left" : "right");
			feed_.lose();
			camera_.reset();
			status_.update([](CameraStatus &status) { status.open = false; });
			break;
		}
	}
}

// ---- tracker

Headset::TrackerThread::TrackerThread(const Rig &rig, DriverDoor &door, Clock &clock, PoseRing &poses, std::function<void()> begins)
	: rig_(rig), door_(door), clock_(clock), poses_(poses), begins_(std::move(begins)), tracker_(door.openTracker())
{
	if (!tracker_) {
		log::warning("head tracker: not there");
		return;
	}
	status_.update([&](TrackerStatus &status) { status = {.open = true, .info = tracker_->info()}; });
}

void Headset::TrackerThread::start()
{
	thread_ = std::jthread([this, hold = Clock::Hold(clock_)](std::stop_token stop) { run(std::move(stop)); });
}

bool Headset::TrackerThread::reopen(BackOff &backOff, std::stop_token stop)
{
	if (!clock_.sleepUntil(clock_.now() + backOff.next(), std::move(stop))) return false;
	try {
		tracker_ = door_.openTracker();
	} catch (const std::exception &problem) {
		log::warning("head tracker: {}", problem.what());
	}
	if (!tracker_) return true;
	log::info("head tracker: open again");
	status_.update([&](TrackerStatus &status) { status.open = true; });
	return true;
}

Outcome Headset::TrackerThread::readOne(ImuReport &report, const std::stop_token &stop)
{
	try {
		return tracker_->read(report, clock_.now() + readLimit, stop);
	} catch (const std::exception &problem) {
		log::error("head tracker: {}", problem.what());
		return Outcome::lost;
	}
}

void Headset::TrackerThread::run(std::stop_token stop)
{
	BackOff backOff;
	if (begins_) begins_();
	PoseWriter writer(poses_);
	std::optional<HeadTracker> motion; // lives on when the device is lost: the heading stands
	bool reopened = false;
	while (!stop.stop_requested()) {
		if (!tracker_) {
			if (!reopen(backOff, stop)) return;
			reopened = true;
			continue;
		}
		if (!motion) motion.emplace(tracker_->info(), rig_.imu, writer, trackingOf(rig_, tracker_->info()));
		ImuReport report;
		switch (readOne(report, stop)) {
		case Outcome::timeout: break;
		case Outcome::ready:
			backOff.reset();
			report.restarted |= std::exchange(reopened, false);
			motion->add(report);
			status_.update([&](TrackerStatus &status) {
				status.info = tracker_->info();
				status.rate = motion->health().rate;
				status.lost = motion->health().lostTicks;
			});
			break;
		case Outcome::lost:
			log::warning("head tracker: lost");
			tracker_.reset();
			status_.update([](TrackerStatus &status) { status.open = false; });
			break;
		}
	}
}

} // namespace arift
