// Second-order Butterworth low-pass whose time constant may change from sample to sample.
#pragma once
#include <array>
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
		const double angle = samplePeriod / (damping * tau); // pi f_c T
		g = angle < 1e-3 ? angle * (1 + angle * angle / 3) : std::tan(angle);
		gain = 1 / (1 + g * (g + damping));
		band = gain * g;
	}
};

/// The state for `N` signals. Needs double precision: at 1000 Hz and some seconds a step is 1e-8 of the signal.
template <size_t N> struct LowPass {
	std::array<double, N> rate{}, level{};

	using Signals = std::array<double, N>;

	void settle(const Signals &values)
	{
		rate = {};
		level = values;
	}
	Signals step(const Signals &input, const LowPassCoefficients &c)
	{
		Signals output;
		for (size_t i = 0; i < N; ++i) {
			const double middle = c.gain * rate[i] + c.band * (input[i] - level[i]);
			const double low = level[i] + c.g * middle;
			rate[i] = 2 * middle - rate[i];
			level[i] = 2 * low - level[i];
			output[i] = low;
		}
		return output;
	}
};

} // namespace arift
