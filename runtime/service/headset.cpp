#include "runtime/service/headset.h"
#include "drivers/registry.h"
#include "runtime/base/error.h"
#include "runtime/motion/pose_history.h"
#include "runtime/optics/euroc_rig.h"
#include "runtime/optics/pixel_rays.h"
#include "runtime/service/device_threads.h"

namespace arift
{

Rig rigFor(const Config &config)
{
	if (config.rig != "recording") return readRig(findRig(config.rig));
	if (config.driver != "replay" || config.recording.empty())
		throw InputError("headset.rig = \"recording\" takes the calibration from replay.recording, expected headset.driver = \"replay\" "
						 "and a recording");
	return rigFromEuroc(config.recording);
}

std::unique_ptr<Driver> driverFor(const Config &config, const Rig &rig, Clock &clock)
{
	DriverContext context{.clock = clock, .configuration = config.file, .neckInHead = rig.pivotInHead};
	context.imuInHead = {rig.imu.imuInHead, {0, 0, 0}};
	for (size_t eye = 0; eye < std::min<size_t>(rig.cameras.size(), 2); ++eye) {
		const RigCamera &camera = rig.cameras[eye];
		context.geometry[eye] = {camera.model.width(), camera.model.height(), pixelRays(camera.model), camera.cameraInHead};
	}
	// "auto" takes what is plugged in; no hardware driver is built in yet, so that is the synthetic headset.
	return makeDriver(config.driver == "auto" ? "synthetic" : config.driver, context);
}

Headset::Headset(const Rig &rig, Driver &driver, Clock &clock, PoseRing &poses, std::array<CameraFeed *, 2> feeds, FrameAllocator allocate)
	: door_(std::make_unique<DriverDoor>(driver))
{
	for (uint32_t eye = 0; eye < 2; ++eye)
		if (eye < rig.cameras.size()) cameras_.push_back(std::make_unique<CameraThread>(rig, *door_, clock, *feeds[eye], allocate, eye));
	tracker_ = std::make_unique<TrackerThread>(rig, *door_, clock, poses);
	for (const auto &camera : cameras_) camera->start();
	tracker_->start();
}

Headset::~Headset() = default;

std::vector<CameraStatus> Headset::cameras()
{
	std::vector<CameraStatus> all;
	for (const auto &camera : cameras_) all.push_back(camera->status());
	return all;
}

TrackerStatus Headset::tracker() { return tracker_->status(); }

} // namespace arift
