#include "tests/gpu/reference/reference_camera.h"
#include <cmath>

namespace arift::reference
{

double Camera::depth(double rho) const
{
	double z = 0;
	for (size_t i = direct.size(); i-- > 0;) z = z * rho + direct[i];
	return z;
}

double Camera::slope(double rho) const
{
	double z = 0;
	for (size_t i = direct.size(); i-- > 1;) z = z * rho + double(i) * direct[i];
	return z;
}

std::optional<Eigen::Vector2d> Camera::see(const Eigen::Vector3d &direction) const
{
	// OCamCalib: x down the rows, y along the columns, z towards the viewer's back: OpenXR's (-y, x, z).
	const double x = -direction.y(), y = direction.x(), z = direction.z();
	const double n = std::hypot(x, y);
	if (n == 0) return z < 0 ? std::optional(Eigen::Vector2d(centreColumn, centreRow)) : std::nullopt;
	const double perRho = z / n;
	if (std::atan2(n, -z) > 89 * M_PI / 180) return std::nullopt;
	// The smallest positive root of depth(rho) = rho z / n: bracketed from the axis outwards, then Newton inside the bracket.
	const auto difference = [&](double rho) { return depth(rho) - rho * perRho; };
	const double limit = 2.0 * std::hypot(width, height), step = limit / 64;
	double low = 0, high = step;
	while (difference(high) < 0) {
		low = high;
		if ((high += step) > limit) return std::nullopt;
	}
	double rho = (low + high) / 2;
	for (int i = 0; i < 60; ++i) {
		const double value = difference(rho);
		(value < 0 ? low : high) = rho;
		double next = rho - value / (slope(rho) - perRho);
		if (!(next > low && next < high)) next = (low + high) / 2;
		if (std::abs(next - rho) < 1e-10) break;
		rho = next;
	}
	const double u = x / n * rho, v = y / n * rho;
	return Eigen::Vector2d(e * u + v + centreColumn, c * u + d * v + centreRow);
}

Eigen::Vector3d Camera::look(const Eigen::Vector2d &texel) const
{
	const double column = texel.x() - centreColumn, row = texel.y() - centreRow;
	const double determinant = c - d * e;
	const double u = (row - d * column) / determinant, v = (c * column - e * row) / determinant;
	return Eigen::Vector3d(v, -u, depth(std::hypot(u, v))).normalized();
}

} // namespace arift::reference
