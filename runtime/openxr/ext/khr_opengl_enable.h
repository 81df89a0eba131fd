// XR_KHR_opengl_enable, XR_KHR_opengl_es_enable and, for contexts of either through EGL, XR_MNDX_egl_enable: what they have as functions.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

void getOpenGLGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsOpenGLKHR &requirements);
void getOpenGLESGraphicsRequirements(Instance &instance, XrSystemId system, XrGraphicsRequirementsOpenGLESKHR &requirements);

} // namespace arift::openxr
