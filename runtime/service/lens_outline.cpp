#include "runtime/service/lens_outline.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace arift
{

namespace
{

constexpr size_t corners = 4;
constexpr size_t crossings = 8; ///< of a circle with the sides of a rectangle, at most
constexpr size_t around = ipc::LensOutline::mostPoints - corners - crossings;

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

/// Where the lens's rim leaves the field of view and comes back: those angles that there are.
void addCrossings(std::vector<double> &angles, const Rectangle &fov, double rim)
{
	const auto add = [&](double x, double y) {
		if (x >= fov.left && x <= fov.right && y >= fov.down && y <= fov.up) angles.push_back(std::atan2(y, x));
	};
	for (const double x : {fov.left, fov.right})
		if (const double y = std::sqrt(rim * rim - x * x); y >= 0) {
			add(x, y);
			add(x, -y);
		}
	for (const double y : {fov.down, fov.up})
		if (const double x = std::sqrt(rim * rim - y * y); x >= 0) {
			add(x, y);
			add(-x, y);
		}
}

/// In which directions the outline has its points, rising.
std::vector<double> anglesFor(const Rectangle &fov, double rim)
{
	std::vector<double> angles;
	for (size_t i = 0; i < around; ++i) angles.push_back(2 * std::numbers::pi * (double(i) / double(around) - 0.5));
	for (const double x : {fov.left, fov.right})
		for (const double y : {fov.down, fov.up}) angles.push_back(std::atan2(y, x));
	addCrossings(angles, fov, rim);
	std::ranges::sort(angles);
	return angles;
}

} // namespace

ipc::LensOutline lensOutline(const LensModel &lens, Eye eye, const XrFovf &fov)
{
	const Rectangle rectangle{std::tan(fov.angleLeft), std::tan(fov.angleRight), std::tan(fov.angleDown), std::tan(fov.angleUp)};
	const double widen = 1 / std::cos(std::numbers::pi / double(around)); // the chords of the points lie outside the lens's circle
	ipc::LensOutline outline;
	for (const double angle : anglesFor(rectangle, rimOf(lens))) {
		const glm::dvec2 direction{std::cos(angle), std::sin(angle)};
		const double limit = reach(rectangle, direction);
		const glm::dvec2 point = direction * std::min(limit, shown(lens, eye, direction, limit) * widen);
		outline.points[outline.count++] = {float(point.x), float(point.y)};
	}
	return outline;
}

} // namespace arift
