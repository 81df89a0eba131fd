// The direction every pixel of a camera looks in, worked out once.
#pragma once
#include "runtime/base/xr.h"
#include "runtime/optics/camera_model.h"
#include <vector>

namespace arift
{

/// Unit directions in the CV frame (x right, y down, z forward), row by row; (0, 0, 0) where no direction maps to the pixel.
std::vector<XrVector3f> pixelRays(const CameraModel &camera);

} // namespace arift
