// The host's side of a DK1 tracker: sets it up, keeps it alive, decodes what it sends. The same for the real device and its model.
#pragma once
#include "drivers/dk1/report.h"
#include "drivers/dk1/transport.h"
#include "runtime/device/imu_tracker.h"
#include <memory>

namespace arift::dk1
{

class Tracker final : public ImuTracker
{
public:
	/// `reportRate` 1000, 500 or 250 input reports a second. `clock` outlives this.
	Tracker(Clock &clock, std::unique_ptr<Transport> transport, int reportRate);

	ImuInfo info() const override;
	Outcome read(ImuReport &report, XrTime deadline, std::stop_token stop) override;

private:
	void keepAlive();

	Clock &clock_;
	std::unique_ptr<Transport> transport_;
	ReportDecoder decoder_;
	XrTime nextKeepAlive_ = 0;
	uint16_t command_ = 0;
};

} // namespace arift::dk1
