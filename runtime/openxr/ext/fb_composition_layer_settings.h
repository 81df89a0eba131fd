// XR_FB_composition_layer_settings: wishes for sharper or smoother layers. They are accepted; the compositor's one filter stays.
#pragma once
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"

namespace arift::openxr
{

/// Throws XR_ERROR_VALIDATION_FAILURE for unknown bits.
inline void requireLayerSettings(const void *next)
{
	constexpr XrCompositionLayerSettingsFlagsFB known = 0x2f; // super sampling and sharpening, normal and quality; filter chosen by runtime
	const auto *settings = findInChain<XrCompositionLayerSettingsFB>(next);
	if (settings && (settings->layerFlags & ~known))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "the layer's settings {:#x} have unknown bits", settings->layerFlags);
}

} // namespace arift::openxr
