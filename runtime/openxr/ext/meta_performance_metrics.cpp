#include "runtime/openxr/ext/meta_performance_metrics.h"

namespace arift::openxr
{
namespace
{

constexpr const char *frameTime = "/perfmetrics_meta/app/cpu_frametime";

} // namespace

XrResult enumeratePerformanceMetricsCounterPaths(Instance &instance, OutputArray<XrPath> paths)
{
	return paths.assign(std::array{instance.paths.atom(frameTime)});
}

void setPerformanceMetricsState(Session &session, const XrPerformanceMetricsStateMETA &state)
{
	session.measuresFrames = state.enabled == XR_TRUE;
}

void getPerformanceMetricsState(Session &session, XrPerformanceMetricsStateMETA &state)
{
	state.enabled = session.measuresFrames ? XR_TRUE : XR_FALSE;
}

void queryPerformanceMetricsCounter(Session &session, XrPath path, XrPerformanceMetricsCounterMETA &counter)
{
	const std::string &text = session.instance.paths.text(path);
	if (text != frameTime) throw Error(XR_ERROR_PATH_UNSUPPORTED, "{} is no performance counter", text);
	if (!session.measuresFrames) throw Error(XR_ERROR_VALIDATION_FAILURE, "performance metrics are off");
	const FrameCost cost = session.frameCost();
	counter.counterUnit = XR_PERFORMANCE_METRICS_COUNTER_UNIT_MILLISECONDS_META;
	counter.counterFlags = cost.frames == 0 ? 0
											: XR_PERFORMANCE_METRICS_COUNTER_ANY_VALUE_VALID_BIT_META |
												  XR_PERFORMANCE_METRICS_COUNTER_FLOAT_VALUE_VALID_BIT_META;
	counter.uintValue = 0;
	counter.floatValue = float(inSeconds(cost.application) * 1000);
}

} // namespace arift::openxr
