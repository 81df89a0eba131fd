#include "runtime/service/pace.h"
#include <gtest/gtest.h>

namespace arift
{
namespace
{

constexpr XrDuration refresh = 16'690'000;

/// Offers an image after each of these numbers of refreshes, again and again, `times` in all.
XrDuration periodAfter(std::initializer_list<int> pattern, int times)
{
	Pace pace;
	XrTime display = 1'000'000'000;
	pace.offer(display, refresh);
	for (int i = 0; i < times; ++i) pace.offer(display += *(pattern.begin() + i % int(pattern.size())) * refresh, refresh);
	return pace.period();
}

TEST(Pace, IsThePanelsWhileHardlyARefreshIsMissed)
{
	EXPECT_EQ(Pace().period(), 0);
	EXPECT_EQ(periodAfter({1}, 0), refresh);
	EXPECT_EQ(periodAfter({1}, 100), refresh);
	EXPECT_EQ(periodAfter({1, 1, 1, 1, 1, 1, 2}, 100), refresh);
}

TEST(Pace, IsTheCompositorsWhereThatIsSlower)
{
	EXPECT_EQ(periodAfter({3}, 100), 3 * refresh);
	// Two and three in turn: 16 twos and 15 threes are left when the longest is taken away.
	EXPECT_EQ(periodAfter({2, 3}, 100), (16 * 2 + 15 * 3) * refresh / 31);
}

TEST(Pace, ForgetsAMomentOfStandstill) { EXPECT_EQ(periodAfter({1, 1, 1, 1, 1, 1, 1, 1, 1, 200}, 10), refresh); }

TEST(Pace, FollowsWithinItsMemory)
{
	Pace pace;
	XrTime display = 1'000'000'000;
	for (int i = 0; i < 50; ++i) pace.offer(display += 4 * refresh, refresh);
	ASSERT_EQ(pace.period(), 4 * refresh);
	for (int i = 0; i < 32; ++i) pace.offer(display += refresh, refresh);
	EXPECT_EQ(pace.period(), refresh);
	pace.offer(display, refresh);
	EXPECT_EQ(pace.period(), refresh) << "the same image once more is no interval";
}

} // namespace
} // namespace arift
