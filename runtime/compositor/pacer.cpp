#include "runtime/compositor/pacer.h"
#include <algorithm>
#include <cmath>

namespace arift
{

namespace
{

constexpr XrDuration longestCostInPeriods = 4;
// A phase-locked loop of second order, slow enough that a late answer of the window system hardly moves it.
constexpr double phaseGain = 0.1, periodGain = 0.005;
/// A display's clock is never further from its nominal rate.
constexpr double periodTolerance = 0.02;
/// Measured times this far from the grid (of a period) are outliers; as many of them in a row are a new grid.
constexpr double outlier = 0.25;
constexpr uint32_t outliersForNewPhase = 8;

} // namespace

Pacer::Pacer(Settings settings, XrTime anyDisplayTime)
	: settings_(settings),
	  period_(double(settings.period)),
	  phase_(0),
	  origin_(anyDisplayTime),
	  cost_(settings.firstCost),
	  usualCost_(settings.firstCost)
{
}

Pacer::Refresh Pacer::next(XrTime now) const
{
	const double earliest = double(now + lead() - origin_) - phase_;
	// A nanosecond of rounding must not cost a refresh.
	const double display = phase_ + std::ceil(earliest / period_ - 1e-6) * period_;
	const XrTime time = origin_ + XrTime(std::llround(display));
	return {.latch = isSlow() ? now : std::max(now, time - lead()), .vblank = time - settings_.vblankToDisplay, .display = time};
}

Pacer::Refresh Pacer::after(XrTime display, XrTime done) const
{
	const Refresh refresh = next(done);
	XrTime time = refresh.display;
	// Composing was cheaper than expected, or the image is seen later than planned: no refresh is served twice.
	while (time - display < period() / 2) time += period();
	if (time == refresh.display) return refresh;
	return {.latch = std::max(done, time - lead()), .vblank = time - settings_.vblankToDisplay, .display = time};
}

void Pacer::composed(XrDuration cost)
{
	costs_[costCount_++ % keptCosts] = std::max<XrDuration>(cost, 0);
	const size_t count = std::min(costCount_, keptCosts);
	std::array<XrDuration, keptCosts> sorted = costs_;
	std::ranges::sort(sorted.begin(), sorted.begin() + ptrdiff_t(count));
	// A refresh without a new image is seen at once; an image that waits a little for its refresh is not. One outlier is forgiven.
	cost_ = std::min(sorted[count - std::min<size_t>(count, 2)], longestCostInPeriods * settings_.period);
	usualCost_ = std::min(sorted[(count - 1) / 2], cost_);
}

void Pacer::displayed(XrTime display)
{
	if (lastDisplay_ && display > *lastDisplay_) {
		const auto refreshes = std::llround(double(display - *lastDisplay_) / period_);
		if (refreshes > 1) missed_ += uint64_t(refreshes - 1);
	}
	lastDisplay_ = display;

	const double measured = double(display - origin_);
	const double refreshes = std::round((measured - phase_) / period_);
	const double expected = phase_ + refreshes * period_, error = measured - expected;
	if (std::abs(error) > outlier * period_) {
		if (++astray_ >= outliersForNewPhase) {
			phase_ = measured;
			astray_ = 0;
		}
		return;
	}
	astray_ = 0;
	phase_ = expected + phaseGain * error;
	const double nominal = double(settings_.period);
	period_ = std::clamp(period_ + periodGain * error, nominal * (1 - periodTolerance), nominal * (1 + periodTolerance));
}

} // namespace arift
