#include "runtime/service/system.h"
#include "runtime/base/log.h"
#include "runtime/ipc/request.h"
#include "runtime/service/build.h"
#include "runtime/service/decode.h"
#include <cmath>
#include <nlohmann/json.hpp>

namespace arift
{

namespace
{

bool wantsWindow(const Config &config)
{
	return config.target == TargetKind::window || (config.target == TargetKind::automatic && !windowExtensions().empty());
}

std::vector<const char *> extensionsFor(bool window) { return window ? windowExtensions() : std::vector<const char *>{}; }

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

ipc::Welcome welcomeOf(const Config &config, const Rig &rig, const Driver &driver, const gpu::DeviceIdentity &gpu)
{
	ipc::Welcome welcome;
	welcome.protocol = ipc::protocol;
	ipc::copyText(welcome.build, buildId);
	ipc::copyText(welcome.systemName, fmt::format("ARift ({})", driver.name()));
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
	views.floorBelowLocal = 1.6f;
	views.localInOrigin = identityPose;
	views.stageBounds = {2, 2};
}

Pacer::Settings pacingOf(const Rig &rig)
{
	return {.period = fromSeconds(1 / rig.timing.refreshRate),
			.vblankToDisplay = rig.timing.lineDelay((rig.lens.panel().height - 1) / 2.0)};
}

std::unique_ptr<Target> makeTarget(const Config &config, bool window, gpu::Device &device, Clock &clock, const Rig &rig)
{
	const Pacer::Settings pacing = pacingOf(rig);
	if (window) {
		try {
			return makeWindowTarget(device, clock, pacing, {rig.lens.panel().width, rig.lens.panel().height});
		} catch (const std::runtime_error &problem) {
			if (config.target == TargetKind::window) throw;
			log::warning("no window: {}", problem.what());
		}
	}
	return makeOffscreenTarget(clock, pacing.period);
}

} // namespace

System::System(World &world)
	: config_(world.config),
	  window_(wantsWindow(config_)),
	  device_(extensionsFor(window_)),
	  rig_(rigFor(config_)),
	  driver_(driverFor(config_, rig_, world.clock))
{
	identify(world);
	// Pipelines take a second on a software renderer; Hello is answered in the meantime.
	renderer_ = std::make_unique<PanelRenderer>(device_, rig_);
	// Held until every thread that sleeps on the clock has its own hold: a stepped world begins as a whole.
	const Clock::Hold hold(world.clock);
	headset_ = std::make_unique<Headset>(rig_, *driver_, world.clock, *world.poses, std::array{&feeds_[0], &feeds_[1]},
										 renderer_->frameAllocator());
	auto target = makeTarget(config_, window_, device_, world.clock, rig_);
	log::info("{} with rig \"{}\" on {}, {}", driver_->name(), rig_.name, device_.identity().name, target->name());
	CameraFeed *const right = &feeds_[rig_.cameras.size() == 1 ? 0 : 1]; // the only camera's images and timing are those of both eyes
	const Surroundings surroundings{world.clock, rig_, PoseHistory(*world.poses), *world.system, {&feeds_[0], right}};
	compositor_ =
		std::make_unique<Compositor>(surroundings, Pacer(pacingOf(rig_), world.clock.now()), makePanel(*renderer_, std::move(target)));
	compositor_->setPassthroughDistance(config_.passthroughDistance);
	world.opened.update([&](Opened &opened) {
		opened.stage = Stage::ready;
		opened.compositor = compositor_.get();
		opened.describeHeadset = [this](nlohmann::json &status) { describe(status); };
	});
}

System::~System() = default;

void System::identify(World &world)
{
	world.views.update([&](ipc::ViewTable &views) { setViews(views, config_, rig_); });
	world.opened.update([&](Opened &opened) {
		opened.stage = Stage::identified;
		opened.welcome = welcomeOf(config_, rig_, *driver_, device_.identity());
		opened.device = &device_;
	});
}

void System::describe(nlohmann::json &status)
{
	status["headset"] = {{"name", driver_->name()},
						 {"driver", config_.driver},
						 {"rig", rig_.name},
						 {"gpu", device_.identity().name},
						 {"validationMessages", device_.validationMessages()}};
	describeDevices(status, headset_->cameras(), headset_->tracker());
}

} // namespace arift
