// A tracker that plays recorded IMU samples, each at its own time.
#pragma once
#include "drivers/replay/euroc.h"
#include "runtime/device/imu_tracker.h"

namespace arift::replay
{

struct ImuPlayback {
	std::string name;
	std::vector<RecordedImu> samples; ///< tracker axes; never empty, rising in time
	XrDuration length = 0;            ///< after which it begins again; more than the last sample's time
	double rate = 0;                  ///< nominal samples a second; a tick is one of them
	bool loop = true;
};

class PlayedTracker final : public ImuTracker
{
public:
	/// Recording time 0 is at `start`; playing begins with the first sample after now. `clock` outlives this.
	PlayedTracker(Clock &clock, XrTime start, ImuPlayback playback);

	ImuInfo info() const override;
	/// One sample a report. `lost` where a recording that is played once has ended.
	Outcome read(ImuReport &report, XrTime deadline, std::stop_token stop) override;

private:
	XrTime timeOf(uint64_t index) const;

	Clock &clock_;
	const XrTime start_;
	const ImuPlayback playback_;
	uint64_t next_ = 0; ///< counts samples over all repetitions
	int64_t lastTick_ = 0;
	bool isFirst_ = true;
};

} // namespace arift::replay
