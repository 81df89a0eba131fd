// The filter on real motion with optical ground truth: BROAD's metric, with one set of parameters for both sets.
#include "runtime/motion/prediction.h"
#include "runtime/tracking/magnetic_heading.h"
#include "runtime/tracking/orientation_filter.h"
#include "runtime/tracking/rate_fit.h"
#include "tests/common/shared_data.h"
#include "tests/unit/tracking/recordings.h"
#include <cstdio>
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::test;

namespace
{

class RecordingsTest : public testing::Test
{
protected:
	void SetUp() override
	{
		if (!sharedData("broad") || !sharedData("vi")) GTEST_SKIP() << noSharedData;
	}
};

struct Estimates {
	std::vector<glm::dquat> withoutField, withField;
};

Estimates estimate(const Recording &recording)
{
	const double period = 1 / recording.sampleRate;
	OrientationFilter filter(period);
	MagneticHeading magnetic(period);
	Estimates estimates;
	for (const RecordedSample &sample : recording.samples) {
		filter.update(sample.rate, sample.acceleration, period);
		const glm::dquat orientation = filter.orientation();
		magnetic.update(orientation * sample.field, glm::length(sample.rate - filter.bias()), period);
		const double half = magnetic.heading() / 2;
		estimates.withoutField.push_back(orientation);
		estimates.withField.push_back(glm::dquat(std::cos(half), 0, 0, std::sin(half)) * orientation);
	}
	return estimates;
}

/// RMS angle in degrees between what was predicted and what the integrated rates then gave.
std::vector<double> predictionErrors(const Recording &recording, const std::vector<XrDuration> &horizons)
{
	const double period = 1 / recording.sampleRate;
	OrientationFilter filter(period);
	RateFit fit;
	std::vector<MotionSample> samples;
	for (const RecordedSample &sample : recording.samples) {
		filter.update(sample.rate, sample.acceleration, period);
		const RateFit::Motion motion = fit.add(sample.rate - filter.bias(), period);
		const XrTime time = fromSeconds(double(samples.size()) * period);
		samples.push_back({time, toXr(filter.orientation()), toXr(motion.rate), toXr(motion.acceleration)});
	}
	std::vector<double> errors;
	for (const XrDuration horizon : horizons) {
		double sum = 0;
		size_t count = 0;
		for (size_t i = 10; i + size_t(inSeconds(horizon) / period) + 2 < samples.size(); ++i) {
			if (!recording.samples[i].moving) continue;
			const double position = double(i) + inSeconds(horizon) / period;
			const MotionSample &before = samples[size_t(position)], &after = samples[size_t(position) + 1];
			const glm::dquat then = glm::slerp(toGlm(before.headInOrigin), toGlm(after.headInOrigin), position - std::floor(position));
			sum += std::pow(angleBetween(predict(samples[i], horizon).headInOrigin, toXr(then)) / degree, 2);
			++count;
		}
		errors.push_back(std::sqrt(sum / double(count)));
	}
	return errors;
}

} // namespace

TEST_F(RecordingsTest, BroadIsFollowedAtLeastAsWellAsByVqf)
{
	const std::vector<Recording> recordings = readRecordings(*sharedData("broad"));
	ASSERT_EQ(recordings.size(), 8u);
	double total = 0, inclination = 0, drift = 0;
	for (const Recording &recording : recordings) {
		const Estimates estimates = estimate(recording);
		const OrientationError sixD = orientationError(recording, estimates.withoutField),
							   nineD = orientationError(recording, estimates.withField);
		std::printf("[ FIGURE   ] %-38s 9D total %.2f heading %.2f inclination %.2f deg, 6D drift %+.2f deg/min\n", recording.name.c_str(),
					nineD.total, nineD.heading, nineD.inclination, sixD.driftPerMinute);
		total += nineD.total / 8;
		inclination += sixD.inclination / 8;
		drift += std::abs(sixD.driftPerMinute) / 8;
	}
	std::printf("[ FIGURE   ] BROAD, 8 trials: 9D total %.3f, inclination %.3f deg, 6D drift %.2f deg/min\n", total, inclination, drift);
	EXPECT_LE(inclination, 0.80);
	EXPECT_LE(total, 2.45);
	EXPECT_LE(drift, 3.0);
}

TEST_F(RecordingsTest, HeadLikeMotionIsFollowedBetterThanByVqf)
{
	const std::vector<Recording> recordings = readRecordings(*sharedData("vi"));
	ASSERT_EQ(recordings.size(), 3u);
	double inclination = 0, drift = 0;
	for (const Recording &recording : recordings) {
		const OrientationError error = orientationError(recording, estimate(recording).withoutField);
		std::printf("[ FIGURE   ] %-14s inclination %.2f deg, drift %+.2f deg/min\n", recording.name.c_str(), error.inclination,
					error.driftPerMinute);
		inclination += error.inclination / 3;
		drift += std::abs(error.driftPerMinute) / 3;
	}
	std::printf("[ FIGURE   ] TUM-VI, 3 rooms: inclination %.3f deg, drift %.2f deg/min\n", inclination, drift);
	EXPECT_LE(inclination, 0.75);
	EXPECT_LE(drift, 1.25);
}

TEST_F(RecordingsTest, AnUncalibratedGyroscopeIsSurvivedWithoutRest)
{
	double inclination = 0;
	for (Recording recording : readRecordings(*sharedData("vi"))) { // the zero-rate offset of a real DK1 without its calibration
		for (RecordedSample &sample : recording.samples) sample.rate += glm::dvec3(-0.0412516, 0.0256156, 0.0005428);
		inclination += orientationError(recording, estimate(recording).withoutField).inclination / 3;
	}
	std::printf("[ FIGURE   ] TUM-VI with a bias of 2.8 deg/s: inclination %.2f deg\n", inclination);
	EXPECT_LE(inclination, 3.0);
}

TEST_F(RecordingsTest, PredictionOfHeadLikeMotion)
{
	const std::vector<XrDuration> horizons{20 * millisecond, 33 * millisecond, 50 * millisecond};
	std::vector<double> mean(horizons.size());
	for (const Recording &recording : readRecordings(*sharedData("vi"))) {
		const std::vector<double> errors = predictionErrors(recording, horizons);
		for (size_t i = 0; i < horizons.size(); ++i) mean[i] += errors[i] / 3;
	}
	std::printf("[ FIGURE   ] TUM-VI prediction: %.3f deg at 20 ms, %.3f at 33 ms, %.3f at 50 ms (RMS)\n", mean[0], mean[1], mean[2]);
	EXPECT_LE(mean[0], 0.038);
	EXPECT_LE(mean[1], 0.11);
	EXPECT_LE(mean[2], 0.26);
}
