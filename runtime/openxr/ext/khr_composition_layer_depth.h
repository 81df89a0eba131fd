// XR_KHR_composition_layer_depth: how far away what a projection view shows is.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"
#include <cmath>

namespace arift::openxr
{

/// How values in a depth image become distances; its image is not set. Throws XR_ERROR_VALIDATION_FAILURE for numbers out of the
/// specification's ranges.
inline ipc::ViewDepth depthOf(const XrCompositionLayerDepthInfoKHR &info)
{
	if (!(info.minDepth >= 0 && info.minDepth < info.maxDepth && info.maxDepth <= 1))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "depths from {} to {} are not ascending within 0 to 1", info.minDepth, info.maxDepth);
	if (!(info.nearZ > 0 && info.farZ > 0) || info.nearZ == info.farZ)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "nearZ is {} and farZ {}: they are not two different distances", info.nearZ, info.farZ);
	// The inverse of the distance is linear in the depth, from 1 / nearZ at minDepth to 1 / farZ at maxDepth.
	const float atNear = 1 / info.nearZ, atFar = 1 / info.farZ;
	const float scale = (atFar - atNear) / (info.maxDepth - info.minDepth);
	return {{}, atNear - scale * info.minDepth, scale};
}

} // namespace arift::openxr
