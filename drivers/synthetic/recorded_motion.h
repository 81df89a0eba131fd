// Head motion from a recorded trajectory, smooth enough that an IMU can be derived from it.
#pragma once
#include "drivers/synthetic/motion.h"
#include "drivers/trajectory.h"
#include <filesystem>

namespace arift::synthetic
{

/// A `.brd` recording's reference poses, or the rows of a trajectory CSV, from the start. Throws InputError.
Trajectory readTrajectory(const std::filesystem::path &file);

/// A uniform cubic B-spline near the trajectory: the spline is the truth then. After `delay` seconds; at rest before and behind it.
std::unique_ptr<HeadMotion> makeRecorded(const Trajectory &trajectory, double delay);

} // namespace arift::synthetic
