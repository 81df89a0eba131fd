// Pinhole with radial and tangential distortion: Brown 1966 in OpenCV's form, coefficients k1 k2 p1 p2.
#include "runtime/optics/models.h"
#include "runtime/optics/radial_distortion.h"
#include <limits>
#include <numbers>

namespace arift::models
{

namespace
{

double planeRadius(double angle)
{
	return angle < std::numbers::pi / 2 - 1e-3 ? std::tan(angle) : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

const char *name(const RadTan &) { return "radtan"; }

void check(const RadTan &camera)
{
	checkPinholePart(camera.fx, camera.fy, camera.cx, camera.cy);
	checkFinite("the distortion", camera.k);
}

Plane plane(const RadTan &camera)
{
	return {.centre = {camera.cx, camera.cy}, .affine = glm::dmat2(camera.fx, 0, 0, camera.fy), .tangential = {camera.k[2], camera.k[3]}};
}

Extent extent(const RadTan &camera, Extent limit)
{
	return followAngle([&](double a) { return distorted(planeRadius(a), camera.k[0], camera.k[1]).value; }, limit);
}

double radius(const RadTan &camera, double angle, const Extent &) { return distorted(std::tan(angle), camera.k[0], camera.k[1]).value; }

double angle(const RadTan &camera, double radius, const Extent &extent)
{
	return std::atan(undistorted(radius, camera.k[0], camera.k[1], std::tan(extent.angle)));
}

} // namespace arift::models
