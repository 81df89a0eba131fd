#include "runtime/openxr/ext/ext_performance_settings.h"

namespace arift::openxr
{

void setPerformanceLevel(Session &, XrPerfSettingsDomainEXT domain, XrPerfSettingsLevelEXT level)
{
	if (domain != XR_PERF_SETTINGS_DOMAIN_CPU_EXT && domain != XR_PERF_SETTINGS_DOMAIN_GPU_EXT)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrPerfSettingsDomainEXT", int(domain));
	switch (level) {
	case XR_PERF_SETTINGS_LEVEL_POWER_SAVINGS_EXT:
	case XR_PERF_SETTINGS_LEVEL_SUSTAINED_LOW_EXT:
	case XR_PERF_SETTINGS_LEVEL_SUSTAINED_HIGH_EXT:
	case XR_PERF_SETTINGS_LEVEL_BOOST_EXT: return;
	default: throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrPerfSettingsLevelEXT", int(level));
	}
}

} // namespace arift::openxr
