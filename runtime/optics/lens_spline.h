// LibOVR's Catmull-Rom spline of ten segments over r^2, and its interpolation between the tables by eye relief.
#pragma once
#include "runtime/optics/lens_tables.h"
#include "runtime/optics/polynomial.h"

namespace arift::dk1
{

struct LensSpline {
	std::array<double, 11> k;
	double maxRadius2; ///< r^2 at the last knot
};

/// D(r^2) and dD/dr^2. Beyond the last knot it goes on as a straight line.
ValueAndSlope evaluate(const LensSpline &spline, double r2);

/// Outside the tables' range the nearest table.
LensSpline splineAt(double eyeRelief);

} // namespace arift::dk1
