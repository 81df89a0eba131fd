// Polynomials in one variable, lowest order first.
#pragma once
#include <span>
#include <vector>

namespace arift
{

/// Horner's scheme, in the precision it is called with: what the shaders do is done here with T = float.
template <typename T> T horner(std::span<const T> coefficients, T x)
{
	T sum = 0;
	for (size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
	return sum;
}

struct ValueAndSlope {
	double value, slope;
};
inline ValueAndSlope hornerWithSlope(std::span<const double> coefficients, double x)
{
	ValueAndSlope sum{0, 0};
	for (size_t i = coefficients.size(); i-- > 0;) {
		sum.slope = sum.slope * x + sum.value;
		sum.value = sum.value * x + coefficients[i];
	}
	return sum;
}

/// One thing to be fitted: weight * (polynomial(x) - y) shall be small.
struct FitSample {
	double x, y, weight;
};
/// The polynomial of `size` terms whose largest weighted error over the samples is smallest (near enough: Lawson 1961, a few steps).
/// x lies in [-1, 1].
std::vector<double> fitPolynomial(std::span<const FitSample> samples, size_t size);

/// The coefficients in u of polynomial(x) with x = offset + scale u.
std::vector<double> substitute(std::span<const double> polynomial, double offset, double scale);

} // namespace arift
