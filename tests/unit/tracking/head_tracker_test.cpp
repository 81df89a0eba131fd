#include "runtime/tracking/head_tracker.h"
#include <functional>
#include <gtest/gtest.h>

using namespace arift;

namespace
{

constexpr float gravity = 9.80665f;
constexpr XrTime start = 100 * second;

using Rate = std::function<XrVector3f(double)>; ///< head axes, rad/s, by seconds
const Rate still = [](double) { return XrVector3f{0, 0, 0}; };

/// A head that turns as told and a tracker on it, seen from above: reports with exact times.
class HeadTrackerTest : public testing::Test
{
protected:
	using Rate = std::function<XrVector3f(double)>; ///< head axes, rad/s, by seconds

	void make(const ImuInfo &info = {}, const ImuCalibration &calibration = {}, const HeadTrackerSettings &settings = {})
	{
		info_ = info;
		calibration_ = calibration;
		tracker = std::make_unique<HeadTracker>(info, calibration, writer, settings);
		send(turn(still)); // heading is counted from the first sample
	}
	/// The next sample's interval of `ticks` ticks has passed; what the tracker measures in it.
	ImuSample turn(const Rate &rate, int32_t ticks = 1)
	{
		glm::dvec3 mean(0);
		const glm::dquat imuInHead = toGlm(calibration_.imuInHead);
		for (int32_t i = 0; i < ticks; ++i) {
			const double period = info_.tickPeriod;
			const glm::dvec3 w = toGlm(rate((double(tick_) + 0.5) * period));
			truth = glm::normalize(truth * rotationOf(w * period));
			mean += w / double(ticks);
			++tick_;
		}
		const glm::dvec3 up = glm::conjugate(truth) * glm::dvec3(0, gravity, 0);
		return {tick_, ticks, raw(calibration_.gyroscope, glm::conjugate(imuInHead) * mean),
				raw(calibration_.accelerometer, glm::conjugate(imuInHead) * up)};
	}
	static XrVector3f raw(const SensorCalibration &calibration, const glm::dvec3 &measured)
	{
		return toXr(glm::inverse(calibration.matrix) * measured + calibration.bias);
	}
	XrTime now() const { return start + XrTime(std::llround(double(tick_) * info_.tickPeriod * 1e9)); }
	void send(const ImuSample &sample) { tracker->add({.arrival = now(), .samples = {sample}, .sampleCount = 1}); }
	void run(double seconds, const Rate &rate)
	{
		for (const int64_t end = tick_ + std::llround(seconds / info_.tickPeriod); tick_ < end;) send(turn(rate));
	}
	double errorNow(XrDuration ahead = 0) const { return angleBetween(history.at(now() + ahead).at.headInOrigin, toXr(truth)) / degree; }

	std::unique_ptr<PoseRing> ring = std::make_unique<PoseRing>();
	PoseWriter writer{*ring};
	PoseHistory history{*ring};
	std::unique_ptr<HeadTracker> tracker;
	glm::dquat truth{1, 0, 0, 0};

private:
	ImuInfo info_;
	ImuCalibration calibration_;
	int64_t tick_ = 0;
};

} // namespace

TEST_F(HeadTrackerTest, AtRestTheHeadLooksAlongMinusZ)
{
	make();
	run(1, still);
	EXPECT_LT(errorNow(), 0.001);
	EXPECT_EQ(tracker->health().samples, 1001u);
	EXPECT_EQ(tracker->health().lastSample, history.at(now()).at.time);
	EXPECT_NEAR(tracker->health().rate, 1000, 1);
}

TEST_F(HeadTrackerTest, TheFirstHeadingIsZeroHoweverTheHeadIsTilted)
{
	truth = rotationOf({0, 1.3, 0}) * rotationOf({-0.6, 0, 0});
	make();
	run(1, still);
	truth = rotationOf({-0.6, 0, 0});
	EXPECT_LT(errorNow(), 0.01);
}

