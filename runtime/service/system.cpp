#include "runtime/service/system.h"
#include "runtime/base/log.h"
#include "runtime/ipc/request.h"
#include "runtime/service/build.h"
#include "runtime/service/decode.h"
#include "runtime/service/device_threads.h"
#include "runtime/service/lens_outline.h"
#include "runtime/service/places.h"
#include <cmath>
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

/// A composition that has lasted so long (real time) counts as good; one that has failed so often in a row is given up.
constexpr XrDuration lasting = 10 * second;
constexpr int mostFailures = 8;

XrFovf fovOf(const Rig &rig, Eye eye)
{
	const LensModel::Fov tangents = rig.lens.fov(eye, rig.interpupillaryDistance);
	return {float(-std::atan(tangents.left)), float(std::atan(tangents.right)), float(std::atan(tangents.up)),
			float(-std::atan(tangents.down))};
}

/// One texel of the view per panel pixel at the lens axis, where the lens magnifies most.
XrExtent2Di recommendedSize(const Rig &rig)
{
	const LensModel::Fov fov = rig.lens.fov(Eye::left, rig.interpupillaryDistance);
	const double scale = rig.lens.pixelsPerTangent();
	return {int32_t(std::ceil((fov.left + fov.right) * scale)), int32_t(std::ceil((fov.up + fov.down) * scale))};
}

std::string systemName(const std::string &headset) { return fmt::format("ARift ({})", headset); }

ipc::Welcome welcomeOf(const Config &config, const Rig &rig, const std::string &headset, const gpu::DeviceIdentity &gpu)
{
	ipc::Welcome welcome;
	welcome.protocol = ipc::protocol;
	ipc::copyText(welcome.build, buildId);
	ipc::copyText(welcome.systemName, systemName(headset));
	const XrExtent2Di size = recommendedSize(rig);
	welcome.recommendedWidth = uint32_t(size.width);
	welcome.recommendedHeight = uint32_t(size.height);
	welcome.maxWidth = welcome.maxHeight = Quota::extent;
	welcome.blendModeCount = uint32_t(config.blendModes.size());
	for (size_t i = 0; i < config.blendModes.size(); ++i) welcome.blendModes[i] = config.blendModes[i];
	welcome.deviceUuid = gpu.deviceUuid;
	welcome.driverUuid = gpu.driverUuid;
	welcome.deviceType = gpu.deviceType;
	welcome.steppedClock = config.clock == ClockMode::stepped;
	return welcome;
}

void setViews(ipc::ViewTable &views, const Config &config, const Rig &rig)
{
	views.eyeInHead = rig.eyeInHead;
	views.cameraInHead = rig.eyeInHead; // without cameras the views are the eyes at every offset
	for (size_t eye = 0; eye < 2; ++eye)
		if (const RigCamera *camera = rig.cameraFor(eye)) views.cameraInHead[eye] = camera->cameraInHead;
	views.fov = {fovOf(rig, Eye::left), fovOf(rig, Eye::right)};
	views.viewOffset = float(config.viewOffset);
	views.pivotInHead = rig.pivotInHead;
	views.floorBelowLocal = float(config.eyeHeight);
	views.localInOrigin = identityPose;
	views.stageBounds = {float(config.bounds[0]), float(config.bounds[1])};
}

} // namespace

System::System(World &world) : world_(world), config_(world.config), rig_(rigFor(config_)), composition_(makeComposition(false))
{
	const auto first = *composition_.lock();
	devices_ = std::make_unique<Devices>(
		Devices::Context{config_, rig_, world.clock, *world.poses, {&feeds_[0], &feeds_[1]}, realtimeFor("tracker"), sysfs()});
	tellHeadset(); // before anybody hears of the service
	identify(first->device().identity());
	first->makeRenderer(); // pipelines take a second on a software renderer; Hello is answered in the meantime
	// Held until every thread that sleeps on the clock has its own hold: a stepped world begins as a whole.
	const Clock::Hold hold(world.clock);
	devices_->open();
	compose(first);
}

