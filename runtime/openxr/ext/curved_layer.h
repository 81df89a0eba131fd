// What the layers on cylinders and spheres have in common.
#pragma once
#include "runtime/ipc/messages.h"
#include "runtime/openxr/api.h"
#include "runtime/openxr/error.h"
#include <cmath>
#include <numbers>
#include <optional>

namespace arift::openxr
{

/// The wire's: 0 for what is infinitely far. Throws XR_ERROR_VALIDATION_FAILURE for negative ones.
inline float radiusOf(float radius)
{
	constexpr float farthest = 1e5f; // metres: nothing moves that much that it could be told from infinity
	if (!(radius >= 0)) throw Error(XR_ERROR_VALIDATION_FAILURE, "a curved layer has the radius {} m", radius);
	return radius < farthest ? radius : 0;
}

/// Applications make pi themselves: a little beyond is within.
inline void requireWithin(const char *what, float angle, float least, float most)
{
	constexpr float rounding = 1e-4f;
	if (!(angle >= least - rounding && angle <= most + rounding))
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is {}, not in {} to {}", what, angle, least, most);
}

/// A surface that is so narrow that its numbers make no sense shows nothing.
inline std::optional<ipc::CurvedSurface> unlessEmpty(const ipc::CurvedSurface &surface)
{
	constexpr float most = 1e5f;
	for (const float number : {surface.uvAhead.x, surface.uvAhead.y, surface.uvPerUnit.x, surface.uvPerUnit.y})
		if (!(std::abs(number) < most)) return std::nullopt;
	return surface;
}

} // namespace arift::openxr