TEST_F(HeadTrackerTest, ConstantRateIsExactAndSoIsItsPrediction)
{
	make();
	const Rate rate = [](double) { return XrVector3f{0, float(200 * degree), 0}; };
	run(60, rate);
	EXPECT_LT(errorNow(), 0.05);
	const XrQuaternionf predicted = history.at(now() + 40 * millisecond).at.headInOrigin;
	const double before = errorNow();
	const glm::dquat later = toGlm(history.at(now()).at.headInOrigin) * rotationOf({0, 200 * degree * 0.04, 0});
	EXPECT_LT(angleBetween(predicted, toXr(later)) / degree, 0.01);
	EXPECT_LT(before, 0.05);
}

TEST_F(HeadTrackerTest, PredictsAHeadThatShakes)
{
	make();
	const Rate rate = [](double t) { return XrVector3f{float(0.5 * std::sin(4 * t)), float(2 * std::cos(5 * t)), 0}; };
	run(3, rate);
	double worst = 0;
	for (int i = 0; i < 1000; ++i) {
		const XrQuaternionf predicted = history.at(now() + 33 * millisecond).at.headInOrigin;
		const glm::dquat now = truth;
		const HeadMotion newest = history.at(this->now());
		EXPECT_NEAR(newest.at.angularVelocity.y, 2 * std::cos(5 * inSeconds(this->now() - start)), 0.002);
		send(turn(rate));
		glm::dquat later = now;
		const double t0 = inSeconds(newest.at.time - start);
		for (int k = 0; k < 33; ++k) later = glm::normalize(later * rotationOf(toGlm(rate(t0 + (k + 0.5) * 1e-3)) * 1e-3));
		worst = std::max(worst, angleBetween(predicted, toXr(later)) / degree);
	}
	EXPECT_LT(worst, 0.12);
}

TEST_F(HeadTrackerTest, UsesMountingAndCalibration)
{
	ImuCalibration calibration;
	calibration.imuInHead = rotationAbout({0, 0, 1}, 1.5707963);
	calibration.gyroscope = {{1.02, 0.01, 0, 0, 0.98, 0, -0.02, 0, 1.01}, {0.01, -0.02, 0.03}};
	calibration.accelerometer = {{0.97, 0, 0.02, 0, 1.03, 0, 0, -0.01, 1}, {0.1, 0.2, -0.1}};
	make({}, calibration);
	run(5, [](double t) { return XrVector3f{float(std::sin(t)), float(std::cos(2 * t)), 0.3f}; });
	EXPECT_LT(errorNow(), 0.05);
}

TEST_F(HeadTrackerTest, AnAveragedBacklogCountsForItsWholeInterval)
{
	make();
	const Rate rate = [](double) { return XrVector3f{0, 1.5f, 0}; };
	run(1, rate);
	const ImuSample averaged = turn(rate, 18), next = turn(rate), newest = turn(rate); // 20 ticks in a report that holds three
	tracker->add({.arrival = now(), .samples = {averaged, next, newest}, .sampleCount = 3});
	run(0.1, rate);
	EXPECT_LT(errorNow(), 0.01);
}

TEST_F(HeadTrackerTest, LostTicksAreBridged)
{
	make();
	const Rate rate = [](double t) { return XrVector3f{0, float(1 + t), 0}; };
	run(1, rate);
	for (int i = 0; i < 60; ++i) turn(rate); // never sent
	run(0.5, rate);
	EXPECT_LT(errorNow(), 0.05);
}

TEST_F(HeadTrackerTest, AfterALongGapTheWorldIsLevelAgainAndTimesRise)
{
	make();
	run(2, still);
	for (int i = 0; i < 2000; ++i) turn([](double) { return XrVector3f{0.3f, 0, 0}; });
	const XrTime before = tracker->health().lastSample;
	run(0.5, still);
	EXPECT_GT(tracker->health().lastSample, before + 2 * second);
	EXPECT_LT(errorNow(), 0.2);
}

TEST_F(HeadTrackerTest, ARestartKeepsTheHeading)
{
	make();
	run(1, [](double) { return XrVector3f{0, 0.5f, 0}; });
	ImuReport report{
		.arrival = now() + second, .samples = {ImuSample{1, 1, {0, 0, 0}, {0, gravity, 0}}}, .sampleCount = 1, .restarted = true};
	tracker->add(report);
	for (int i = 2; i < 500; ++i) {
		report.restarted = false;
		report.arrival += millisecond;
		report.samples[0].tick = i;
		tracker->add(report);
	}
	EXPECT_LT(angleBetween(history.at(report.arrival).at.headInOrigin, toXr(truth)) / degree, 0.1);
	EXPECT_NEAR(double(tracker->health().lastSample - report.arrival), 0, 0.1e6);
}

