#include "drivers/synthetic/driver.h"
#include "drivers/dk1/tracker.h"
#include "drivers/synthetic/images.h"
#include "drivers/synthetic/recorded_motion.h"
#include "drivers/synthetic/transport.h"
#include "runtime/base/toml_document.h"

namespace arift::synthetic
{

namespace
{

std::shared_ptr<const HeadMotion> makeMotion(const Settings &settings, const glm::dvec3 &neckInHead)
{
	switch (settings.motion) {
	case MotionKind::rest: return makeRest();
	case MotionKind::constant: return makeConstantRate(settings.rate, settings.motionDelay, neckInHead);
	case MotionKind::natural: return makeNatural(settings.seed, settings.motionDelay, neckInHead);
	case MotionKind::file: return makeRecorded(readTrajectory(settings.motionFile), settings.motionDelay);
	}
	return makeRest();
}

class SyntheticDriver final : public Driver
{
public:
	explicit SyntheticDriver(const DriverContext &context) : context_(context), settings_(readSettings(context.configuration))
	{
		if (settings_.motion == MotionKind::file && !std::filesystem::is_regular_file(settings_.motionFile))
			rootOf(context.configuration)
				.table("synthetic")
				.complain("motion_file", fmt::format("a trajectory or .brd file, and {} is no file", settings_.motionFile.string()));
		auto world = std::make_shared<World>();
		world->start = context.clock.now();
		world->motion = makeMotion(settings_, settings_.neck.value_or(toGlm(context.neckInHead)));
		world_ = std::move(world);
	}

	std::string name() const override { return "synthetic headset"; }

	std::unique_ptr<ImuTracker> openTracker() override
	{
		const WireSettings wire{.errors = settings_.errors, .latency = settings_.trackerLatency, .imuInHead = context_.imuInHead};
		auto truth = settings_.truth.empty() ? nullptr : std::make_unique<TruthFile>(settings_.truth, settings_.markers);
		auto transport = std::make_unique<SyntheticTransport>(context_.clock, world_, wire, std::move(truth));
		return std::make_unique<dk1::Tracker>(context_.clock, std::move(transport), settings_.reportRate);
	}

	std::unique_ptr<Camera> openCamera(uint32_t eye, FrameAllocator allocate) override
	{
		if (eye >= context_.geometry.size() || context_.geometry[eye].rays.empty()) return nullptr;
		if (!scene_) scene_ = std::make_shared<const Scene>(makeRoom());
		auto images = std::make_unique<SyntheticImages>(world_, scene_, settings_, context_.geometry[eye], eye);
		return std::make_unique<PlayedCamera>(context_.clock, std::move(images), allocate);
	}

private:
	const DriverContext context_;
	const Settings settings_;
	std::shared_ptr<const World> world_;
	std::shared_ptr<const Scene> scene_;
};

} // namespace

void checkSettings(const std::shared_ptr<const TomlDocument> &configuration) { readSettings(configuration); }

std::unique_ptr<Driver> makeDriver(const DriverContext &context) { return std::make_unique<SyntheticDriver>(context); }

} // namespace arift::synthetic
