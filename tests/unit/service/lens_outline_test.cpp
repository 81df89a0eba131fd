#include "runtime/service/lens_outline.h"
#include <cmath>
#include <gtest/gtest.h>

namespace arift
{
namespace
{

XrFovf fovOf(const LensModel &lens, Eye eye)
{
	const LensModel::Fov tangents = lens.fov(eye);
	return {float(-std::atan(tangents.left)), float(std::atan(tangents.right)), float(std::atan(tangents.up)),
			float(-std::atan(tangents.down))};
}

/// How far inside the outline a direction is, in tangents; negative: outside.
double depthIn(const ipc::LensOutline &outline, glm::dvec2 direction)
{
	double least = 1e9;
	for (uint32_t i = 0; i < outline.count; ++i) {
		const XrVector2f a = outline.points[i], b = outline.points[(i + 1) % outline.count];
		const glm::dvec2 from{a.x, a.y}, edge = glm::dvec2{b.x, b.y} - from, to = direction - from;
		least = std::min(least, (edge.x * to.y - edge.y * to.x) / glm::length(edge)); // counter-clockwise: inside is left
	}
	return least;
}

/// Nothing that the lens shows is hidden, to half a panel pixel; of what it does not show, less than a pixel is left at the rim.
TEST(LensOutline, IsWhatTheLensShowsOfTheFieldOfView)
{
	constexpr double pixel = 0.004; // tangents at the rim, where the lens magnifies least
	const LensModel lens{SplineLens{}};
	const double rim = std::sqrt(lens.maxR2()) * lens.scale(lens.maxR2());
	for (const Eye eye : {Eye::left, Eye::right}) {
		const XrFovf fov = fovOf(lens, eye);
		const ipc::LensOutline outline = lensOutline(lens, eye, fov);
		ASSERT_GT(outline.count, 50u);
		size_t shown = 0, hidden = 0;
		for (double x = std::tan(fov.angleLeft) + 1e-3; x < std::tan(fov.angleRight); x += 0.02)
			for (double y = std::tan(fov.angleDown) + 1e-3; y < std::tan(fov.angleUp); y += 0.02) {
				const bool isShown = std::hypot(x, y) <= rim && lens.pixel(eye, Channel::green, {x, y});
				(isShown ? shown : hidden)++;
				if (isShown)
					EXPECT_GT(depthIn(outline, {x, y}), -pixel / 2) << x << ' ' << y;
				else
					EXPECT_LT(depthIn(outline, {x, y}), pixel) << x << ' ' << y;
			}
		EXPECT_GT(shown, 10'000u);
		EXPECT_GT(hidden, 100u) << "the corners";
	}
}

} // namespace
} // namespace arift
