// Recordings in the EuRoC layout, written sensor by sensor.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace arift::test
{

/// A pinhole camera with a little distortion, as its sensor.yaml and data.csv tell of it; images are the caller's.
struct EurocCamera {
	std::string inBody; ///< the sensor in the body frame, three rows of four
	uint32_t width = 0, height = 0;
	double focalLength = 0; ///< pixels; the centre is the image's
	int rate = 20;          ///< images per second
	int images = 20;
};
constexpr int64_t eurocBegin = 1'403'715'273'262'142'976; ///< nanoseconds since 1970: of a recording's first image

/// `write(file, number)` writes one image.
void writeEurocCamera(const std::filesystem::path &folder, const EurocCamera &camera,
					  const std::function<void(const std::filesystem::path &, int)> &write);
/// Two seconds of 200 Hz, from half a second before the first image: the same angular velocity (rad/s) and acceleration (m/s²) throughout,
/// in the axes of the body.
void writeEurocImu(const std::filesystem::path &folder, const std::array<double, 3> &angularVelocity,
				   const std::array<double, 3> &acceleration);

} // namespace arift::test
