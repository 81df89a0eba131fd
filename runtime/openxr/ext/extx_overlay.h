// XR_EXTX_overlay: sessions that lie over whatever else is shown.
#pragma once
#include "runtime/openxr/instance.h"

namespace arift::openxr
{

/// What makes a session an overlay; null for one that is none.
inline const XrSessionCreateInfoOverlayEXTX *overlayIn(const Instance &instance, const void *next)
{
	const auto *overlay = instance.has(Extension::EXTX_overlay) ? findInChain<XrSessionCreateInfoOverlayEXTX>(next) : nullptr;
	if (overlay && overlay->createFlags != 0)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "createFlags of the overlay is {:#x}, not 0", overlay->createFlags);
	return overlay;
}

inline XrEventDataMainSessionVisibilityChangedEXTX mainVisibilityEvent(const ipc::Event &news)
{
	return {XR_TYPE_EVENT_DATA_MAIN_SESSION_VISIBILITY_CHANGED_EXTX, nullptr, news.visible ? XrBool32(XR_TRUE) : XrBool32(XR_FALSE),
			news.flags};
}

} // namespace arift::openxr
