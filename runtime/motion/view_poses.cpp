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
	const double periods = newestUsable / double(camera.period);
	if (!(std::abs(periods) < 1e15)) return displayTime;
	const auto truncated = double(int64_t(periods)), whole = truncated > periods ? truncated - 1 : truncated;
	const double age = sinceReference - whole * double(camera.period);
	return age >= 0 && age <= oldest ? displayTime - XrDuration(age) : displayTime;
}

} // namespace arift
