// The simulated tracker on its simulated wire: the firmware model driven by the head's motion, tick by tick.
#pragma once
#include "drivers/dk1/transport.h"
#include "drivers/synthetic/firmware.h"
#include "drivers/synthetic/truth.h"
#include "drivers/synthetic/world.h"
#include <deque>

namespace arift::synthetic
{

struct WireSettings {
	SensorErrors errors;
	XrDuration latency = 0;      ///< from a report's newest sample to the host
	XrDuration controlDelay = 0; ///< until a feature report that the host sets takes effect
	XrPosef imuInHead = {{0, 0, 0, 1}, {0, 0, 0}};
};

/// Simulated time is the clock's: a report arrives when it would have, however late the host reads it.
class SyntheticTransport final : public dk1::Transport
{
public:
	/// `clock` outlives this. `truth` may be null.
	SyntheticTransport(Clock &clock, std::shared_ptr<const World> world, const WireSettings &settings, std::unique_ptr<TruthFile> truth);

	std::string name() const override { return "Synthetic DK1 tracker"; }
	Outcome read(std::span<std::byte> buffer, size_t &length, XrTime &arrival, XrTime deadline, std::stop_token stop) override;
	void post(std::span<const std::byte> feature) override;

private:
	void tick(bool hostPolls);
	XrTime nextTick() const { return firstTick_ + XrDuration(ticks_) * millisecond; }

	struct Waiting {
		XrTime time;
		std::vector<std::byte> bytes;
	};

	Clock &clock_;
	const std::shared_ptr<const World> world_;
	const WireSettings settings_;
	std::unique_ptr<TruthFile> truth_;
	Firmware firmware_;
	XrTime firstTick_;
	uint64_t ticks_ = 0;
	std::deque<Waiting> commands_;  ///< on their way to the device
	std::optional<Waiting> report_; ///< on its way to the host
};

} // namespace arift::synthetic
