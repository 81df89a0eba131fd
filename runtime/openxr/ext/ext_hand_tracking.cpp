#include "runtime/openxr/ext/ext_hand_tracking.h"

namespace arift::openxr
{

void describeHandTracking(XrSystemHandTrackingPropertiesEXT &properties) { properties.supportsHandTracking = XR_FALSE; }

void createHandTracker(Session &, const XrHandTrackerCreateInfoEXT &info, XrHandTrackerEXT &)
{
	if (info.hand != XR_HAND_LEFT_EXT && info.hand != XR_HAND_RIGHT_EXT)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrHandEXT", int(info.hand));
	if (info.handJointSet != XR_HAND_JOINT_SET_DEFAULT_EXT)
		throw Error(XR_ERROR_VALIDATION_FAILURE, "{} is no XrHandJointSetEXT", int(info.handJointSet));
	throw Error(XR_ERROR_FEATURE_UNSUPPORTED, "this headset tracks no hands, as supportsHandTracking says");
}

void destroyHandTracker(EvenIfLost<HandTracker> tracker) { handles.destroy(*tracker); }

void locateHandJoints(HandTracker &, const XrHandJointsLocateInfoEXT &info, XrHandJointLocationsEXT &locations)
{
	requireTime(info.time);
	locations.isActive = XR_FALSE;
}

} // namespace arift::openxr
