#include "runtime/openxr/ext/fb_display_refresh_rate.h"
#include <cmath>

namespace arift::openxr
{
namespace
{

/// As it is measured, to a tenth of a hertz: what was enumerated a minute ago is still what is got.
float rateOf(const Session &session)
{
	const double period = inSeconds(session.instance.service.timing().displayPeriod);
	return period > 0 ? float(std::round(10 / period) / 10) : 60.0f;
}

} // namespace

XrResult enumerateDisplayRefreshRates(Session &session, OutputArray<float> rates) { return rates.assign(std::array{rateOf(session)}); }

void getDisplayRefreshRate(Session &session, float &rate) { rate = rateOf(session); }

void requestDisplayRefreshRate(Session &session, float rate)
{
	constexpr float tolerance = 0.5f;
	if (rate == 0 || std::abs(rate - rateOf(session)) < tolerance) return;
	throw Error(XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB, "the panel is refreshed {} times a second, not {}", rateOf(session), rate);
}

} // namespace arift::openxr
