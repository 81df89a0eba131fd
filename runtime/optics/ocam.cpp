// OCamCalib: Scaramuzza, Martinelli & Siegwart, "A Flexible Technique for Accurate Omnidirectional Camera Calibration" (2006), section 2.
// Its frame has x along the image's rows (down), y along its columns (right) and z backwards; here x is m.y, y is m.x and z is -cos.
#include "runtime/optics/invert.h"
#include "runtime/optics/models.h"
#include <numbers>

namespace arift::models
{

namespace
{

constexpr double halfPi = std::numbers::pi / 2;

/// atan2(rho, -f(rho)): the angle off the axis straight from the direct polynomial.
double directAngle(const OCam &camera, double radius) { return std::atan2(radius, -horner<double>(camera.direct, radius)); }

/// rho(theta) with theta = angle - pi/2. A polynomial that misses 0 on the axis by a rounding error is held at 0 there.
ValueAndSlope inverseRadius(const OCam &camera, double angle) { return hornerWithSlope(camera.inverse, angle - halfPi); }

/// The direct polynomial's extent: followed along the radius, where it is closed, in steps of about half a milliradian near the axis.
Extent followRadius(const OCam &camera, Extent limit)
{
	constexpr int longest = 1'000'000; ///< steps: 500 focal lengths
	const double step = 5e-4 * -camera.direct[0];
	Extent before{0, 0}, last{0, 0};
	for (int i = 1; i < longest && last.radius < limit.radius; ++i) {
		const double radius = std::min(i * step, limit.radius);
		const Extent next{directAngle(camera, radius), radius};
		if (!(next.angle > last.angle)) return before;
		if (next.angle >= limit.angle) return next;
		before = std::exchange(last, next);
	}
	return last;
}

} // namespace

const char *name(const OCam &) { return "ocam"; }

void checkFinite(const char *what, std::span<const double> values)
{
	for (const double value : values)
		if (!std::isfinite(value)) throw InputError("{} holds {}, expected finite numbers", what, value);
}

void check(const OCam &camera)
{
	if (camera.direct.empty() && camera.inverse.empty())
		throw InputError("an OCam camera without polynomial, expected the direct or the inverse one");
	checkFinite("the direct polynomial", camera.direct);
	checkFinite("the inverse polynomial", camera.inverse);
	checkFinite("the centre and stretch", std::array{camera.centreRow, camera.centreColumn, camera.c, camera.d, camera.e});
	if (!camera.direct.empty() && !(camera.direct[0] < 0))
		throw OCamError(OCamPart::direct, "direct polynomial a0 = {}, expected a negative number", camera.direct[0]);
	if (camera.direct.empty() && std::abs(inverseRadius(camera, 0).value) > 0.1)
		throw OCamError(OCamPart::inverse, "inverse polynomial gives {:.3f} px on the axis, expected less than 0.1",
						inverseRadius(camera, 0).value);
	if (std::abs(camera.c - 1) > 0.1) throw OCamError(OCamPart::affine, "affine c = {}, expected nearly 1", camera.c);
	if (std::abs(camera.d) > 0.1) throw OCamError(OCamPart::affine, "affine d = {}, expected nearly 0", camera.d);
	if (std::abs(camera.e) > 0.1) throw OCamError(OCamPart::affine, "affine e = {}, expected nearly 0", camera.e);
}

Plane plane(const OCam &camera)
{
	return {.centre = {camera.centreColumn, camera.centreRow}, .affine = glm::dmat2(1, camera.d, camera.e, camera.c)};
}

Extent extent(const OCam &camera, Extent limit)
{
	if (!camera.direct.empty()) return followRadius(camera, limit);
	return followAngle([&](double angle) { return inverseRadius(camera, angle).value; }, limit);
}

double radius(const OCam &camera, double angle, const Extent &extent)
{
	if (camera.direct.empty()) return std::max(0.0, inverseRadius(camera, angle).value);
	// f(rho) / rho = -cos / sin: the one root within the extent
	const double sine = std::sin(angle), cosine = std::cos(angle);
	const auto residual = [&](double rho) -> ValueAndSlope {
		const auto [f, slope] = hornerWithSlope(camera.direct, rho);
		return {f * sine + rho * cosine, slope * sine + cosine};
	};
	return solveRising(residual, 0, extent.radius, extent.radius * angle / extent.angle);
}

double angle(const OCam &camera, double radius, const Extent &extent)
{
	if (!camera.direct.empty()) return directAngle(camera, radius);
	const auto residual = [&](double a) -> ValueAndSlope {
		const auto [value, slope] = inverseRadius(camera, a);
		return {value - radius, slope};
	};
	return solveRising(residual, 0, extent.angle, extent.angle * radius / extent.radius);
}

double inverseDisagreement(const CameraModel &camera)
{
	const auto *ocam = std::get_if<OCam>(&camera.parameters());
	if (!ocam || ocam->direct.empty() || ocam->inverse.empty()) return 0;
	double worst = 0;
	for (double rho = 1; rho <= camera.radius(camera.maxAngle()); rho += 1)
		worst = std::max(worst, std::abs(inverseRadius(*ocam, directAngle(*ocam, rho)).value - rho));
	return worst;
}

void warnAboutInverse(const std::string &where, const CameraModel &camera)
{
	const double difference = inverseDisagreement(camera);
	if (difference > 0.5)
		log::warning(
			"{}: the inverse polynomial differs from the direct one by up to {:.2f} px, expected at most 0.5; the direct one is used",
			where, difference);
}

} // namespace arift::models
