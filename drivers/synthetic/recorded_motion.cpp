#include "drivers/synthetic/recorded_motion.h"
#include "drivers/replay/brd_file.h"
#include <algorithm>
#include <array>

namespace arift::synthetic
{

namespace
{

/// Seconds between control points: keeps motion up to some 5 Hz, and keeps millimetres of tracking noise out of the acceleration.
constexpr double knotPeriod = 0.03;

struct Spline {
	glm::dquat orientation[3]{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}; ///< unnormalised, and its derivatives by time
	glm::dvec3 position[3]{};
};

/// Weights of the four control points around a point `s` (0 to 1) of a segment, and their derivatives by time.
std::array<std::array<double, 4>, 3> weights(double s)
{
	const double r = 1 - s, h = knotPeriod;
	return {{{r * r * r / 6, (3 * s * s * s - 6 * s * s + 4) / 6, (-3 * s * s * s + 3 * s * s + 3 * s + 1) / 6, s * s * s / 6},
			 {-r * r / (2 * h), (3 * s * s - 4 * s) / (2 * h), (-3 * s * s + 2 * s + 1) / (2 * h), s * s / (2 * h)},
			 {r / (h * h), (3 * s - 2) / (h * h), (1 - 3 * s) / (h * h), s / (h * h)}}};
}

class Recorded final : public HeadMotion
{
public:
	Recorded(const Trajectory &trajectory, double delay) : delay_(delay)
	{
		const double length = trajectory.back().seconds;
		for (double knot = 0; knot < length + knotPeriod; knot += knotPeriod) controls_.push_back(average(trajectory, knot));
	}

	HeadState at(double seconds) const override
	{
		const Spline s = evaluate(seconds - delay_);
		const glm::dquat &q = s.orientation[0], &rate = s.orientation[1];
		const double norm2 = glm::dot(q, q);
		const glm::dquat first = glm::conjugate(q) * rate, second = glm::conjugate(q) * s.orientation[2];
		// q = |q| u, and u' = u (0, w) / 2: w = 2 Im(q* q') / |q|^2; the derivative of that for the acceleration
		const glm::dvec3 velocity = 2.0 * glm::dvec3{first.x, first.y, first.z} / norm2;
		const glm::dvec3 acceleration = 2.0 * glm::dvec3{second.x, second.y, second.z} / norm2 - velocity * (2 * glm::dot(q, rate) / norm2);
		return {glm::normalize(q), s.position[0], s.position[2], velocity, acceleration};
	}

private:
	/// The mean pose around a time, its quaternion in the hemisphere of the one before.
	TimedPose average(const Trajectory &trajectory, double knot) const
	{
		constexpr int half = 2;
		TimedPose mean{knot, {0, 0, 0, 0}, {}};
		const glm::dquat side = controls_.empty() ? trajectory.front().orientation : controls_.back().orientation;
		for (int i = -half; i <= half; i++) {
			const TimedPose pose = interpolate(trajectory, knot + i * knotPeriod / (2 * half + 1));
			mean.orientation = mean.orientation + (glm::dot(pose.orientation, side) < 0 ? -pose.orientation : pose.orientation);
			mean.position += pose.position / double(2 * half + 1);
		}
		mean.orientation = glm::normalize(mean.orientation);
		return mean;
	}

	Spline evaluate(double time) const
	{
		const double last = double(controls_.size() + 2);
		const double place = std::clamp(time / knotPeriod, -2.0, last);
		const double segment = std::min(std::floor(place), last - 1);
		const auto weight = weights(place - segment);
		Spline s;
		for (int i = 0; i < 4; i++) {
			const int64_t index = std::clamp<int64_t>(int64_t(segment) - 1 + i, 0, int64_t(controls_.size()) - 1);
			const TimedPose &control = controls_[size_t(index)];
			for (int order = 0; order < 3; order++) {
				s.orientation[order] = s.orientation[order] + control.orientation * weight[size_t(order)][size_t(i)];
				s.position[order] += control.position * weight[size_t(order)][size_t(i)];
			}
		}
		return s;
	}

	std::vector<TimedPose> controls_;
	const double delay_;
};

} // namespace

Trajectory readTrajectory(const std::filesystem::path &file)
{
	if (file.extension() != ".brd") return fromStart(readTrajectoryCsv(file));
	const replay::BrdRecording recording = replay::readBrd(file);
	return replay::headTrajectory(recording, replay::imuInHead(recording));
}

std::unique_ptr<HeadMotion> makeRecorded(const Trajectory &trajectory, double delay)
{
	return std::make_unique<Recorded>(trajectory, delay);
}

} // namespace arift::synthetic
