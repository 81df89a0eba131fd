// XR_FB_composition_layer_alpha_blend: factors of a layer and of what is below it, for colour and alpha.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"

namespace arift::openxr
{

/// Throws XR_ERROR_VALIDATION_FAILURE for what is no XrBlendFactorFB.
inline void applyBlendFactors(ipc::Layer &layer, const void *next)
{
	const auto *given = findInChain<XrCompositionLayerAlphaBlendFB>(next);
	if (!given) return;
	for (const XrBlendFactorFB factor : {given->srcFactorColor, given->dstFactorColor, given->srcFactorAlpha, given->dstFactorAlpha})
		if (factor < XR_BLEND_FACTOR_ZERO_FB || factor > XR_BLEND_FACTOR_ONE_MINUS_DST_ALPHA_FB)
			throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrBlendFactorFB", int(factor));
	layer.blend = {1, uint32_t(given->srcFactorColor), uint32_t(given->dstFactorColor), uint32_t(given->srcFactorAlpha),
				   uint32_t(given->dstFactorAlpha)};
}

} // namespace arift::openxr
