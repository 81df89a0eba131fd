// A stereo recording in the EuRoC layout with its calibration, whole enough to be replayed by the service with `rig = "recording"`.
#pragma once
#include <filesystem>

namespace arift::e2e
{

/// A second of 376 x 240 chequers at 20 Hz, those of the right camera brighter by far, and IMU samples at 200 Hz. The body frame has x up,
/// y left and z backwards; the head turns left at `yawRate` rad/s and is level.
void writeStereoRecording(const std::filesystem::path &folder, double yawRate);

} // namespace arift::e2e
