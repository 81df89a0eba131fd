// XR_EXT_user_presence on a headset that does not feel whether it is worn.
#pragma once
#include "runtime/openxr/api.h"

namespace arift::openxr
{

inline void describeUserPresence(XrSystemUserPresencePropertiesEXT &properties) { properties.supportsUserPresence = XR_FALSE; }

} // namespace arift::openxr
