// Solves f(x) = 0 where f changes sign once in an interval: Newton's steps, halved where they would leave it.
#pragma once
#include "runtime/optics/polynomial.h"
#include <cmath>

namespace arift
{

/// `f(x)` returns ValueAndSlope; f is below zero left of the solution and above it to the right. Returns the end of the interval that is
/// nearest to the solution if that lies outside.
template <typename Function> double solveRising(Function f, double low, double high, double guess)
{
	double x = guess;
	for (int step = 0; step < 80 && low < high; ++step) {
		const auto [value, slope] = f(x);
		if (value == 0) return x;
		(value > 0 ? high : low) = x;
		double next = x - value / slope;
		if (!(next >= low && next <= high)) next = low + (high - low) / 2;
		if (std::abs(next - x) <= 1e-15 + 4e-16 * std::abs(x)) return next;
		x = next;
	}
	return x;
}

} // namespace arift
