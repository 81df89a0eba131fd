// Mei & Rives, "Single View Point Omnidirectional Camera Calibration from Planar Grids" (2007): onto the unit sphere, from there onto a
// plane through a centre moved by xi, then radial and tangential distortion. OpenCV's omnidir module without skew, Kalibr's omni-radtan.
#include "runtime/base/error.h"
#include "runtime/optics/models.h"
#include "runtime/optics/radial_distortion.h"
#include <limits>

namespace arift::models
{

namespace
{

/// |t|: where the direction meets the normalised plane; NaN where it does not.
double planeRadius(const Mei &camera, double angle)
{
	const double denominator = std::cos(angle) + camera.xi;
	// Beyond cos = -1/xi the sphere's far side folds back onto the plane: a large distortion must not hide that.
	if (!(denominator > 0) || 1 + camera.xi * std::cos(angle) < 0) return std::numeric_limits<double>::quiet_NaN();
	return std::sin(angle) / denominator;
}

} // namespace

const char *name(const Mei &) { return "mei"; }

void check(const Mei &camera)
{
	checkPinholePart(camera.fx, camera.fy, camera.cx, camera.cy);
	checkFinite("the distortion", camera.k);
	if (!(camera.xi >= 0 && camera.xi < 100)) throw InputError("xi = {}, expected a number from 0 to 100", camera.xi);
}

Plane plane(const Mei &camera)
{
	return {.centre = {camera.cx, camera.cy},
			.affine = glm::dmat2(camera.fx, 0, 0, camera.fy),
			.tangential = {camera.k[2], camera.k[3]},
			.xi = camera.xi};
}

Extent extent(const Mei &camera, Extent limit)
{
	return followAngle([&](double a) { return distorted(planeRadius(camera, a), camera.k[0], camera.k[1]).value; }, limit);
}

double radius(const Mei &camera, double angle, const Extent &)
{
	return distorted(planeRadius(camera, angle), camera.k[0], camera.k[1]).value;
}

double angle(const Mei &camera, double radius, const Extent &extent)
{
	const double r = undistorted(radius, camera.k[0], camera.k[1], planeRadius(camera, extent.angle));
	// Mei & Rives, equation 5: the point on the sphere above the plane's (r, 1)
	const double root = std::sqrt(std::max(0.0, 1 + (1 - camera.xi * camera.xi) * r * r));
	const double scale = (camera.xi + root) / (r * r + 1);
	return std::atan2(scale * r, scale - camera.xi);
}

} // namespace arift::models
