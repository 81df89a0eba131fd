// XR_FB_color_space: applications' colours are taken for Rec. 709's and given to the panel as they are.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

void describeColorSpace(XrSystemColorSpacePropertiesFB &properties);
XrResult enumerateColorSpaces(Session &session, OutputArray<XrColorSpaceFB> spaces);
/// Throws XR_ERROR_COLOR_SPACE_UNSUPPORTED_FB for a space that is not enumerated.
void setColorSpace(Session &session, XrColorSpaceFB space);

} // namespace arift::openxr
