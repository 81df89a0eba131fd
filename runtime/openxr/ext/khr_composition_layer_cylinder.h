// XR_KHR_composition_layer_cylinder: the inside of a section of a cylinder.
#pragma once
#include "runtime/openxr/ext/curved_layer.h"

namespace arift::openxr
{

/// Nothing where it has no area. Throws XR_ERROR_VALIDATION_FAILURE for numbers out of the specification's ranges.
inline std::optional<ipc::CurvedSurface> surfaceOf(const XrCompositionLayerCylinderKHR &cylinder)
{
	constexpr float turn = 2 * std::numbers::pi_v<float>;
	requireWithin("centralAngle", cylinder.centralAngle, 0, turn);
	if (!(cylinder.aspectRatio > 0) || !std::isfinite(cylinder.aspectRatio))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "a cylinder layer has the aspectRatio {}", cylinder.aspectRatio);
	// As high as radius * angle / aspectRatio, and in radii.
	const ipc::CurvedSurface surface{
		radiusOf(cylinder.radius), {0.5f, 0.5f}, {1 / cylinder.centralAngle, -cylinder.aspectRatio / cylinder.centralAngle}};
	return unlessEmpty(surface);
}

} // namespace arift::openxr
