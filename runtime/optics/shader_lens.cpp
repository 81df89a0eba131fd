#include "runtime/optics/lens_model.h"
#include "runtime/optics/polynomial.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace arift
{

namespace
{

/// Panel pixels by which an error of 1 in D moves the image at this r^2: the tangent's error over the lens's radial magnification there.
double pixelsPerError(const LensModel &lens, double r2)
{
	const double r = std::sqrt(r2), h = 1e-5;
	const auto tangentOf = [&](double at) { return at * lens.scale(at * at); };
	const double low = std::max(0.0, r - h);
	return r * lens.pixelsPerTangent() * (r + h - low) / (tangentOf(r + h) - tangentOf(low));
}

/// Next to the axis even a wrong magnification moves nothing far: this many pixels per error of 1 hold it to about 0.1 %.
constexpr double magnificationWeight = 80;

double measured(const LensModel &lens, std::span<const float> d, double maxR2)
{
	constexpr int steps = 4001;
	double worst = 0;
	for (int i = 0; i <= steps; ++i) {
		const double r2 = maxR2 * i / steps;
		worst = std::max(worst, std::abs(double(horner(d, float(r2))) - lens.scale(r2)) * pixelsPerError(lens, r2));
	}
	return worst;
}

} // namespace

ShaderLens fitForShader(const LensModel &lens, double tolerance)
{
	const double maxR2 = lens.maxR2();
	std::vector<FitSample> samples;
	constexpr int count = 800;
	for (int i = 0; i < count; ++i) {
		// more of them towards both ends, where polynomials go astray
		const double x = -std::cos(3.14159265358979 * (i + 0.5) / count), r2 = (x + 1) / 2 * maxR2;
		samples.push_back({x, lens.scale(r2), std::hypot(pixelsPerError(lens, r2), magnificationWeight)});
	}
	ShaderLens best;
	best.residual = std::numeric_limits<double>::infinity();
	for (size_t size = 2; size <= ShaderLens::maxCoefficients; ++size) {
		const std::vector<double> inR2 = substitute(fitPolynomial(samples, size), -1, 2 / maxR2);
		ShaderLens form;
		std::copy(inR2.begin(), inR2.end(), form.d.begin());
		form.coefficients = uint32_t(size);
		form.residual = measured(lens, std::span<const float>(form.d).first(size), maxR2);
		if (form.residual < best.residual) best = form;
		if (best.residual <= tolerance) break;
	}
	return best;
}

} // namespace arift
