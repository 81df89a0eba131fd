// XR_KHR_composition_layer_equirect2: the inside of a part of a sphere, by its angles.
#pragma once
#include "runtime/openxr/ext/curved_layer.h"

namespace arift::openxr
{

/// Nothing where it has no area. Throws XR_ERROR_VALIDATION_FAILURE for numbers out of the specification's ranges.
inline std::optional<ipc::CurvedSurface> surfaceOf(const XrCompositionLayerEquirect2KHR &equirect)
{
	constexpr float right = std::numbers::pi_v<float> / 2;
	requireWithin("centralHorizontalAngle", equirect.centralHorizontalAngle, 0, 4 * right);
	requireWithin("upperVerticalAngle", equirect.upperVerticalAngle, -right, right);
	requireWithin("lowerVerticalAngle", equirect.lowerVerticalAngle, -right, right);
	const float high = equirect.upperVerticalAngle - equirect.lowerVerticalAngle;
	if (!(high > 0)) return std::nullopt;
	const ipc::CurvedSurface surface{
		radiusOf(equirect.radius), {0.5f, equirect.upperVerticalAngle / high}, {1 / equirect.centralHorizontalAngle, -1 / high}};
	return unlessEmpty(surface);
}

} // namespace arift::openxr
