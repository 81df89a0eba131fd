// XR_KHR_visibility_mask: which part of a view the lens shows.
#pragma once
#include "runtime/openxr/session.h"

namespace arift::openxr
{

/// A mesh in the plane z = -1 of a view; triangles, where it has any, are counter-clockwise.
struct MaskMesh {
	std::vector<XrVector2f> vertices;
	std::vector<uint32_t> indices;
};
/// `outline`: what the lens shows, counter-clockwise around `centre`, within the field of view, with a point in the direction of each of
/// its corners. Empty where the lens shows all of the field of view. Throws XR_ERROR_VALIDATION_FAILURE for an unknown type.
MaskMesh makeMask(XrVisibilityMaskTypeKHR type, std::span<const XrVector2f> outline, XrVector2f centre, const XrFovf &fov);

XrResult getVisibilityMask(Session &session, XrViewConfigurationType type, uint32_t viewIndex, XrVisibilityMaskTypeKHR maskType,
						   XrVisibilityMaskKHR &mask);

} // namespace arift::openxr
