// XR_VARJO_composition_layer_depth_test: a projection layer hidden by what is nearer, within a range of distances.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"
#include <cmath>

namespace arift::openxr
{

/// Throws XR_ERROR_VALIDATION_FAILURE for what is no range.
inline void applyDepthTestRange(ipc::Layer &layer, const void *next)
{
	const auto *given = findInChain<XrCompositionLayerDepthTestVARJO>(next);
	if (!given) return;
	const float nearest = given->depthTestRangeNearZ, farthest = given->depthTestRangeFarZ;
	if (!(nearest >= 0 && nearest < farthest))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "depths from {} to {} m are no range", nearest, farthest);
	constexpr float endless = 1e6f;
	layer.depthTest = {1, XR_COMPARE_OP_LESS_OR_EQUAL_FB, 1, std::min(nearest, endless), farthest < endless ? farthest : 0};
}

} // namespace arift::openxr
