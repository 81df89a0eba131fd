// XR_META_headset_id: one number for this kind of headset.
#pragma once
#include "runtime/openxr/api.h"

namespace arift::openxr
{

/// An Oculus Rift DK1 with two cameras, or what is simulated in its place.
inline void describeHeadsetId(XrSystemHeadsetIdPropertiesMETA &properties)
{
	properties.id = {{0x2f, 0x1d, 0x6a, 0x84, 0x90, 0xc3, 0x4b, 0x7e, 0xa1, 0x52, 0x0e, 0xd5, 0x37, 0xb8, 0xc9, 0x46}};
}

} // namespace arift::openxr
