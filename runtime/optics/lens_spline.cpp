#include "runtime/optics/lens_spline.h"
#include <algorithm>
#include <cmath>

namespace arift::dk1
{

namespace
{

/// Values and tangents at both ends of segment `i`; LibOVR's first and last segments are its own, not Catmull and Rom's.
struct Segment {
	double p0, m0, p1, m1;
};
Segment segment(const std::array<double, 11> &k, int i)
{
	if (i == 0) return {1.0, k[1] - k[0], k[1], (k[2] - k[0]) / 2};
	if (i == 9) return {k[9], (k[10] - k[9]) / 2, k[10], k[10] - k[9]};
	if (i == 10) return {k[10], k[10] - k[9], 2 * k[10] - k[9], k[10] - k[9]};
	const size_t n = size_t(i);
	return {k[n], (k[n + 1] - k[n - 1]) / 2, k[n + 1], (k[n + 2] - k[n]) / 2};
}

} // namespace

ValueAndSlope evaluate(const LensSpline &spline, double r2)
{
	const double at = 10 * r2 / spline.maxRadius2;
	const int i = int(std::clamp(std::floor(at), 0.0, 10.0));
	const auto [p0, m0, p1, m1] = segment(spline.k, i);
	const double t = at - i, u = 1 - t;
	// Beyond the last knot both tangents equal p1 - p0, and the cubic is that line at any t.
	const double value = (p0 * (1 + 2 * t) + m0 * t) * u * u + (p1 * (1 + 2 * u) - m1 * u) * t * t;
	const double slope = 6 * t * u * (p1 - p0) + m0 * u * (1 - 3 * t) + m1 * t * (3 * t - 2);
	return {value, slope * 10 / spline.maxRadius2};
}

LensSpline splineAt(double eyeRelief)
{
	const auto &tables = splineTables;
	const size_t upper = eyeRelief < tables[1].eyeRelief ? 1 : 2;
	const SplineTable &low = tables[upper - 1], &high = tables[upper];
	const double weight = std::clamp((eyeRelief - low.eyeRelief) / (high.eyeRelief - low.eyeRelief), 0.0, 1.0);
	const auto mixed = [&](double a, double b) { return a + (b - a) * weight; };
	const double maxRadius = mixed(low.maxRadius, high.maxRadius);
	LensSpline spline{{}, maxRadius * maxRadius};
	spline.k[0] = mixed(low.k[0], high.k[0]);
	for (size_t i = 1; i <= 10; ++i) {
		const double r2 = double(i) / 10 * spline.maxRadius2;
		spline.k[i] = mixed(evaluate({low.k, low.maxRadius * low.maxRadius}, r2).value,
							evaluate({high.k, high.maxRadius * high.maxRadius}, r2).value);
	}
	return spline;
}

} // namespace arift::dk1