System::~System()
{
	world_.opened.update([](Opened &opened) {
		opened.device.reset();
		opened.compositor.reset();
		opened.describeHeadset = {};
	});
	(*composition_.lock())->stop();
}

std::shared_ptr<Composition> System::makeComposition(bool again)
{
	return std::make_shared<Composition>(Composition::Purpose{config_, rig_, wantsWindow(config_), again});
}

/// A software renderer computes for many milliseconds on every processor: before everything else, nothing else would be done.
std::function<void()> System::realtimeFor(const char *thread)
{
	const auto composition = *composition_.lock();
	if (composition->device().identity().deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) return {};
	return [this, thread] { world_.realtime.askFor(thread); };
}

void System::identify(const gpu::DeviceIdentity &gpu)
{
	world_.views.update([&](ipc::ViewTable &views) { setViews(views, config_, rig_); });
	world_.system->lensOutlines.write(
		{lensOutline(rig_.lens, Eye::left, fovOf(rig_, Eye::left)), lensOutline(rig_.lens, Eye::right, fovOf(rig_, Eye::right))});
	world_.opened.update([&](Opened &opened) {
		opened.stage = Stage::identified;
		opened.welcome = welcomeOf(config_, rig_, devices_->name(), gpu);
	});
}

void System::tellHeadset()
{
	const std::string problem = devices_->problem();
	ipc::HeadsetState state;
	state.isMissing = problem.empty() ? 0 : 1;
	ipc::copyText(state.problem, problem);
	world_.system->headset.write(state);
	world_.opened.update([&](Opened &opened) {
		opened.headsetProblem = problem;
		++opened.headset;
		ipc::copyText(opened.welcome.systemName, systemName(devices_->name()));
	});
}

bool System::followHeadset()
{
	const Clock::Hold hold(world_.clock);
	if (!devices_->follow()) return false;
	tellHeadset();
	return true;
}

void System::compose(const std::shared_ptr<Composition> &composition)
{
	CameraFeed *const right = &feeds_[rig_.cameras.size() == 1 ? 0 : 1]; // the only camera's images and timing are those of both eyes
	composition->start({world_.clock,
						rig_,
						PoseHistory(*world_.poses),
						*world_.system,
						{&feeds_[0], right},
						world_.trace.get(),
						realtimeFor("compositor"),
						world_.config.nearerOver});
	composedSince_ = realTime();
	*composition_.lock() = composition;
}

void System::announce()
{
	const auto composition = *composition_.lock();
	world_.opened.update([&](Opened &opened) {
		opened.stage = Stage::ready;
		opened.device = {composition, &composition->device()};
		opened.compositor = {composition, composition->compositor()};
		opened.describeHeadset = [this](nlohmann::json &status) { describe(status); };
	});
}

void System::recompose(const std::string &problem, const std::stop_token &stop)
{
	log::error("no images can be made: {}; GPU and compositor are opened anew", problem);
	const auto clock = makeRealClock(); // the system's own may be a stepped one, which waits for the compositor
	BackOff backOff;
	if (realTime() - composedSince_ > lasting) failures_ = 0;
	for (std::string last = problem; !stop.stop_requested();) {
		if (++failures_ > mostFailures) throw std::runtime_error(fmt::format("given up after {} attempts: {}", mostFailures, last));
		if (failures_ > 1 && !clock->sleepUntil(realTime() + backOff.next(), stop)) return;
		try {
			const auto composition = makeComposition(true);
			composition->makeRenderer();
			compose(composition);
			log::info("images are made again");
			announce();
			return;
		} catch (const std::exception &next) {
			last = next.what();
			log::error("no images can be made: {}", last);
		}
	}
}

void System::describe(nlohmann::json &status)
{
	const auto composition = *composition_.lock();
	status["headset"] = {{"driver", config_.driver},
						 {"rig", rig_.name},
						 {"gpu", composition->device().identity().name},
						 {"validationMessages", composition->device().validationMessages()}};
	devices_->describe(status);
}

} // namespace arift
