// What of a view its lens shows, as applications are told (XR_KHR_visibility_mask).
#pragma once
#include "runtime/ipc/pages.h"
#include "runtime/optics/lens_model.h"

namespace arift
{

/// `fov`: of the eye's view. Nothing that the lens shows lies outside.
ipc::LensOutline lensOutline(const LensModel &lens, Eye eye, const XrFovf &fov);

} // namespace arift