TEST_F(HeadTrackerTest, SamplesOutOfOrderAndNonsenseAreDropped)
{
	make();
	run(1, still);
	ImuSample broken = turn(still);
	broken.angularVelocity.x = NAN;
	send(broken);
	ImuSample old = turn(still);
	old.tick -= 500;
	send(old);
	tracker->add({.arrival = now(), .samples = {}, .sampleCount = 0});
	tracker->add({.arrival = now(), .samples = {turn(still), turn(still), turn(still)}, .sampleCount = 77});
	EXPECT_EQ(tracker->health().discarded, 2u);
	run(0.1, still);
	EXPECT_LT(errorNow(), 0.01);
}

TEST_F(HeadTrackerTest, WorksAt200Hertz)
{
	make({.tickPeriod = 5e-3, .sampleRate = 200});
	const Rate rate = [](double t) { return XrVector3f{float(std::sin(t)), float(1.5 * std::cos(2 * t)), 0}; };
	run(20, rate);
	EXPECT_LT(errorNow(), 0.1);
	EXPECT_EQ(history.at(now() + 20 * millisecond).found, Found::predicted);
	const double t = inSeconds(now() - start);
	EXPECT_NEAR(history.at(now()).at.angularVelocity.y, 1.5 * std::cos(2 * t), 0.01);
	EXPECT_NEAR(history.at(now()).at.angularAcceleration.y, -3 * std::sin(2 * t), 0.1);
}

TEST_F(HeadTrackerTest, NanosecondTicksWorkToo)
{
	make({.tickPeriod = 1e-9, .sampleRate = 200});
	ImuReport report{.sampleCount = 1};
	for (int64_t i = 1; i <= 1000; ++i) {
		report.samples[0] = {i * 5'000'000, 5'000'000, {0, 1, 0}, {0, gravity, 0}};
		report.arrival = start + i * 5 * millisecond;
		tracker->add(report);
	}
	EXPECT_LT(angleBetween(history.at(report.arrival).at.headInOrigin, rotationAbout({0, 1, 0}, 5)) / degree, 0.01 + 1e-2);
}

TEST_F(HeadTrackerTest, MagneticHeadingDoesNotTurnTheOrigin)
{
	make({}, {}, {.magneticHeading = true});
	const XrVector3f northEast{3e-5f, -4e-5f, -1e-5f};
	for (int i = 0; i < 2000; ++i) {
		const ImuSample sample = turn(still);
		tracker->add({.arrival = now(), .samples = {sample}, .sampleCount = 1, .magneticField = northEast});
	}
	EXPECT_LT(errorNow(), 0.01);
}

// A head speeds up to 200 degrees a second about its neck within a quarter of a second, shortly after the filter has started: the tracker
// feels 2.5 m/s^2 along and 1.3 m/s^2 across, and must not take them for a tilt.
TEST_F(HeadTrackerTest, TurningAboutTheNeckIsNoTilt)
{
	const glm::dvec3 lever(0, 0.075, -0.0805);
	const double full = 200 * degree, rise = 0.25;
	const auto rateAt = [&](double time) {
		const double s = (time - 0.3) / rise;
		return s <= 0 ? 0 : s >= 1 ? full : full * (1 - std::cos(M_PI * s)) / 2;
	};
	make({}, {}, {.leverInHead = lever});
	for (int i = 1; i < 3000; ++i) {
		const double time = i * 1e-3, step = 1e-4;
		ImuSample sample = turn([&](double at) { return XrVector3f{0, float(rateAt(at)), 0}; });
		const glm::dvec3 rate(0, rateAt(time), 0), change(0, (rateAt(time + step) - rateAt(time - step)) / (2 * step), 0);
		sample.acceleration = sample.acceleration + toXr(glm::cross(change, lever) + glm::cross(rate, glm::cross(rate, lever)));
		send(sample);
		const glm::dquat tilt = toGlm(inverse(history.at(now()).at.headInOrigin)) * truth;
		EXPECT_LT(2 * std::hypot(tilt.x, tilt.z) / degree, 0.1) << "after " << time << " s";
		if (HasFailure()) return;
	}
}
