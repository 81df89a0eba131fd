// Recorded head poses by time, and reading them.
#pragma once
#include "runtime/base/pose.h"
#include <filesystem>
#include <vector>

namespace arift
{

/// Head in world (y up, looking along -z at rest), `seconds` from the recording's first sample.
struct TimedPose {
	double seconds = 0;
	glm::dquat orientation{1, 0, 0, 0};
	glm::dvec3 position{0};
};
/// Strictly rising in time, never empty.
using Trajectory = std::vector<TimedPose>;

/// Between the samples: position linearly, orientation along the shortest arc. Before the first and after the last: those.
TimedPose interpolate(const Trajectory &trajectory, double seconds);

/// The same motion in a world whose origin and -z axis are the first pose's position and heading.
Trajectory fromStart(const Trajectory &trajectory);

/// A text file with rows time_ns,px,py,pz,qw,qx,qy,qz (more columns are ignored). Throws InputError.
Trajectory readTrajectoryCsv(const std::filesystem::path &file);

} // namespace arift
