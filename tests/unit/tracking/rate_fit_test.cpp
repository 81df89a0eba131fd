#include "runtime/tracking/rate_fit.h"
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace arift;

TEST(RateFit, OfASteadilyGrowingRateIsExactWhateverTheIntervals)
{
	RateFit fit;
	const glm::dvec3 start(1, -2, 0.5), growth(20, -5, 7);
	double time = 0;
	RateFit::Motion motion;
	for (const double period : {1e-3, 1e-3, 4e-3, 1e-3, 1.05e-3, 2e-3, 1e-3, 1e-3}) {
		motion = fit.add(start + growth * (time + period / 2), period);
		time += period;
	}
	EXPECT_LT(glm::length(motion.rate - (start + growth * time)), 1e-9);
	EXPECT_LT(glm::length(motion.acceleration - growth), 1e-7);
}

TEST(RateFit, LooksBackTenMillisecondsOnly)
{
	RateFit fit;
	for (int i = 0; i < 50; ++i) fit.add(glm::dvec3(100), 1e-3);
	RateFit::Motion motion;
	for (int i = 0; i < 10; ++i) motion = fit.add(glm::dvec3(1), 1e-3);
	EXPECT_NEAR(motion.rate.x, 1, 1e-9);
	EXPECT_NEAR(motion.acceleration.x, 0, 1e-6);
	motion = fit.add(glm::dvec3(1.5), 5e-3); // at 200 Hz two samples
	motion = fit.add(glm::dvec3(2), 5e-3);
	EXPECT_NEAR(motion.acceleration.x, 100, 1e-6);
	EXPECT_NEAR(motion.rate.x, 2.25, 1e-9);
}

TEST(RateFit, AloneARateIsJustThat)
{
	RateFit fit;
	fit.add(glm::dvec3(5), 1e-3);
	fit.reset();
	const RateFit::Motion motion = fit.add(glm::dvec3(1), 1e-3);
	EXPECT_EQ(motion.rate.x, 1);
	EXPECT_EQ(motion.acceleration.x, 0);
}
