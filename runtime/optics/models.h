// What each camera model must answer; CameraModel makes one face of it. All models are a radial curve on a plane of their own, to which
// tangential distortion is added, then stretch and centre:
//   pixel = centre + affine * (radius(angle) * azimuth + tangential(t)),  t = azimuth * sin(angle) / (cos(angle) + xi)
#pragma once
#include "runtime/base/error.h"
#include "runtime/optics/camera_model.h"
#include <algorithm>
#include <span>
#include <utility>

namespace arift::models
{

struct Plane {
	glm::dvec2 centre;
	glm::dmat2 affine{1};               ///< pixels per unit of radius
	std::array<double, 2> tangential{}; ///< p1, p2
	double xi = 0;
};

/// How far the model is used: radians off the axis and the radius there.
struct Extent {
	double angle, radius;
};

// Per model: `check` throws InputError where the numbers can be no camera; `extent` follows the radial curve from the axis for as long as
// it rises, at most to `limit`; `radius` and `angle` are each other's inverse within that extent.
#define ARIFT_CAMERA_MODEL(Model)                                                                                                          \
	const char *name(const Model &);                                                                                                       \
	void check(const Model &);                                                                                                             \
	Plane plane(const Model &);                                                                                                            \
	Extent extent(const Model &, Extent limit);                                                                                            \
	double radius(const Model &, double angle, const Extent &extent);                                                                      \
	double angle(const Model &, double radius, const Extent &extent);
ARIFT_CAMERA_MODEL(OCam)
ARIFT_CAMERA_MODEL(KannalaBrandt)
ARIFT_CAMERA_MODEL(Mei)
ARIFT_CAMERA_MODEL(RadTan)
ARIFT_CAMERA_MODEL(DoubleSphere)
#undef ARIFT_CAMERA_MODEL

/// The parts of an OCam, in the order in which OCamCalib writes them.
enum class OCamPart { direct, inverse, centre, affine };
/// What check(const OCam &) throws where one part is wrong by itself.
struct OCamError : InputError {
	OCamPart part;
	template <typename... Args> OCamError(OCamPart wrong, fmt::format_string<Args...> format, Args &&...args)
		: InputError(format, std::forward<Args>(args)...), part(wrong)
	{
	}
};

/// Shared by the models with focal lengths.
void checkPinholePart(double fx, double fy, double cx, double cy);
void checkFinite(const char *what, std::span<const double> values);

/// Follows `radiusOf(angle)` from 0 in steps of half a milliradian for as long as it rises (NaN ends it), at most to `limit`.
template <typename Function> Extent followAngle(Function radiusOf, Extent limit)
{
	constexpr double step = 5e-4;
	Extent before{0, 0}, last{0, 0};
	while (last.angle < limit.angle) {
		const double angle = std::min(last.angle + step, limit.angle);
		const Extent next{angle, radiusOf(angle)};
		if (!(next.radius > last.radius)) return before;
		if (next.radius >= limit.radius) return next;
		before = std::exchange(last, next);
	}
	return last;
}

/// Largest difference between an OCam's inverse polynomial and its direct one inside the image, pixels; 0 where it lacks one of them.
double inverseDisagreement(const CameraModel &camera);
/// Warns where that is more than half a pixel. `where` names file and line.
void warnAboutInverse(const std::string &where, const CameraModel &camera);

} // namespace arift::models
