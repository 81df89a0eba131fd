// XR_META_performance_metrics: what a frame costs the application, as far as this library sees it.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

XrResult enumeratePerformanceMetricsCounterPaths(Instance &instance, OutputArray<XrPath> paths);
void setPerformanceMetricsState(Session &session, const XrPerformanceMetricsStateMETA &state);
void getPerformanceMetricsState(Session &session, XrPerformanceMetricsStateMETA &state);
/// Throws XR_ERROR_VALIDATION_FAILURE while metrics are off, XR_ERROR_PATH_UNSUPPORTED for a path that is not enumerated.
void queryPerformanceMetricsCounter(Session &session, XrPath path, XrPerformanceMetricsCounterMETA &counter);

} // namespace arift::openxr
