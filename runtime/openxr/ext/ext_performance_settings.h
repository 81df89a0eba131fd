// XR_EXT_performance_settings: hints that a desktop's own governors take better care of; they are checked and change nothing.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

void setPerformanceLevel(Session &session, XrPerfSettingsDomainEXT domain, XrPerfSettingsLevelEXT level);

} // namespace arift::openxr
