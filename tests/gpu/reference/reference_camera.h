// An OCamCalib camera (Scaramuzza, Martinelli & Siegwart 2006), written a second time for tests.
#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace arift::reference
{

struct Camera {
	int width = 0, height = 0;
	std::vector<double> direct;  ///< z(rho), lowest order first: the mapping where it is given
	std::vector<double> inverse; ///< else rho(theta), theta = atan(z / n)
	double centreRow = 0, centreColumn = 0;
	double c = 1, d = 0, e = 0;

	/// (column, row) that sees a direction (OpenXR axes: x right, y up, z backwards; any length); nothing beyond 89 degrees.
	std::optional<Eigen::Vector2d> see(const Eigen::Vector3d &direction) const;
	/// Unit direction, OpenXR axes, that the texel at (column, row) sees.
	Eigen::Vector3d look(const Eigen::Vector2d &texel) const;

private:
	/// Distance from the image centre at which a ray at `angle` radians off the axis is seen, before the affine part, and its inverse.
	std::optional<double> radius(double angle) const;
	double angle(double radius) const;
};

/// What a shipped Rig file says of its cameras and lens, read by this library's own few lines.
struct RigNumbers {
	std::array<Camera, 2> cameras;
	double eyeRelief = 0.010;
	bool spline = true;
};
/// Throws toml++'s error or std::runtime_error.
RigNumbers readRigNumbers(const std::filesystem::path &file);

} // namespace arift::reference
