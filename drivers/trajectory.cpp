#include "drivers/trajectory.h"
#include "drivers/files.h"
#include <algorithm>

namespace arift
{

TimedPose interpolate(const Trajectory &trajectory, double seconds)
{
	const auto after =
		std::upper_bound(trajectory.begin(), trajectory.end(), seconds, [](double t, const TimedPose &pose) { return t < pose.seconds; });
	if (after == trajectory.begin()) return trajectory.front();
	if (after == trajectory.end()) return trajectory.back();
	const TimedPose &before = after[-1];
	const double share = (seconds - before.seconds) / (after->seconds - before.seconds);
	return {seconds, glm::slerp(before.orientation, after->orientation, share), glm::mix(before.position, after->position, share)};
}

Trajectory fromStart(const Trajectory &trajectory)
{
	const glm::dquat heading = glm::conjugate(toGlm(headingOf(toXr(trajectory.front().orientation))));
	const glm::dvec3 origin = trajectory.front().position;
	Trajectory moved(trajectory);
	for (TimedPose &pose : moved) {
		pose.orientation = glm::normalize(heading * pose.orientation);
		pose.position = heading * (pose.position - origin);
	}
	return moved;
}

Trajectory readTrajectoryCsv(const std::filesystem::path &file)
{
	constexpr double farthest = 1000; // metres
	CsvReader csv(file);
	Trajectory trajectory;
	for (int64_t first = 0; csv.next();) {
		const int64_t time = csv.integer(0);
		if (trajectory.empty()) first = time;
		const TimedPose pose{inSeconds(time - first),
							 glm::dquat(csv.number(4), csv.number(5), csv.number(6), csv.number(7)),
							 {csv.number(1), csv.number(2), csv.number(3)}};
		if (!trajectory.empty() && pose.seconds <= trajectory.back().seconds) csv.complain(0, "a time after that of the row before");
		if (std::abs(glm::length(pose.orientation) - 1) > 0.01) csv.complain(4, "a unit quaternion w,x,y,z in columns 5 to 8");
		if (glm::length(pose.position) > farthest) csv.complain(1, "a position in metres");
		trajectory.push_back(pose);
		trajectory.back().orientation = glm::normalize(pose.orientation);
	}
	if (trajectory.size() < 2) throw InputError("{}: {} poses, expected rows time_ns,px,py,pz,qw,qx,qy,qz", csv.where(), trajectory.size());
	return trajectory;
}

} // namespace arift
