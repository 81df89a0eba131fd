#include "runtime/tracking/head_tracker.h"
#include <algorithm>

namespace arift
{
namespace
{

/// Earth with z up in a frame with y up: (x, y, z) becomes (x, z, -y).
const glm::dquat yUp(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);

glm::dvec3 corrected(const SensorCalibration &calibration, const XrVector3f &raw)
{
	return calibration.matrix * (toGlm(raw) - calibration.bias);
}

glm::dquat aboutVertical(double angle) { return {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}; }

} // namespace

HeadTracker::HeadTracker(const ImuInfo &info, const ImuCalibration &calibration, PoseWriter &history, const HeadTrackerSettings &settings)
	: calibration_(calibration),
	  history_(history),
	  settings_(settings),
	  headInImu_(glm::conjugate(glm::normalize(toGlm(calibration.imuInHead)))),
	  imuInHead_(glm::normalize(toGlm(calibration.imuInHead))),
	  clock_(info.tickPeriod),
	  filter_(1 / info.sampleRate, settings.orientation),
	  magnetic_(1 / info.sampleRate, settings.magnetic)
{
	health_.rate = info.sampleRate;
}

void HeadTracker::add(const ImuReport &report)
{
	const uint32_t count = std::min<uint32_t>(report.sampleCount, uint32_t(report.samples.size()));
	if (count == 0) return;
	if (report.restarted) {
		clock_.reset();
		continues_ = false;
	}
	health_.lostTicks += report.lostTicks;
	clock_.add(report.samples[count - 1].tick, report.arrival);
	for (uint32_t i = 0; i < count; ++i) addSample(report.samples[i]);
	if (settings_.magneticHeading && report.magneticField) correctHeading(*report.magneticField);
}

void HeadTracker::addSample(const ImuSample &sample)
{
	const glm::dvec3 rate = corrected(calibration_.gyroscope, sample.angularVelocity);
	const int64_t ticks = std::max(1, sample.ticks), begin = sample.tick - ticks;
	if ((continues_ && sample.tick <= lastTick_) || !std::isfinite(rate.x + rate.y + rate.z)) {
		++health_.discarded;
		return;
	}
	if (!continues_) {
		filter_.interrupt();
		fit_.reset();
		turnAcceleration_ = glm::dvec3(0);
	} else if (begin > lastTick_) {
		bridge(begin - lastTick_, rate);
	}
	// An interval that overlaps the last sample's counts only from there on.
	const double period = double(continues_ ? std::min(ticks, sample.tick - lastTick_) : ticks) * clock_.tickPeriod();
	continues_ = true;
	lastTick_ = sample.tick;
	lastRate_ = rate;
	sinceField_ += period;
	filter_.update(rate, corrected(calibration_.accelerometer, sample.acceleration) - forceOfTurning(rate), period);
	publish(sample.tick, rate, period);
}

void HeadTracker::bridge(int64_t lostTicks, const glm::dvec3 &rate)
{
	const double period = double(lostTicks) * clock_.tickPeriod();
	filter_.update((lastRate_ + rate) * 0.5, glm::dvec3(NAN), period);
	fit_.reset();
	sinceField_ += period;
}

void HeadTracker::correctHeading(const XrVector3f &field)
{
	const bool first = !magnetic_.started();
	magnetic_.update(filter_.orientation() * toGlm(field), glm::length(lastRate_ - filter_.bias()), sinceField_);
	sinceField_ = 0;
	if (first) magneticStart_ = magnetic_.heading();
}

/// The neck model's part of the specific force, in the tracker's axes: 200 degrees a second about the neck are 1.3 m/s^2, 8 degrees of tilt
/// for whoever takes them for gravity.
glm::dvec3 HeadTracker::forceOfTurning(const glm::dvec3 &rate) const
{
	const glm::dvec3 turn = imuInHead_ * (rate - filter_.bias()), &lever = settings_.leverInHead;
	return headInImu_ * (glm::cross(turnAcceleration_, lever) + glm::cross(turn, glm::cross(turn, lever)));
}

void HeadTracker::publish(int64_t tick, const glm::dvec3 &rate, double period)
{
	++health_.samples;
	health_.bias = filter_.bias();
	health_.resting = filter_.state().resting;
	const RateFit::Motion motion = fit_.add(imuInHead_ * (rate - filter_.bias()), period);
	turnAcceleration_ = motion.acceleration;
	const XrTime time = clock_.timeOf(tick);
	if (!filter_.state().settled) return; // no acceleration yet: nobody knows where up is
	const glm::dquat headInEarth = aboutVertical(magnetic_.heading() - magneticStart_) * filter_.orientation() * headInImu_;
	if (!started_) originTurn_ = glm::conjugate(toGlm(headingOf(toXr(yUp * headInEarth)))) * yUp;
	started_ = true;
	if (health_.lastSample > 0) {
		const double interval = std::max(1e-6, inSeconds(time - health_.lastSample));
		health_.rate = 1 / (1 / health_.rate + (interval - 1 / health_.rate) * std::min(1.0, interval));
	}
	health_.lastSample = time;
	history_.push({time, toXr(glm::normalize(originTurn_ * headInEarth)), toXr(motion.rate), toXr(motion.acceleration)});
}

} // namespace arift
