// How often applications are shown: the period they are told. Pure arithmetic.
#pragma once
#include "runtime/base/xr.h"
#include <array>
#include <cstddef>

namespace arift
{

/// A compositor that cannot make an image for every refresh shows an application as seldom as itself: frames in between would be drawn for
/// nothing, on the processor that it lacks.
class Pace
{
public:
	/// The image that can be drawn for next will be seen at `display`; `refresh`: the panel's period.
	void offer(XrTime display, XrDuration refresh);
	/// From one image to the next, as it has been lately: the panel's period as long as hardly a refresh is missed. 0 before the first.
	XrDuration period() const;

private:
	static constexpr size_t kept = 32;
	std::array<XrDuration, kept> intervals_{};
	size_t count_ = 0;
	XrTime newest_ = 0;
	XrDuration refresh_ = 0;
};

} // namespace arift
