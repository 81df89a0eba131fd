// Kannala & Brandt, "A Generic Camera Model and Calibration Method for Conventional, Wide-Angle, and Fish-Eye Lenses" (2006), equation 6;
// the four-parameter form of OpenCV's fisheye module and Kalibr's pinhole-equi, without their limit at 90 degrees.
#include "runtime/base/error.h"
#include "runtime/optics/invert.h"
#include "runtime/optics/models.h"

namespace arift::models
{

namespace
{

/// a + k1 a^3 + k2 a^5 + k3 a^7 + k4 a^9
ValueAndSlope curve(const KannalaBrandt &camera, double a)
{
	const auto &k = camera.k;
	const double a2 = a * a;
	return {a * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))),
			1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])))};
}

} // namespace

const char *name(const KannalaBrandt &) { return "kannala_brandt"; }

void checkPinholePart(double fx, double fy, double cx, double cy)
{
	checkFinite("the focal lengths and centre", std::array{fx, fy, cx, cy});
	if (!(fx > 0 && fy > 0)) throw InputError("focal lengths {}, {}, expected positive numbers", fx, fy);
	if (fx > 2 * fy || fy > 2 * fx) throw InputError("focal lengths {}, {}, expected nearly equal ones", fx, fy);
}

void check(const KannalaBrandt &camera)
{
	checkPinholePart(camera.fx, camera.fy, camera.cx, camera.cy);
	checkFinite("the distortion", camera.k);
}

Plane plane(const KannalaBrandt &camera) { return {.centre = {camera.cx, camera.cy}, .affine = glm::dmat2(camera.fx, 0, 0, camera.fy)}; }

Extent extent(const KannalaBrandt &camera, Extent limit)
{
	return followAngle([&](double a) { return curve(camera, a).value; }, limit);
}

double radius(const KannalaBrandt &camera, double angle, const Extent &) { return curve(camera, angle).value; }

double angle(const KannalaBrandt &camera, double radius, const Extent &extent)
{
	const auto residual = [&](double a) -> ValueAndSlope {
		const auto [value, slope] = curve(camera, a);
		return {value - radius, slope};
	};
	return solveRising(residual, 0, extent.angle, extent.angle * radius / extent.radius);
}

} // namespace arift::models
