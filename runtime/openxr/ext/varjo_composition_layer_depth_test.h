// XR_VARJO_composition_layer_depth_test: a projection layer hidden by what is nearer, within a range of distances.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"
#include <cmath>

namespace arift::openxr
{

/// Sets a view's range if its chain has one. Throws XR_ERROR_VALIDATION_FAILURE for what is none.
inline bool setDepthTestRange(ipc::LayerView &view, const void *next)
{
	const auto *given = findInChain<XrCompositionLayerDepthTestVARJO>(next);
	if (!given) return false;
	const float nearest = given->depthTestRangeNearZ, farthest = given->depthTestRangeFarZ;
	if (!(nearest >= 0 && nearest < farthest))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "depths from {} to {} m are no range", nearest, farthest);
	constexpr float endless = 1e6f;
	view.depth.testedFrom = std::min(nearest, endless);
	view.depth.testedTo = farthest < endless ? farthest : 0;
	return true;
}

/// What both of a layer's views ask for.
constexpr ipc::DepthTest depthTestInRange{1, XR_COMPARE_OP_LESS_OR_EQUAL_FB, 1};

} // namespace arift::openxr
