#include "runtime/service/lens_outline.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace arift
{

namespace
{

constexpr size_t corners = 4;
constexpr size_t around = ipc::LensOutline::mostPoints - corners;

struct Rectangle {
	double left, right, down, up;
};

/// How far the field of view reaches from the lens's axis in a direction.
double reach(const Rectangle &fov, glm::dvec2 direction)
{
	const double x = direction.x > 0 ? fov.right / direction.x : direction.x < 0 ? fov.left / direction.x : INFINITY;
	const double y = direction.y > 0 ? fov.up / direction.y : direction.y < 0 ? fov.down / direction.y : INFINITY;
	return std::min(x, y);
}

/// The rim of the lens's circle: beyond it nothing is drawn.
double rimOf(const LensModel &lens) { return std::sqrt(lens.maxR2()) * lens.scale(lens.maxR2()); }

/// How far from its axis the lens shows something in a direction, at most `limit`.
double shown(const LensModel &lens, Eye eye, glm::dvec2 direction, double limit)
{
	limit = std::min(limit, rimOf(lens));
	if (lens.pixel(eye, Channel::green, direction * limit)) return limit;
	double inside = 0, outside = limit;
	for (int step = 0; step < 24; ++step) {
		const double middle = (inside + outside) / 2;
		(lens.pixel(eye, Channel::green, direction * middle) ? inside : outside) = middle;
	}
	return outside;
}

} // namespace

ipc::LensOutline lensOutline(const LensModel &lens, Eye eye, const XrFovf &fov)
{
	const Rectangle rectangle{std::tan(fov.angleLeft), std::tan(fov.angleRight), std::tan(fov.angleDown), std::tan(fov.angleUp)};
	std::array<double, around + corners> angles;
	for (size_t i = 0; i < around; ++i) angles[i] = 2 * std::numbers::pi * (double(i) / double(around) - 0.5);
	angles[around] = std::atan2(rectangle.up, rectangle.right);
	angles[around + 1] = std::atan2(rectangle.up, rectangle.left);
	angles[around + 2] = std::atan2(rectangle.down, rectangle.left);
	angles[around + 3] = std::atan2(rectangle.down, rectangle.right);
	std::ranges::sort(angles);

	const double widen = 1 / std::cos(std::numbers::pi / double(around)); // the chords of the points lie outside the lens's circle
	ipc::LensOutline outline;
	for (const double angle : angles) {
		const glm::dvec2 direction{std::cos(angle), std::sin(angle)};
		const double limit = reach(rectangle, direction);
		const glm::dvec2 point = direction * std::min(limit, shown(lens, eye, direction, limit) * widen);
		outline.points[outline.count++] = {float(point.x), float(point.y)};
	}
	return outline;
}

} // namespace arift
