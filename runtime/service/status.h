// What `arift status --json` shows.
#pragma once
#include "runtime/compositor/frame_record.h"
#include "runtime/device/camera.h"
#include "runtime/device/imu_tracker.h"
#include "runtime/service/config.h"
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace arift
{

nlohmann::json describe(const Figure &figure);

/// "service", "clock" and "frames".
nlohmann::json describeService(const Config &config, const FrameFigures &figures);

struct CameraStatus {
	bool open = false;
	CameraInfo info;
	double frameRate = 0; ///< measured, images per second of the system's clock
	uint64_t received = 0;
};
struct TrackerStatus {
	bool open = false;
	ImuInfo info;
	double rate = 0;   ///< measured, samples per second of the system's clock
	uint64_t lost = 0; ///< ticks missing between reports
};
/// "cameras" and "tracker" into `status`.
void describeDevices(nlohmann::json &status, const std::vector<CameraStatus> &cameras, const TrackerStatus &tracker);

} // namespace arift
