// The figures of the images shown.
#include "runtime/compositor/frame_record.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr XrDuration refreshPeriod = 16'691'704;

TEST(FrameRecord, CountsRefreshesWithoutAnImage)
{
	FrameRecord record;
	for (const int refresh : {0, 1, 2, 5, 6}) record.add({.displayTime = second + refresh * refreshPeriod, .period = refreshPeriod});
	const FrameFigures figures = record.figures();
	EXPECT_EQ(figures.shown, 5u);
	EXPECT_EQ(figures.missed, 2u);
	EXPECT_NEAR(figures.perSecond, 4 / (6 * inSeconds(refreshPeriod)), 1e-9);
}

TEST(FrameRecord, WhatIsLeftOutIsThatOfTheNewestImage)
{
	FrameRecord record;
	record.add({.displayTime = second, .leftOut = 3});
	EXPECT_EQ(record.figures().leftOut, 3u);
	record.add({.displayTime = second + refreshPeriod});
	EXPECT_EQ(record.figures().leftOut, 0u);
}

TEST(FrameRecord, AGapIsMoreThanOneAndAHalfPeriodsAndDarknessIsAnEyeWithoutACamera)
{
	FrameRecord record;
	constexpr std::array<std::optional<XrDuration>, 2> both{millisecond, millisecond}, one{millisecond, std::nullopt};
	for (const double refresh : {0.0, 1.0, 2.4, 3.0, 4.6, 7.6})
		record.add({.displayTime = second + XrTime(refresh * double(refreshPeriod)),
					.period = refreshPeriod,
					.cameraAge = refresh == 3 ? one : both});
	const FrameFigures figures = record.figures();
	EXPECT_EQ(figures.gaps, 2u) << "1.6 and 3 periods; 1.4 is none";
	EXPECT_NEAR(figures.longestGap, 3 * double(refreshPeriod) * 1e-6, 1e-5);
	EXPECT_EQ(figures.withoutCamera, 1u);
	record.reset();
	EXPECT_EQ(record.figures().gaps, 0u);
	EXPECT_EQ(record.figures().withoutCamera, 0u);
}

TEST(FrameRecord, StagesHaveFiguresOfTheirOwn)
{
	FrameRecord record;
	for (int i = 1; i <= 100; ++i) {
		ShownFrame frame{.displayTime = i * refreshPeriod, .period = refreshPeriod};
		for (size_t stage = 0; stage < frame.stages.size(); ++stage) frame.stages[stage] = XrDuration(stage + 1) * i * millisecond;
		record.add(frame);
	}
	const FrameFigures figures = record.figures();
	for (size_t stage = 0; stage < figures.stages.size(); ++stage) {
		EXPECT_DOUBLE_EQ(figures.stages[stage].median, 50.0 * double(stage + 1)) << frameStageNames[stage];
		EXPECT_DOUBLE_EQ(figures.stages[stage].p99, 99.0 * double(stage + 1)) << frameStageNames[stage];
	}
}

TEST(FrameRecord, MediansAndNinetyNinthPercentile)
{
	FrameRecord record;
	for (int i = 1; i <= 100; ++i)
		record.add({.displayTime = i * refreshPeriod,
					.period = refreshPeriod,
					.cameraAge = {i * millisecond, std::nullopt},
					.poseAge = 2 * i * millisecond,
					.composeCost = millisecond});
	const FrameFigures figures = record.figures();
	EXPECT_DOUBLE_EQ(figures.cameraAge.median, 50);
	EXPECT_DOUBLE_EQ(figures.cameraAge.p99, 99);
	EXPECT_DOUBLE_EQ(figures.poseAge.median, 100);
	EXPECT_DOUBLE_EQ(figures.compose.p99, 1);
}

TEST(FrameRecord, KeepsTheNewestAndAllTotals)
{
	FrameRecord record;
	for (size_t i = 0; i < 2 * FrameRecord::kept; ++i)
		record.add({.displayTime = XrTime(i) * refreshPeriod,
					.period = refreshPeriod,
					.composeCost = i < FrameRecord::kept ? second : millisecond});
	EXPECT_EQ(record.figures().shown, 2 * FrameRecord::kept);
	EXPECT_DOUBLE_EQ(record.figures().compose.p99, 1) << "the old ones are gone";
	EXPECT_EQ(FrameRecord().figures().shown, 0u);
	EXPECT_EQ(FrameRecord().figures().compose.median, 0);
}

} // namespace
} // namespace arift
