// XR_KHR_composition_layer_cube: a cube map infinitely far away.
#pragma once
#include "runtime/openxr/swapchain.h"

namespace arift::openxr
{

/// The specification says nothing of handedness: a direction in the layer's frame is looked up as the graphics APIs look up cube maps.
/// Throws XR_ERROR_LAYER_INVALID for a swapchain without faces.
inline XrSwapchainSubImage wholeFaceOf(const XrCompositionLayerCubeKHR &cube, const Swapchain &swapchain)
{
	const gpu::ImageSpec &spec = swapchain.spec();
	return {cube.swapchain, {{0, 0}, {int32_t(spec.width), int32_t(spec.height)}}, cube.imageArrayIndex};
}

} // namespace arift::openxr
