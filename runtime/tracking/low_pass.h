// Second-order Butterworth low-pass whose time constant may change from sample to sample.
#pragma once
#include <cmath>
#include <cstddef>

namespace arift
{

/// Coefficients of the bilinear Butterworth low-pass with time constant tau = sqrt(2) / (2 pi f_c) (Laidig & Seel 2023, section 3.2), for a
/// state-variable realisation: its states are two integrators, so that changing tau neither rings nor jumps, as a direct form would.
struct LowPassCoefficients {
	double g = 0, gain = 0, band = 0;
	LowPassCoefficients() = default;
	LowPassCoefficients(double tau, double samplePeriod)
	{
		constexpr double damping = 1.4142135623730951;
		g = std::tan(samplePeriod / (damping * tau)); // tan(pi f_c T)
		gain = 1 / (1 + g * (g + damping));
		band = gain * g;
	}
};

/// The state for `N` signals. Needs double precision: at 1000 Hz and some seconds a step is 1e-8 of the signal.
template <size_t N> struct LowPass {
	double rate[N] = {}, level[N] = {};

	void settle(size_t i, double value)
	{
		rate[i] = 0;
		level[i] = value;
	}
	double step(size_t i, double input, const LowPassCoefficients &c)
	{
		const double middle = c.gain * rate[i] + c.band * (input - level[i]);
		const double low = level[i] + c.g * middle;
		rate[i] = 2 * middle - rate[i];
		level[i] = 2 * low - level[i];
		return low;
	}
};

} // namespace arift
