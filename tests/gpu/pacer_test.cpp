// Pacing in simulated time: no thread, no sleep.
#include "runtime/compositor/pacer.h"
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace arift
{
namespace
{

constexpr XrDuration period = 16'691'704, vblankToDisplay = 25'072'135, margin = 1'000'000;
constexpr Pacer::Settings settings{.period = period, .vblankToDisplay = vblankToDisplay, .margin = margin, .firstCost = 5'000'000};

/// A display whose vertical blanks come every `truePeriod`, and a machine that composes for `cost`.
struct Simulation {
	Pacer pacer{settings, 1'000'000'000};
	XrDuration truePeriod = period, cost = 4'000'000;
	XrTime firstDisplay = 1'000'000'000 + 3'000'000; ///< not where the pacer thinks
	XrTime now = 2'000'000'000;
	bool held = true; ///< by a display with vertical synchronisation, which takes an image at its blank; else images wait in a queue
	std::optional<Pacer::Refresh> last;
	std::vector<XrTime> shown;
	std::vector<XrDuration> waitedForBlank;

	/// The display time of an image that is finished now.
	XrTime displayAfter(XrTime finished) const
	{
		const XrTime blank = firstDisplay - vblankToDisplay;
		const XrDuration k = (finished - blank + truePeriod - 1) / truePeriod;
		return firstDisplay + k * truePeriod;
	}
	Pacer::Refresh frame(XrDuration jitter = 0)
	{
		const Pacer::Refresh refresh = last ? pacer.after(last->display, now) : pacer.next(now);
		last = refresh;
		const XrTime finished = refresh.latch + cost;
		pacer.composed(cost);
		const XrTime display = displayAfter(finished);
		waitedForBlank.push_back(display - vblankToDisplay - finished);
		shown.push_back(display);
		pacer.displayed(display + jitter);
		now = held ? std::max(finished, display - vblankToDisplay) : finished;
		return refresh;
	}
	void run(int frames)
	{
		for (int i = 0; i < frames; ++i) frame();
	}
};

TEST(Pacer, theNextRefreshLeavesRoomForComposing)
{
	const Pacer pacer(settings, 1'000'000'000);
	const Pacer::Refresh refresh = pacer.next(1'000'000'000);
	EXPECT_EQ(refresh.display - refresh.vblank, vblankToDisplay);
	EXPECT_EQ(refresh.vblank - refresh.latch, pacer.cost() + margin);
	EXPECT_GE(refresh.latch, 1'000'000'000);
	EXPECT_LT(refresh.latch, 1'000'000'000 + period);
	EXPECT_EQ((refresh.display - 1'000'000'000) % period, 0);
}

TEST(Pacer, findsTheDisplaysPhaseAndPeriod)
{
	Simulation simulation;
	simulation.truePeriod = period + 20'000; // 0.12 % slower
	simulation.run(2000);
	EXPECT_NEAR(double(simulation.pacer.period()), double(simulation.truePeriod), 300);
	const Pacer::Refresh refresh = simulation.frame();
	EXPECT_NEAR(double(refresh.display), double(simulation.shown.back()), 20'000);
	EXPECT_EQ(simulation.pacer.missed(), 0u);
}

TEST(Pacer, showsAnImageAtEveryRefreshAndFinishesJustBeforeTheBlank)
{
	Simulation simulation;
	simulation.run(300);
	const size_t begin = simulation.shown.size();
	simulation.run(300);
	for (size_t i = begin; i < simulation.shown.size(); ++i) {
		EXPECT_EQ(simulation.shown[i] - simulation.shown[i - 1], period);
		EXPECT_NEAR(double(simulation.waitedForBlank[i]), double(margin), 100'000);
	}
	EXPECT_EQ(simulation.pacer.missed(), 0u);
}

TEST(Pacer, aJitteringReportMovesTheGridLittle)
{
	Simulation simulation;
	simulation.run(300);
	std::mt19937 random(7);
	std::normal_distribution<double> late(0, 500'000);
	for (int i = 0; i < 1000; ++i) {
		const Pacer::Refresh refresh = simulation.frame(XrDuration(late(random)));
		EXPECT_NEAR(double(refresh.display), double(simulation.shown.back()), 700'000);
	}
	EXPECT_NEAR(double(simulation.pacer.period()), double(period), 20'000);
}

TEST(Pacer, aSlowMachineSkipsWholeRefreshes)
{
	Simulation simulation;
	simulation.firstDisplay = 1'000'000'000;
	simulation.cost = 40'000'000; // two and a half periods
	simulation.run(100);
	const uint64_t missedBefore = simulation.pacer.missed();
	const size_t begin = simulation.shown.size();
	simulation.run(60);
	for (size_t i = begin; i < simulation.shown.size(); ++i) EXPECT_EQ(simulation.shown[i] - simulation.shown[i - 1], 3 * period);
	EXPECT_EQ(simulation.pacer.missed() - missedBefore, 2u * 60u);
}

TEST(Pacer, aMachineThatIsNotHeldUpByItsDisplayShowsAsManyImagesAsItMakes)
{
	for (const double periods : {1.05, 1.5, 2.4, 3.3}) {
		Simulation simulation;
		simulation.held = false;
		simulation.cost = XrDuration(periods * period);
		simulation.run(100);
		const size_t begin = simulation.shown.size();
		simulation.run(600);
		const std::vector<XrTime> &shown = simulation.shown;
		EXPECT_NEAR(double(shown.back() - shown[begin]) / double(shown.size() - 1 - begin), double(simulation.cost), 0.01 * period)
			<< periods;
		for (size_t i = begin; i < shown.size(); ++i) EXPECT_GE(shown[i] - shown[i - 1], period / 2) << "no refresh is served twice";
	}
}

TEST(Pacer, aRefreshIsNotServedAgainWhenComposingWasCheaperThanExpected)
{
	for (const XrDuration expected : {4'000'000, 40'000'000}) {
		Pacer pacer(settings, 1'000'000'000);
		for (int i = 0; i < 64; ++i) pacer.composed(expected);
		const Pacer::Refresh refresh = pacer.next(2'000'000'000);
		const Pacer::Refresh after = pacer.after(refresh.display, refresh.latch + 100'000);
		EXPECT_EQ(after.display - refresh.display, period);
		EXPECT_EQ(after.display - after.vblank, vblankToDisplay);
		EXPECT_GE(after.latch, refresh.latch + 100'000);
		EXPECT_GE(after.latch, after.vblank - margin - expected) << "not a period early for ever";
	}
}

TEST(Pacer, anOutlierDoesNotChangeTheExpectedCost)
{
	Pacer pacer(settings, 0);
	for (int i = 0; i < 64; ++i) pacer.composed(4'000'000);
	pacer.composed(500'000'000);
	EXPECT_EQ(pacer.cost(), 4'000'000);
	for (int i = 0; i < 64; ++i) pacer.composed(500'000'000);
	EXPECT_EQ(pacer.cost(), 4 * period);
}

TEST(Pacer, whatHappensMoreThanOnceASecondIsExpected)
{
	Pacer pacer(settings, 0);
	for (int i = 0; i < 64; ++i) pacer.composed(i == 20 || i == 50 ? 9'000'000 : 4'000'000);
	EXPECT_EQ(pacer.cost(), 9'000'000);
	const Pacer::Refresh refresh = pacer.next(1'000'000'000);
	EXPECT_EQ(refresh.vblank - refresh.latch, 9'000'000 + margin);
}

TEST(Pacer, aThreadWokenLateTriesAsLongAsTheUsualCostFits)
{
	Pacer pacer(settings, 0);
	for (int i = 0; i < 64; ++i) pacer.composed(i % 4 == 0 ? 9'000'000 : 4'000'000);
	const Pacer::Refresh refresh = pacer.next(1'000'000'000);
	EXPECT_TRUE(pacer.reaches(refresh, refresh.latch));
	EXPECT_TRUE(pacer.reaches(refresh, refresh.vblank - 4'000'000));
	EXPECT_FALSE(pacer.reaches(refresh, refresh.vblank - 3'999'999));
}

TEST(Pacer, followsADisplayThatChangesItsPhase)
{
	Simulation simulation;
	simulation.run(200);
	simulation.firstDisplay += period / 2;
	simulation.run(300);
	const Pacer::Refresh refresh = simulation.frame();
	EXPECT_NEAR(double(refresh.display), double(simulation.shown.back()), 20'000);
}

TEST(Pacer, anApplicationWokenNowIsToldTheRefreshAfterThisOne)
{
	Simulation simulation;
	simulation.run(300);
	const Pacer::Refresh now = simulation.pacer.next(simulation.now), after = simulation.pacer.following(now);
	EXPECT_NEAR(double(after.display - now.display), double(period), 2);
	EXPECT_GE(after.latch, now.latch + simulation.pacer.cost());
	// Where composing takes longer than a period, some images in between are never made.
	simulation.cost = 40'000'000;
	simulation.held = false;
	simulation.run(100);
	for (int i = 0; i < 20; ++i) {
		const Pacer::Refresh promised = simulation.pacer.following(simulation.frame());
		EXPECT_NEAR(double(simulation.pacer.after(simulation.last->display, simulation.now).display), double(promised.display), 3);
	}
}

} // namespace
} // namespace arift
