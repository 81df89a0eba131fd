// The DK1 lens as LibOVR 0.3.2 to 0.5.0.1 has it: numbers of CreateDistortionRenderDesc and its profile defaults (OVR_Stereo.cpp).
#pragma once
#include <array>

namespace arift::dk1
{

struct SplineTable {
	double eyeRelief; ///< metres
	double maxRadius; ///< of the spline, in units of tangents at the lens axis
	std::array<double, 11> k;
};
constexpr std::array<SplineTable, 3> splineTables{{
	{0.007760465, 1.3416407864998738, {1.0, 1.06505, 1.14725, 1.2705, 1.48, 1.87, 2.534, 3.6, 5.1, 7.4, 11.0}},
	{0.012760465,
	 1.0,
	 {1.0, 1.032407264, 1.07160462, 1.11998388, 1.1808606, 1.2590494, 1.361915, 1.5014339, 1.6986004, 1.9940577, 2.4783147}},
	{0.017760465, 1.0, {1.0102, 1.0371, 1.0831, 1.1353, 1.2, 1.2851, 1.3979, 1.56, 1.8, 2.25, 3.0}},
}};

constexpr double splineMetresPerTangent = 0.0425;
constexpr std::array<double, 3> splineChromatic{1 - 0.006, 1, 1 + 0.014};

/// LibOVR 0.2.5: eye to screen, and red, green, blue as a + b r^2 with r in half widths of an eye's part of the panel.
constexpr double polynomialMetresPerTangent = 0.041;
constexpr std::array<std::array<double, 2>, 3> polynomialChromatic{{{0.996, -0.004}, {1, 0}, {1.014, 0}}};

/// The default field of view's rule: the lens seen from the eye, and from an eye turned by `eyeTurn` about its centre.
constexpr double lensRadius = 0.0175;
constexpr double eyeballRadius = 0.0135;
constexpr double eyeTurnSine = 0.5, eyeTurnCosine = 0.86602540378443865;
constexpr double extraRotation = 0.001;
constexpr double leastEyeRelief = 0.006;

} // namespace arift::dk1
