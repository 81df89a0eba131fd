// XR_EXT_conformance_automation: an application that plays the devices of its own session.
#pragma once
#include "runtime/openxr/space.h"

namespace arift::openxr
{

void setInputDeviceActive(Session &session, XrPath interactionProfile, XrPath topLevelPath, XrBool32 isActive);
void setInputDeviceStateBool(Session &session, XrPath topLevelPath, XrPath inputSourcePath, XrBool32 state);
void setInputDeviceStateFloat(Session &session, XrPath topLevelPath, XrPath inputSourcePath, float state);
void setInputDeviceStateVector2f(Session &session, XrPath topLevelPath, XrPath inputSourcePath, XrVector2f state);
void setInputDeviceLocation(Session &session, XrPath topLevelPath, XrPath inputSourcePath, Space &space, XrPosef pose);

} // namespace arift::openxr
