// Usenko, Demmel & Cremers, "The Double Sphere Camera Model" (2018), equations 40 to 50.
#include "runtime/base/error.h"
#include "runtime/optics/models.h"
#include <cmath>
#include <limits>

namespace arift::models
{

namespace
{

/// Equation 40 for a unit direction; NaN outside the domain.
double curve(const DoubleSphere &camera, double angle)
{
	const double sine = std::sin(angle), shifted = std::cos(angle) + camera.xi;
	const double denominator = camera.alpha * std::hypot(sine, shifted) + (1 - camera.alpha) * shifted;
	return denominator > 0 ? sine / denominator : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

const char *name(const DoubleSphere &) { return "double_sphere"; }

void check(const DoubleSphere &camera)
{
	checkPinholePart(camera.fx, camera.fy, camera.cx, camera.cy);
	if (!(camera.alpha >= 0 && camera.alpha <= 1)) throw InputError("alpha = {}, expected a number from 0 to 1", camera.alpha);
	if (!(camera.xi > -1 && camera.xi < 10)) throw InputError("xi = {}, expected a number from -1 to 10", camera.xi);
}

Plane plane(const DoubleSphere &camera) { return {.centre = {camera.cx, camera.cy}, .affine = glm::dmat2(camera.fx, 0, 0, camera.fy)}; }

Extent extent(const DoubleSphere &camera, Extent limit)
{
	return followAngle([&](double a) { return curve(camera, a); }, limit);
}

double radius(const DoubleSphere &camera, double angle, const Extent &) { return curve(camera, angle); }

double angle(const DoubleSphere &camera, double radius, const Extent &)
{
	const double a = camera.alpha, xi = camera.xi, r2 = radius * radius;
	const double z = (1 - a * a * r2) / (a * std::sqrt(std::max(0.0, 1 - (2 * a - 1) * r2)) + 1 - a);
	const double scale = (z * xi + std::sqrt(std::max(0.0, z * z + (1 - xi * xi) * r2))) / (z * z + r2);
	return std::atan2(scale * radius, scale * z - xi);
}

} // namespace arift::models
