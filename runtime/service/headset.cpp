#include "runtime/service/headset.h"
#include "drivers/registry.h"
#include "runtime/base/toml_document.h"
#include "runtime/motion/pose_history.h"
#include "runtime/optics/euroc_rig.h"
#include "runtime/optics/pixel_rays.h"
#include "runtime/service/device_threads.h"

namespace arift
{

namespace
{

namespace fs = std::filesystem;

fs::path rigFile(const Config &config)
{
	TomlTable headset = rootOf(config.document).table("headset");
	if (isRigPath(config.rig)) {
		const fs::path file = headset.path("rig");
		if (!fs::is_regular_file(file)) headset.complain("rig", fmt::format("a rig, and {} is no file", file.string()));
		return file;
	}
	const auto places = rigPlaces(config.rig);
	for (const fs::path &place : places)
		if (fs::is_regular_file(place)) return place;
	headset.complain("rig", fmt::format("the name of a rig in {}, {} or {}", places[0].parent_path().string(),
										places[1].parent_path().string(), places[2].parent_path().string()));
}

} // namespace

Rig rigFor(const Config &config)
{
	if (config.rig != "recording") return readRig(rigFile(config));
	if (config.driver != "replay" || config.recording.empty())
		rootOf(config.document)
			.table("headset")
			.complain("rig", R"(headset.driver = "replay" and a replay.recording with it, from which the calibration is taken)");
	return rigFromEuroc(config.recording);
}

std::unique_ptr<Driver> driverFor(const Config &config, const Rig &rig, Clock &clock)
{
	DriverContext context{.clock = clock, .configuration = config.document, .neckInHead = rig.pivotInHead};
	context.imuInHead = {rig.imu.imuInHead, {0, 0, 0}};
	for (size_t eye = 0; eye < std::min<size_t>(rig.cameras.size(), 2); ++eye) {
		const RigCamera &camera = rig.cameras[eye];
		context.geometry[eye] = {camera.model.width(), camera.model.height(), pixelRays(camera.model), camera.cameraInHead};
	}
	return makeDriver(config.driver, context);
}

Headset::Headset(const Rig &rig, Driver &driver, Clock &clock, PoseRing &poses, std::array<CameraFeed *, 2> feeds, FrameAllocator allocate,
				 std::function<void()> trackerBegins)
	: door_(std::make_unique<DriverDoor>(driver))
{
	for (uint32_t eye = 0; eye < 2; ++eye)
		if (eye < rig.cameras.size()) cameras_.push_back(std::make_unique<CameraThread>(rig, *door_, clock, *feeds[eye], allocate, eye));
	tracker_ = std::make_unique<TrackerThread>(rig, *door_, clock, poses, std::move(trackerBegins));
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
