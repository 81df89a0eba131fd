// XR_EXT_hand_tracking on a headset that tracks no hands: applications are told so, and no hand tracker can be made.
#pragma once
#include "runtime/openxr/session.h"
#include "runtime/openxr/space.h"

namespace arift::openxr
{

/// The kind of handle that xrCreateHandTrackerEXT would make: there is none.
class HandTracker : public Object
{
};
template <> struct HandleOf<HandTracker> {
	using type = XrHandTrackerEXT;
	static constexpr XrObjectType objectType = XR_OBJECT_TYPE_HAND_TRACKER_EXT;
};

void describeHandTracking(XrSystemHandTrackingPropertiesEXT &properties);
/// Throws XR_ERROR_FEATURE_UNSUPPORTED.
void createHandTracker(Session &session, const XrHandTrackerCreateInfoEXT &info, XrHandTrackerEXT &tracker);
void destroyHandTracker(EvenIfLost<HandTracker> tracker);
void locateHandJoints(HandTracker &tracker, const XrHandJointsLocateInfoEXT &info, XrHandJointLocationsEXT &locations);

} // namespace arift::openxr
