// A ring of rendered camera images, as a recording: cameras without the cost of simulating them.
#pragma once
#include <filesystem>

namespace arift::bench
{

/// A second of 752 x 480 images of both cameras at 30 Hz, each of another brightness, stored without compression, and IMU samples of a
/// head at rest.
void writeRing(const std::filesystem::path &folder);

} // namespace arift::bench
