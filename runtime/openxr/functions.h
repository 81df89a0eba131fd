// The table of all entry points. OpenXR 1.1, "Function Pointers" (xrGetInstanceProcAddr).
#pragma once
#include "runtime/openxr/api.h"
#include <vector>

namespace arift::openxr
{

/// XR_ERROR_FUNCTION_UNSUPPORTED for what the instance's version and extensions do not have; XR_ERROR_HANDLE_INVALID without an instance,
/// but for the functions that need none.
XrResult getInstanceProcAddr(XrInstance instance, const char *name, PFN_xrVoidFunction *function) noexcept;

/// All names, whatever they need.
std::vector<const char *> functionNames();

} // namespace arift::openxr
