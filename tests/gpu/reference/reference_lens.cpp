#include "tests/gpu/reference/reference_lens.h"
#include <algorithm>
#include <cmath>

namespace arift::reference
{
namespace
{

constexpr double panelWidth = 0.14976, lensDistance = 0.0635; // metres
constexpr double pitch = panelWidth / 1280;

struct Table {
	double relief, end; // metres; largest r^2
	std::array<double, 11> knots;
	double at(double r2) const;
};

// Hermite basis in the form that LibOVR uses, with its own rules at both ends.
double catmullRom(const std::array<double, 11> &knot, double s)
{
	const int k = std::clamp(int(std::floor(s)), 0, 10);
	const double t = s - k;
	double from, to, slopeFrom, slopeTo;
	if (k == 10) {
		from = knot[10];
		slopeFrom = slopeTo = knot[10] - knot[9];
		to = from + slopeFrom;
	} else {
		from = k == 0 ? 1.0 : knot[k];
		to = knot[k + 1];
		slopeFrom = k == 0 ? knot[1] - knot[0] : k == 9 ? (knot[10] - knot[9]) / 2 : (knot[k + 1] - knot[k - 1]) / 2;
		slopeTo = k == 9 ? knot[10] - knot[9] : (knot[k + 2] - knot[k]) / 2;
	}
	const double u = 1 - t;
	return (from * (1 + 2 * t) + slopeFrom * t) * u * u + (to * (1 + 2 * u) - slopeTo * u) * t * t;
}

double Table::at(double r2) const { return catmullRom(knots, 10 * r2 / end); }

constexpr std::array<Table, 3> tables{{
	{0.007760465, 1.8, {1.0, 1.06505, 1.14725, 1.2705, 1.48, 1.87, 2.534, 3.6, 5.1, 7.4, 11.0}},
	{0.012760465,
	 1.0,
	 {1.0, 1.032407264, 1.07160462, 1.11998388, 1.1808606, 1.2590494, 1.361915, 1.5014339, 1.6986004, 1.9940577, 2.4783147}},
	{0.017760465, 1.0, {1.0102, 1.0371, 1.0831, 1.1353, 1.2, 1.2851, 1.3979, 1.56, 1.8, 2.25, 3.0}},
}};

} // namespace

Lens Lens::spline(double eyeRelief)
{
	const double relief = std::clamp(eyeRelief, tables.front().relief, tables.back().relief);
	const Table &low = relief < tables[1].relief ? tables[0] : tables[1];
	const Table &high = &low == &tables[0] ? tables[1] : tables[2];
	const double mix = (relief - low.relief) / (high.relief - low.relief);

	Lens lens;
	const double radius = std::lerp(std::sqrt(low.end), std::sqrt(high.end), mix);
	lens.end_ = radius * radius;
	lens.knots_[0] = std::lerp(low.knots[0], high.knots[0], mix);
	for (int c = 1; c <= 10; ++c) {
		const double r2 = lens.end_ * c / 10;
		lens.knots_[size_t(c)] = std::lerp(low.at(r2), high.at(r2), mix);
	}
	lens.unit_ = 0.0425 / pitch; // MetersPerTanAngleAtCenter
	return lens;
}

Lens Lens::polynomial()
{
	Lens lens;
	lens.spline_ = false;
	lens.unit_ = 320;                                            // half the width of an eye's half
	lens.tangentPerUnit_ = panelWidth / 4 / 0.041;               // eye to screen: 41 mm
	const double edge = 1 + (1 - 2 * lensDistance / panelWidth); // from the lens' axis to the outer edge
	lens.end_ = edge * edge;
	return lens;
}

Eigen::Vector2d Lens::axis(int eye)
{
	const double offset = lensDistance / 2 / pitch;
	return {640 + (eye == 0 ? -offset : offset), 400};
}

Eigen::Vector2d Lens::fromAxis(int eye, const Eigen::Vector2d &pixel) const
{
	const Eigen::Vector2d d = (pixel - axis(eye)) / unit_;
	return {d.x(), -d.y()};
}

double Lens::relativeRadius2(int eye, const Eigen::Vector2d &pixel) const { return fromAxis(eye, pixel).squaredNorm() / end_; }

double Lens::stretch(double r2) const { return spline_ ? catmullRom(knots_, 10 * r2 / end_) : 1 + r2 * (0.22 + r2 * 0.24); }

double Lens::colour(int channel, double r2) const
{
	if (channel == 1) return 1;
	if (channel == 2) return 1.014;
	return spline_ ? 0.994 : 0.996 - 0.004 * r2;
}

Eigen::Vector2d Lens::tangents(int eye, int channel, const Eigen::Vector2d &pixel) const
{
	const Eigen::Vector2d d = fromAxis(eye, pixel);
	const double r2 = d.squaredNorm();
	return d * (tangentPerUnit_ * stretch(r2) * colour(channel, r2));
}

std::optional<Eigen::Vector2d> Lens::pixel(int eye, int channel, const Eigen::Vector2d &wanted) const
{
	// Along a ray from the axis the tangent only grows; bisection on the radius needs no derivative and cannot run away.
	const double goal = wanted.norm();
	if (goal < 1e-12) return axis(eye);
	const auto reached = [&](double r) { return r * tangentPerUnit_ * stretch(r * r) * colour(channel, r * r); };
	double low = 0, high = std::sqrt(2 * end_);
	if (reached(high) < goal) return std::nullopt;
	for (int i = 0; i < 60; ++i) {
		const double middle = (low + high) / 2;
		(reached(middle) < goal ? low : high) = middle;
	}
	const Eigen::Vector2d d = wanted * (low / goal) * unit_;
	return Eigen::Vector2d(axis(eye) + Eigen::Vector2d(d.x(), -d.y()));
}

} // namespace arift::reference
