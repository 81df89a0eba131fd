// XR_FB_composition_layer_depth_test: a layer hidden by what is nearer in the layers below it.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"

namespace arift::openxr
{

// The service takes the one for the other.
static_assert(int(XR_COMPARE_OP_LESS_OR_EQUAL_FB) == int(VK_COMPARE_OP_LESS_OR_EQUAL));
static_assert(int(XR_COMPARE_OP_ALWAYS_FB) == int(VK_COMPARE_OP_ALWAYS));

/// Throws XR_ERROR_VALIDATION_FAILURE for what is no XrCompareOpFB.
inline void applyDepthTest(ipc::Layer &layer, const void *next)
{
	const auto *given = findInChain<XrCompositionLayerDepthTestFB>(next);
	if (!given) return;
	if (given->compareOp < XR_COMPARE_OP_NEVER_FB || given->compareOp > XR_COMPARE_OP_ALWAYS_FB)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrCompareOpFB", int(given->compareOp));
	layer.depthTest.given = 1;
	layer.depthTest.compareOp = uint32_t(given->compareOp);
	layer.depthTest.writes = given->depthMask ? 1 : 0;
}

} // namespace arift::openxr
