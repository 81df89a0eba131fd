// When to wake, and when what is drawn then will be seen. Pure arithmetic: past display times and costs in, times out; no clock, lock or
// GPU. A display time is the instant at which the panel's middle line is seen. All times and costs are those of the one Clock.
#pragma once
#include "runtime/base/xr.h"
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace arift
{

class Pacer
{
public:
	struct Settings {
		XrDuration period = 16'691'704; ///< nominal: 59.91 Hz; the real one is measured
		XrDuration vblankToDisplay =
			25'072'135;                   ///< from the vertical blank that takes an image to its display time (PanelTiming::lineDelay)
		XrDuration margin = 1'000'000;    ///< left between the expected end of composing and the vertical blank
		XrDuration firstCost = 5'000'000; ///< expected of composing until it is known
	};
	/// `anyDisplayTime` fixes the phase until a display time is measured.
	Pacer(Settings settings, XrTime anyDisplayTime);

	struct Refresh {
		XrTime latch = 0;   ///< composing begins: the newest of everything is taken
		XrTime vblank = 0;  ///< the image must be there
		XrTime display = 0; ///< its middle line is seen
	};
	/// The first refresh for which composing can still begin in time when it is `now`. As late as that allows; on a machine that composes
	/// for a period or longer at once: its images come as fast as it makes them, each at a line of the grid.
	Refresh next(XrTime now) const;
	/// The refresh to compose for after the one seen at `display`, when the work for that is done at `done`.
	Refresh after(XrTime display, XrTime done) const;
	/// The refresh that follows `refresh`, as far as is known when its work begins: what an application woken then draws for.
	Refresh following(const Refresh &refresh) const { return after(refresh.display, refresh.latch + cost() + 1); }

	/// Whether an image whose composing begins `now` can be there in time for `refresh`, should it cost what is usual.
	bool reaches(const Refresh &refresh, XrTime now) const { return now + usualCost_ <= refresh.vblank; }

	/// What composing an image cost, from the latch that was planned until it was finished: a thread that is woken late pays for it too.
	void composed(XrDuration cost);
	/// An image was seen at `display`, as measured. Follows the display's period and phase, and counts the refreshes without a new image.
	void displayed(XrTime display);

	/// Measured; the nominal one until it is.
	XrDuration period() const { return std::llround(period_); }
	/// What composing is expected to cost: all but one of the last second's images took no longer; never more than four periods.
	XrDuration cost() const { return cost_; }
	uint64_t missed() const { return missed_; }

private:
	static constexpr size_t keptCosts = 64;

	/// From the latch until the image is seen.
	XrDuration lead() const { return settings_.vblankToDisplay + settings_.margin + cost_; }
	/// Whether waiting for the latest latch would cost refreshes.
	bool isSlow() const { return double(cost_ + settings_.margin) > period_; }

	Settings settings_;
	double period_; ///< ns
	double phase_;  ///< ns after origin_: a display time of the grid
	XrTime origin_; ///< keeps the doubles small
	std::optional<XrTime> lastDisplay_;
	uint32_t astray_ = 0; ///< measured times in a row that the grid does not explain
	std::array<XrDuration, keptCosts> costs_{};
	size_t costCount_ = 0;
	XrDuration cost_, usualCost_; ///< usual: the median
	uint64_t missed_ = 0;
};

} // namespace arift
