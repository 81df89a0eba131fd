// When a camera's images are taken: period, phase and delay out of what its images say, and a time without their jitter.
#include "runtime/compositor/camera_feed.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace arift;

TEST(CameraTimingEstimate, FindsPeriodPhaseAndDelayThroughJitterAndLoss)
{
	CameraTimingEstimate estimate;
	constexpr XrDuration cameraPeriod = 23'255'814, delay = 25 * millisecond;
	uint64_t sequence = 0;
	for (int i = 0; i < 60; ++i) {
		sequence += i % 7 == 3 ? 2 : 1; // lost images count
		const XrDuration jitter = (i * 7919 % 13 - 6) * 20 * microsecond;
		const XrDuration late = i % 20 == 11 ? 12 * millisecond : 0; // a slow transfer now and then
		const XrTime middle = second + XrTime(sequence) * cameraPeriod + jitter;
		estimate.add(sequence, middle, middle + delay + late);
	}
	const ipc::CameraTiming timing = estimate.timing();
	EXPECT_NEAR(double(timing.period), double(cameraPeriod), 10'000);
	EXPECT_NEAR(double(timing.delay), double(delay), 1e5);
	const double beat = std::fmod(double(timing.reference - second), double(cameraPeriod)) / double(cameraPeriod);
	EXPECT_LT(std::min(beat, 1 - beat), 0.003);
}

TEST(CameraTimingEstimate, ForgetsACameraThatWasRestarted)
{
	CameraTimingEstimate estimate;
	for (int i = 1; i < 10; ++i) estimate.add(i, i * second, i * second);
	estimate.add(1, 20 * second, 20 * second);
	EXPECT_EQ(estimate.timing().period, 0) << "one image says nothing of a period";
}

TEST(CameraFeed, ATimesJitterIsSmoothedAndAChangeIsFollowed)
{
	CameraFeed feed;
	constexpr XrDuration cameraPeriod = 23'255'814;
	double told = 0, found = 0;
	uint64_t sequence = 0;
	XrTime truth = second;
	const auto put = [&](XrDuration error) {
		truth += cameraPeriod;
		feed.put({.frame = {.midExposure = truth + error, .sequence = ++sequence}}, truth + 25 * millisecond);
		return double(feed.newest()->frame.midExposure - truth);
	};
	for (int i = 0; i < 200; ++i) {
		const XrDuration error = (i * 7919 % 13 - 6) * 170 * microsecond; // within 1.02 ms
		const double left = put(error);
		if (i < 31) continue;
		told += double(error) * double(error);
		found += left * left;
	}
	EXPECT_LT(std::sqrt(found / told), 0.5) << "root mean square of what is left";
	feed.lose();
	for (int i = 0; i < 40; ++i) EXPECT_NEAR(put(0), 0, 1000);
	EXPECT_NEAR(put(4 * millisecond), 4e6, 1000) << "a longer exposure is no jitter";
}

TEST(CameraFeed, ALostCameraHasNoImage)
{
	CameraFeed feed;
	feed.put({.frame = {.midExposure = 1, .sequence = 1}}, 2);
	EXPECT_TRUE(feed.newest());
	feed.lose();
	EXPECT_FALSE(feed.newest());
	EXPECT_EQ(feed.timing().period, 0);
	EXPECT_EQ(feed.received(), 1u);
}
