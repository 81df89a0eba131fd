// XR_KHR_composition_layer_color_scale_bias: straight colour and alpha of a layer, scaled and offset before it is blended.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"
#include <algorithm>
#include <cmath>

namespace arift::openxr
{

/// Negative scales count as zero, says the specification. Throws XR_ERROR_VALIDATION_FAILURE for what is no number.
inline void applyColorScaleBias(ipc::Layer &layer, const void *next)
{
	const auto *given = findInChain<XrCompositionLayerColorScaleBiasKHR>(next);
	if (!given) return;
	constexpr float most = 1e3f; // of what a display of 8 bits shows
	const auto limited = [&](float number, float least) {
		if (!std::isfinite(number)) throw Error(XR_ERROR_VALIDATION_FAILURE, "a layer's color scale or bias is {}", number);
		return std::clamp(number, least, most);
	};
	const auto limitedColor = [&](const XrColor4f &c, float least) {
		return XrColor4f{limited(c.r, least), limited(c.g, least), limited(c.b, least), limited(c.a, least)};
	};
	layer.colorScale = limitedColor(given->colorScale, 0);
	layer.colorBias = limitedColor(given->colorBias, -most);
}

} // namespace arift::openxr
