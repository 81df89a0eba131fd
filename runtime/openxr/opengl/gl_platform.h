// OpenXR's structures that hold GLX types. Comes before every other header of ours: the platform header is read once. The macros that X11
// defines for everybody end here.
#pragma once
#include <GL/glx.h>
#undef Always
#undef Bool
#undef None
#undef Status
#undef Success
#undef True
#undef False
#define XR_USE_PLATFORM_XLIB
#include "runtime/openxr/api.h"
