#include "runtime/motion/view_poses.h"

namespace arift
{

XrTime exposureShownAt(const ipc::CameraTiming &camera, XrTime displayTime, XrDuration latchBeforeDisplay)
{
	constexpr double oldest = 1e9;
	if (camera.period <= 0) return displayTime;
	// The table may hold anything: subtract with wrap-around, go on in double (exact within 100 days of the reference), judge the result.
	const double sinceReference = double(XrDuration(uint64_t(displayTime) - uint64_t(camera.reference)));
	const double newestUsable = sinceReference - double(latchBeforeDisplay) - double(camera.delay);
	const double age = sinceReference - std::floor(newestUsable / double(camera.period)) * double(camera.period);
	return age >= 0 && age <= oldest ? displayTime - XrDuration(age) : displayTime;
}

XrPosef headInOrigin(const ipc::ViewTable &views, const HeadMotion &head)
{
	return NeckModel{views.pivotInHead}.head(head.at.headInOrigin);
}

XrPosef viewInOrigin(const ipc::ViewTable &views, uint32_t eye, const XrPosef &headAtDisplay, const XrPosef &headAtExposure)
{
	const XrPosef eyeNow = headAtDisplay * views.eyeInHead[eye];
	const XrVector3f cameraThen = headAtExposure * views.cameraInHead[eye].position;
	return {eyeNow.orientation, eyeNow.position * (1 - views.viewOffset) + cameraThen * views.viewOffset};
}

} // namespace arift
