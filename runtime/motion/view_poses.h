// Where the views are: the one rule that client library and compositor share. Pure arithmetic on the service's published tables.
#pragma once
#include "runtime/ipc/pages.h"
#include "runtime/motion/motion_sample.h"

namespace arift
{

/// Mid-exposure of the camera image that will be shown at `displayTime`: the newest one usable `latchBeforeDisplay` earlier, when the
/// compositor takes it. `displayTime` itself when there is no camera, or when the timing makes no sense (an exposure that is not within
/// the second before the display time).
XrTime exposureShownAt(const ipc::CameraTiming &camera, XrTime displayTime, XrDuration latchBeforeDisplay);

/// The head's pose by the neck model.
inline XrPosef headInOrigin(const ipc::ViewTable &views, const HeadMotion &head)
{
	return NeckModel{views.pivotInHead}.head(head.at.headInOrigin);
}

/// The view of eye `eye` (0 left, 1 right), also the pose from which its camera image is seen: the orientation is the eye's at display
/// time; the position lies between the eye's at display time (viewOffset 0) and the camera's at the exposure shown then (viewOffset 1). At
/// 1 both hologram and camera image are seen from where the camera was, so the head's translation during the camera's latency does no harm.
/// The heads are headInOrigin()'s at those two times; given in another frame, the view is in that.
inline XrPosef viewInOrigin(const ipc::ViewTable &views, uint32_t eye, const XrPosef &headAtDisplay, const XrPosef &headAtExposure)
{
	const XrQuaternionf orientation = headAtDisplay.orientation * views.eyeInHead[eye].orientation;
	const auto eyeNow = [&] { return headAtDisplay * views.eyeInHead[eye].position; };
	const auto cameraThen = [&] { return headAtExposure * views.cameraInHead[eye].position; };
	if (views.viewOffset == 1) return {orientation, cameraThen()};
	return {orientation, eyeNow() * (1 - views.viewOffset) + cameraThen() * views.viewOffset};
}

} // namespace arift
