// The unit in which frames are measured: what this machine takes for the simplest picture of the panel's size.
#pragma once
#include <cstdint> // for what glslang makes

namespace arift::bench
{

/// CPU milliseconds of one pass over 1280 x 800 pixels with one bilinear sample each, the best of several rounds.
double plainPassMilliseconds();

} // namespace arift::bench
