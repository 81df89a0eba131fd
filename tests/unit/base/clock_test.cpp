#include "runtime/base/clock.h"
#include <gtest/gtest.h>
#include <thread>

using namespace arift;

TEST(RealClock, IsCLOCK_MONOTONICItself)
{
	const auto clock = makeRealClock();
	const XrTime before = realTime();
	const XrTime now = clock->now();
	EXPECT_GE(now, before);
	EXPECT_LE(now, realTime());
	EXPECT_EQ(clock->anchor().at(12345), 12345);
}

TEST(ScaledClock, SleepsInItsOwnTime)
{
	const auto clock = makeScaledClock(10);
	const XrTime real = realTime(), start = clock->now();
	EXPECT_TRUE(clock->sleepUntil(start + 200 * millisecond, {}));
	EXPECT_GE(clock->now() - start, 200 * millisecond);
	EXPECT_GE(realTime() - real, 19 * millisecond);
}

TEST(ScaledClock, StopEndsASleep)
{
	const auto clock = makeRealClock();
	std::jthread sleeper([&](std::stop_token stop) { EXPECT_FALSE(clock->sleepUntil(clock->now() + 1000 * second, stop)); });
	sleeper.request_stop();
	sleeper.join();
}

TEST(SteppedClock, GoesFromSleeperToSleeperInOrder)
{
	const auto clock = makeSteppedClock(0);
	std::vector<std::pair<XrTime, char>> woken;
	std::mutex mutex;
	Clock::Hold start(*clock);
	auto run = [&](Clock::Hold, char name, XrDuration period) {
		for (int i = 1; i <= 5; ++i) {
			ASSERT_TRUE(clock->sleepUntil(i * period, {}));
			std::lock_guard lock(mutex);
			woken.emplace_back(clock->now(), name);
		}
	};
	std::thread a(run, Clock::Hold(*clock), 'a', 10), b(run, Clock::Hold(*clock), 'b', 17);
	{
		Clock::Hold release(std::move(start));
	}
	a.join();
	b.join();
	const std::vector<std::pair<XrTime, char>> expected{{10, 'a'}, {17, 'b'}, {20, 'a'}, {30, 'a'}, {34, 'b'},
														{40, 'a'}, {50, 'a'}, {51, 'b'}, {68, 'b'}, {85, 'b'}};
	EXPECT_EQ(woken, expected);
}

TEST(SteppedClock, StandsStillWhileHeld)
{
	const auto clock = makeSteppedClock(5);
	Clock::Hold held(*clock);
	std::thread sleeper([&, hold = Clock::Hold(*clock)] { EXPECT_TRUE(clock->sleepUntil(100, {})); });
	for (int i = 0; i < 100; ++i) {
		EXPECT_EQ(clock->now(), 5);
		std::this_thread::yield();
	}
	{
		Clock::Hold release(std::move(held));
	}
	sleeper.join();
	EXPECT_EQ(clock->now(), 100);
}
