// XR_KHR_composition_layer_equirect: the inside of a part of a sphere.
#pragma once
#include "runtime/openxr/ext/curved_layer.h"

namespace arift::openxr
{

/// The image takes `scale` of the sphere's 2 pi and pi, its middle off -z by `bias` of them, to the right and downwards: so the conformance
/// tests read what the specification leaves open. Nothing where it has no area. Throws XR_ERROR_VALIDATION_FAILURE for what is no number.
inline std::optional<ipc::CurvedSurface> surfaceOf(const XrCompositionLayerEquirectKHR &equirect)
{
	constexpr float half = std::numbers::pi_v<float>;
	const auto &[scale, bias] = std::pair(equirect.scale, equirect.bias);
	for (const float number : {scale.x, scale.y, bias.x, bias.y})
		if (!std::isfinite(number))
			throw Error(XR_ERROR_VALIDATION_FAILURE, "an equirect layer has scale ({}, {}) and bias ({}, {})", scale.x, scale.y, bias.x,
						bias.y);
	const ipc::CurvedSurface surface{
		radiusOf(equirect.radius), {0.5f - bias.x / scale.x, 0.5f - bias.y / scale.y}, {1 / (2 * half * scale.x), -1 / (half * scale.y)}};
	return unlessEmpty(surface);
}

} // namespace arift::openxr
