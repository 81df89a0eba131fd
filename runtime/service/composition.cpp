#include "runtime/service/composition.h"
#include "runtime/base/log.h"

namespace arift
{

namespace
{

std::vector<const char *> extensionsFor(bool window) { return window ? windowExtensions() : std::vector<const char *>{}; }

Pacer::Settings pacingOf(const Rig &rig)
{
	return {.period = fromSeconds(1 / rig.timing.refreshRate),
			.vblankToDisplay = rig.timing.lineDelay((rig.lens.panel().height - 1) / 2.0)};
}

} // namespace

bool wantsWindow(const Config &config)
{
	return config.target == TargetKind::window || (config.target == TargetKind::automatic && !windowExtensions().empty());
}

Composition::Composition(const Purpose &purpose) : purpose_(purpose), device_(extensionsFor(purpose.window)) {}

Composition::~Composition() = default;

void Composition::makeRenderer()
{
	renderer_ = std::make_unique<PanelRenderer>(device_, purpose_.rig, VK_FORMAT_R8G8B8A8_SRGB, Unready::leftOut);
	renderer_->warmUp();
}

std::unique_ptr<Target> Composition::makeTarget(Clock &clock)
{
	const Pacer::Settings pacing = pacingOf(purpose_.rig);
	if (purpose_.window) {
		try {
			return makeWindowTarget(device_, clock, pacing, {purpose_.rig.lens.panel().width, purpose_.rig.lens.panel().height});
		} catch (const std::runtime_error &problem) {
			if (purpose_.config.target == TargetKind::window && !purpose_.again) throw;
			log::warning("no window: {}", problem.what());
		}
	}
	return makeOffscreenTarget(clock, pacing.period);
}

void Composition::start(const Surroundings &surroundings)
{
	const Pacer::Settings pacing = pacingOf(purpose_.rig);
	auto target = makeTarget(surroundings.clock);
	log::info("{}, {}", device_.identity().name, target->name());
	auto panel = makePanel(*renderer_, std::move(target), makeOffscreenTarget(surroundings.clock, pacing.period));
	compositor_ = std::make_unique<Compositor>(surroundings, Pacer(pacing, surroundings.clock.now()), std::move(panel));
	compositor_->setPassthroughDistance(purpose_.config.passthroughDistance);
}

} // namespace arift
