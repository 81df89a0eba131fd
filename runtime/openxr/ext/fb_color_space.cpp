#include "runtime/openxr/ext/fb_color_space.h"

namespace arift::openxr
{
namespace
{

/// Nothing is converted, whichever of both is set.
constexpr std::array spaces{XR_COLOR_SPACE_REC709_FB, XR_COLOR_SPACE_UNMANAGED_FB};

} // namespace

void describeColorSpace(XrSystemColorSpacePropertiesFB &properties) { properties.colorSpace = spaces[0]; }

XrResult enumerateColorSpaces(Session &, OutputArray<XrColorSpaceFB> found) { return found.assign(spaces); }

void setColorSpace(Session &, XrColorSpaceFB space)
{
	if (std::ranges::find(spaces, space) == spaces.end())
		throw Error(XR_ERROR_COLOR_SPACE_UNSUPPORTED_FB, "colour space {} is not one of xrEnumerateColorSpacesFB", int(space));
}

} // namespace arift::openxr
