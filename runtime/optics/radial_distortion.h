// r (1 + k1 r^2 + k2 r^4), the radial part of OpenCV's distortion, and its inverse: shared by the pinhole and the unified model.
#pragma once
#include "runtime/optics/invert.h"

namespace arift::models
{

inline ValueAndSlope distorted(double r, double k1, double k2)
{
	const double r2 = r * r;
	return {r * (1 + r2 * (k1 + r2 * k2)), 1 + r2 * (3 * k1 + r2 * 5 * k2)};
}

/// The r in [0, limit] that is distorted to `radius`.
inline double undistorted(double radius, double k1, double k2, double limit)
{
	const auto residual = [&](double r) -> ValueAndSlope {
		const auto [value, slope] = distorted(r, k1, k2);
		return {value - radius, slope};
	};
	return solveRising(residual, 0, limit, std::min(radius, limit));
}

} // namespace arift::models
