// XR_FB_display_refresh_rate: the panel has one rate.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

XrResult enumerateDisplayRefreshRates(Session &session, OutputArray<float> rates);
void getDisplayRefreshRate(Session &session, float &rate);
/// 0: the application has no preference. Throws XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB for another rate than the panel's.
void requestDisplayRefreshRate(Session &session, float rate);

} // namespace arift::openxr
