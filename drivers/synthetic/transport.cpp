#include "drivers/synthetic/transport.h"
#include <algorithm>

namespace arift::synthetic
{

namespace
{

/// The device has run for a while before anybody opens it: the first reports are a stale one and a backlog, as on the real one.
constexpr uint64_t ticksBeforeOpen = 300;
/// 48 microtesla, 65 degrees below the horizon, north along -z.
constexpr glm::dvec3 magneticField{0, -43.5e-6, -20.3e-6};
constexpr double temperature = 31.5;

} // namespace

SyntheticTransport::SyntheticTransport(Clock &clock, std::shared_ptr<const World> world, const WireSettings &settings,
									   std::unique_ptr<TruthFile> truth)
	: clock_(clock),
	  world_(std::move(world)),
	  settings_(settings),
	  truth_(std::move(truth)),
	  firmware_(settings.errors),
	  firstTick_(clock.now() - XrDuration(ticksBeforeOpen) * millisecond)
{
	while (ticks_ < ticksBeforeOpen) tick(false);
}

Outcome SyntheticTransport::read(std::span<std::byte> buffer, size_t &length, XrTime &arrival, XrTime deadline, std::stop_token stop)
{
	while (!report_ && nextTick() + settings_.latency <= deadline) tick(true);
	const XrTime wake = report_ ? std::min(report_->time, deadline) : deadline;
	if (!clock_.sleepUntil(wake, stop) || !report_ || report_->time > deadline) return Outcome::timeout;
	arrival = report_->time;
	length = std::min(buffer.size(), report_->bytes.size());
	std::copy_n(report_->bytes.begin(), length, buffer.begin());
	report_.reset();
	return Outcome::ready;
}

void SyntheticTransport::post(std::span<const std::byte> feature)
{
	commands_.push_back({clock_.now() + settings_.controlDelay, {feature.begin(), feature.end()}});
}

void SyntheticTransport::tick(bool hostPolls)
{
	const XrTime time = nextTick();
	while (!commands_.empty() && commands_.front().time <= time) {
		firmware_.setFeature(commands_.front().bytes);
		commands_.pop_front();
	}
	const HeadState head = world_->head(time);
	const ImuTruth truth = imuTruth(head, settings_.imuInHead);
	const glm::dquat worldInImu = glm::conjugate(head.orientation * toGlm(settings_.imuInHead.orientation));
	firmware_.tick({.acceleration = truth.specificForce,
					.angularVelocity = truth.angularVelocity,
					.magneticField = worldInImu * magneticField,
					.temperature = temperature});
	ticks_++;
	if (truth_ && hostPolls) truth_->write(time, head);
	if (!hostPolls) return;
	if (const auto report = firmware_.poll()) report_ = Waiting{time + settings_.latency, {report->begin(), report->end()}};
}

} // namespace arift::synthetic
