// Where the sensors of a recording in the EuRoC/ASL folder layout lie: for its images and samples, and for its calibration.
#pragma once
#include <filesystem>
#include <string>

namespace arift
{

struct EurocFolder {
	std::filesystem::path sensors; ///< holds cam0, imu0 and, where the recording is a stereo one, cam1
	std::string name;              ///< of the recording, for people
	bool isStereo = false;
};

/// `recording`: the folder that holds mav0, or the one that holds the sensors. Throws InputError where neither has cam0.
EurocFolder findEuroc(const std::filesystem::path &recording);

} // namespace arift
