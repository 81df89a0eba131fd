#include "runtime/tracking/magnetic_heading.h"
#include <gtest/gtest.h>

using namespace arift;

namespace
{

constexpr double period = 0.005;

/// A field of this norm and dip that says north is at `heading` (clockwise positive, as the update's error is counted).
glm::dvec3 field(double heading, double norm = 45, double dip = 60 * degree)
{
	return norm * glm::dvec3(std::cos(dip) * std::sin(heading), std::cos(dip) * std::cos(heading), -std::sin(dip));
}

void feed(MagneticHeading &magnetic, const glm::dvec3 &f, double seconds)
{
	for (double t = 0; t < seconds; t += period) magnetic.update(f, 1, period);
}

} // namespace

TEST(MagneticHeading, StartsAtTheFirstFieldAndFollowsSlowly)
{
	MagneticHeading magnetic(period);
	magnetic.update(field(1), 1, period);
	EXPECT_NEAR(magnetic.heading(), 1, 1e-9);
	feed(magnetic, field(1), 30);
	EXPECT_FALSE(magnetic.disturbed());
	feed(magnetic, field(1.1), 9); // one time constant
	EXPECT_NEAR(magnetic.heading(), 1.1 - 0.1 / M_E, 1e-3);
}

TEST(MagneticHeading, ADisturbedFieldIsNotBelieved)
{
	MagneticHeading magnetic(period);
	feed(magnetic, field(0.5), 30);
	feed(magnetic, field(1.5, 80), 15);
	EXPECT_TRUE(magnetic.disturbed());
	EXPECT_NEAR(magnetic.heading(), 0.5, 0.02);
	feed(magnetic, field(1.5, 80), 10); // it has lasted 20 s in motion: this is the field here
	EXPECT_FALSE(magnetic.disturbed());
	EXPECT_GT(magnetic.heading(), 0.6);
}

TEST(MagneticHeading, NonsenseIsPassedOver)
{
	MagneticHeading magnetic(period);
	feed(magnetic, field(-2), 5);
	for (const glm::dvec3 &f : {glm::dvec3(0), glm::dvec3(NAN, 1, 1), glm::dvec3(INFINITY, 0, 0)}) magnetic.update(f, 1, period);
	magnetic.update(field(1), 1, 0);
	EXPECT_NEAR(magnetic.heading(), -2, 1e-9);
}
