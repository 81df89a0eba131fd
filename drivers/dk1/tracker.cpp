#include "drivers/dk1/tracker.h"
#include "drivers/dk1/features.h"
#include <algorithm>

namespace arift::dk1
{

namespace
{

constexpr uint16_t keepAliveMs = 10'000;
constexpr XrDuration keepAlivePeriod = 3 * second; // three may be lost before the device falls silent

} // namespace

Tracker::Tracker(Clock &clock, std::unique_ptr<Transport> transport, int reportRate) : clock_(clock), transport_(std::move(transport))
{
	// The power-on ranges of 2 g and 1.3 gauss saturate in use; 8 g quantises at 2.4 mm/s^2, far below the sensor's noise.
	transport_->post(encode(SensorRange{.command = ++command_, .accelerationG = 8, .degreesPerSecond = 2000, .milligauss = 2500}));
	transport_->post(encode(SensorConfig{.command = ++command_, .packetInterval = uint8_t(1000 / reportRate - 1)}));
	keepAlive();
}

ImuInfo Tracker::info() const
{
	return {.name = transport_->name(), .tickPeriod = 1e-3, .sampleRate = 1000, .malformed = decoder_.malformed()};
}

Outcome Tracker::read(ImuReport &report, XrTime deadline, std::stop_token stop)
{
	for (;;) {
		if (clock_.now() >= nextKeepAlive_) keepAlive();
		std::array<std::byte, paddedReportSize> buffer;
		size_t length = 0;
		XrTime arrival = 0;
		const XrTime wake = std::min(deadline, nextKeepAlive_);
		const Outcome outcome = transport_->read(buffer, length, arrival, wake, stop);
		if (outcome == Outcome::lost) return outcome;
		if (outcome == Outcome::ready && decoder_.decode(std::span(buffer).first(length), arrival, report)) return outcome;
		if (stop.stop_requested() || clock_.now() >= deadline) return Outcome::timeout;
	}
}

void Tracker::keepAlive()
{
	transport_->post(encode(KeepAlive{.command = ++command_, .intervalMs = keepAliveMs}));
	nextKeepAlive_ = clock_.now() + keepAlivePeriod;
}

} // namespace arift::dk1
