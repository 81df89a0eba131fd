#include "runtime/optics/camera_model.h"
#include "runtime/base/error.h"
#include "runtime/optics/models.h"
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace arift
{

namespace
{

using models::Extent;
using models::Plane;

constexpr uint32_t largestSize = 16384;
constexpr double widestAngle = 3.1; ///< just short of straight behind

Plane planeOf(const CameraParameters &parameters)
{
	return std::visit([](const auto &model) { return models::plane(model); }, parameters);
}

/// Nearest and furthest distance of the image's rim from the centre, on the model's plane.
struct Rim {
	double nearest, furthest;
};
Rim rimOf(const Plane &plane, uint32_t width, uint32_t height)
{
	const glm::dmat2 inverse = glm::inverse(plane.affine);
	const glm::dvec2 low(-0.5, -0.5), high(width - 0.5, height - 0.5);
	double furthest = 0;
	for (const glm::dvec2 corner : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)})
		furthest = std::max(furthest, glm::length(inverse * (corner - plane.centre)));
	const glm::dvec2 edge = glm::min(plane.centre - low, high - plane.centre);
	return {std::min(edge.x * glm::length(inverse[0]), edge.y * glm::length(inverse[1])), furthest};
}

/// OpenCV's calib3d, "Detailed Description": p1, p2.
glm::dvec2 tangential(const Plane &plane, const glm::dvec2 &t)
{
	const auto [p1, p2] = plane.tangential;
	const double r2 = glm::dot(t, t), xy = 2 * t.x * t.y;
	return {p1 * xy + p2 * (r2 + 2 * t.x * t.x), p1 * (r2 + 2 * t.y * t.y) + p2 * xy};
}
bool hasTangential(const Plane &plane) { return plane.tangential[0] != 0 || plane.tangential[1] != 0; }

double undistortedRadius(const Plane &plane, double angle) { return std::sin(angle) / (std::cos(angle) + plane.xi); }

/// The part of the model that is used: to the given angle, or to the image's far corner (and what tangential distortion moves it by).
Extent usedExtent(const CameraParameters &parameters, const Plane &plane, const Rim &rim, double givenAngle)
{
	return std::visit(
		[&](const auto &model) {
			if (givenAngle > 0) return models::extent(model, {givenAngle, 1e9});
			Extent extent = models::extent(model, {widestAngle, rim.furthest});
			if (!hasTangential(plane)) return extent;
			const double t = undistortedRadius(plane, extent.angle);
			const double shift = 3 * (std::abs(plane.tangential[0]) + std::abs(plane.tangential[1])) * t * t;
			return models::extent(model, {widestAngle, rim.furthest + shift});
		},
		parameters);
}

} // namespace

CameraModel::CameraModel(uint32_t width, uint32_t height, CameraParameters parameters, double maxAngle)
	: width_(width), height_(height), parameters_(std::move(parameters)), maxAngle_(maxAngle)
{
	if (width == 0 || height == 0 || width > largestSize || height > largestSize)
		throw InputError("image size {} x {}, expected 1 to {} pixels each", width, height, largestSize);
	if (!(maxAngle >= 0 && maxAngle <= widestAngle)) throw InputError("maximum angle {} rad, expected 0 to {}", maxAngle, widestAngle);
	std::visit([](const auto &model) { models::check(model); }, parameters_);
	const Plane plane = planeOf(parameters_);
	if (!(plane.centre.x > -0.5 && plane.centre.y > -0.5 && plane.centre.x < width - 0.5 && plane.centre.y < height - 0.5))
		throw InputError("centre at column {}, row {}, expected inside an image {} wide and {} high", plane.centre.x, plane.centre.y, width,
						 height);
	const Rim rim = rimOf(plane, width, height);
	const Extent extent = usedExtent(parameters_, plane, rim, maxAngle);
	if (maxAngle > 0 && extent.angle < maxAngle)
		throw InputError("the projection turns back {:.4f} rad off the axis, expected it to be one-to-one up to the given {:.4f}",
						 extent.angle, maxAngle);
	if (maxAngle == 0 && extent.radius < rim.nearest)
		throw InputError("the projection is one-to-one only up to {:.1f} % of the way to the image's nearest edge ({:.4f} rad off the "
						 "axis), expected all of it",
						 100 * extent.radius / rim.nearest, extent.angle);
	maxAngle_ = extent.angle;
	maxRadius_ = extent.radius;
}

const char *CameraModel::name() const
{
	return std::visit([](const auto &model) { return models::name(model); }, parameters_);
}

double CameraModel::radius(double angle) const
{
	return std::visit([&](const auto &model) { return models::radius(model, angle, {maxAngle_, maxRadius_}); }, parameters_);
}

std::optional<glm::dvec2> CameraModel::project(const glm::dvec3 &direction) const
{
	const glm::dvec2 sideways(direction.x, direction.y);
	const double across = glm::length(sideways), angle = std::atan2(across, direction.z);
	if (!(angle <= maxAngle_ + 1e-12)) return {};
	const Plane plane = planeOf(parameters_);
	if (across == 0) return plane.centre;
	const glm::dvec2 azimuth = sideways / across;
	glm::dvec2 m = azimuth * radius(angle);
	if (hasTangential(plane)) m += tangential(plane, azimuth * undistortedRadius(plane, angle));
	return plane.centre + plane.affine * m;
}

std::optional<glm::dvec3> CameraModel::unproject(const glm::dvec2 &pixel) const
{
	const Plane plane = planeOf(parameters_);
	const glm::dvec2 target = glm::inverse(plane.affine) * (pixel - plane.centre);
	const auto angleOf = [&](double radius) {
		return std::visit([&](const auto &model) { return models::angle(model, radius, {maxAngle_, maxRadius_}); }, parameters_);
	};
	glm::dvec2 m = target;
	double angle = 0;
	for (int step = 0; step < 60; ++step) {
		const double radius = glm::length(m);
		if (!(radius > 0)) return glm::dvec3(0, 0, 1);
		angle = angleOf(std::min(radius, maxRadius_));
		if (!hasTangential(plane)) break;
		const glm::dvec2 next = target - tangential(plane, m / radius * undistortedRadius(plane, angle));
		const double change = glm::length(next - m);
		m = next;
		if (change < 1e-14) break;
	}
	const double radius = glm::length(m);
	if (!(radius <= maxRadius_ * (1 + 1e-12))) return {};
	if (radius == 0) return glm::dvec3(0, 0, 1);
	return glm::dvec3(m / radius * std::sin(angle), std::cos(angle));
}

} // namespace arift
