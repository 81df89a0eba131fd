#include "runtime/tracking/clock_mapper.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace arift;

namespace
{

/// A device and a bus: `ticksPerReport` ticks of `period` ns, at best `leastLatency` late.
struct Bus {
	double period = 999'779;
	int ticksPerReport = 1;
	double meanJitter = 3e6;
	std::mt19937 random{3};
	XrTime start = 5'000 * second;

	XrTime when(int64_t tick) const { return start + XrTime(std::llround(double(tick) * period)); }
	XrTime arrival(int64_t tick) { return when(tick) + XrTime(std::exponential_distribution<double>(1 / meanJitter)(random)); }
};

} // namespace

TEST(ClockMapper, IsWithinTwoTenthsOfAMillisecondAfterTwoSeconds)
{
	for (const double jitter : {0.1e6, 1e6, 3e6, 5e6}) {
		for (const double period : {999'779.0, 1'000'000.0, 1'050'000.0, 960'000.0}) {
			Bus bus{.period = period, .meanJitter = jitter};
			ClockMapper mapper(1e-3);
			double worst = 0;
			XrTime last = 0;
			for (int64_t tick = 40'000; tick < 100'000; ++tick) {
				mapper.add(tick, bus.arrival(tick));
				const XrTime time = mapper.timeOf(tick);
				ASSERT_GT(time, last);
				last = time;
				if (tick >= 42'000) worst = std::max(worst, std::abs(double(time - bus.when(tick))));
			}
			EXPECT_LT(worst, 0.2e6) << "jitter " << jitter << " period " << period;
			EXPECT_NEAR(mapper.tickPeriod() * 1e9 / period, 1, 5e-6);
		}
	}
}

TEST(ClockMapper, StartsWithinTheJitter)
{
	Bus bus{.meanJitter = 1e6};
	ClockMapper mapper(1e-3);
	double worst = 0;
	for (int64_t tick = 0; tick < 2000; ++tick) {
		mapper.add(tick, bus.arrival(tick));
		const double error = double(mapper.timeOf(tick) - bus.when(tick));
		if (tick > 100) worst = std::max(worst, std::abs(error));
	}
	EXPECT_LT(worst, 1e6);
}

TEST(ClockMapper, WithoutJitterItIsExact)
{
	Bus bus;
	ClockMapper mapper(1e-3);
	for (int64_t tick = 0; tick < 20'000; tick += 2) {
		mapper.add(tick, bus.when(tick));
		EXPECT_NEAR(double(mapper.timeOf(tick) - bus.when(tick)), 0, tick < 2000 ? 300e3 : 20.0) << tick;
	}
}

TEST(ClockMapper, AStalledHostDoesNotMoveIt)
{
	Bus bus{.meanJitter = 0.2e6};
	ClockMapper mapper(1e-3);
	double worst = 0;
	for (int64_t tick = 0; tick < 60'000; ++tick) {
		XrTime arrival = bus.arrival(tick);
		// Every 7 s the host sleeps 300 ms: what comes meanwhile is read at its end.
		const int64_t phase = tick % 7000;
		if (phase >= 6000 && phase < 6300) arrival = bus.when(tick - phase + 6300);
		mapper.add(tick, arrival);
		const XrTime time = mapper.timeOf(tick);
		EXPECT_LE(time, arrival);
		if (tick > 2000) worst = std::max(worst, std::abs(double(time - bus.when(tick))));
	}
	EXPECT_LT(worst, 0.2e6);
}

TEST(ClockMapper, AStaleFirstReportAndABacklogDoNotLinger)
{
	Bus bus{.meanJitter = 0.2e6};
	ClockMapper mapper(1e-3);
	mapper.add(0, bus.when(180)); // waited in the endpoint's buffer until the host polled
	XrTime last = mapper.timeOf(0);
	for (int64_t tick = 181; tick < 1000; ++tick) {
		mapper.add(tick, bus.arrival(tick));
		const XrTime time = mapper.timeOf(tick);
		EXPECT_GT(time, last);
		last = time;
		if (tick > 300) { EXPECT_LT(std::abs(double(time - bus.when(tick))), 0.8e6) << tick; }
	}
}

TEST(ClockMapper, ForgetsWhenTicksBeginAnew)
{
	Bus bus{.meanJitter = 0.2e6};
	ClockMapper mapper(1e-3);
	for (int64_t tick = 0; tick < 5000; ++tick) mapper.add(tick, bus.arrival(tick));
	const XrTime before = mapper.timeOf(4999);
	mapper.reset();
	Bus again{.meanJitter = 0.2e6, .start = bus.start + 8 * second};
	for (int64_t tick = 0; tick < 5000; ++tick) {
		mapper.add(tick, again.arrival(tick));
		const XrTime time = mapper.timeOf(tick);
		EXPECT_GT(time, before);
		if (tick > 100) { EXPECT_LT(std::abs(double(time - again.when(tick))), 0.8e6); }
	}
}

TEST(ClockMapper, NoticesByItselfThatTheHostSlept)
{
	Bus bus{.meanJitter = 0.2e6};
	ClockMapper mapper(1e-3);
	for (const XrDuration shift : {-5 * second, 2 * second}) { // the host's clock stood still; the device did
		for (int64_t tick = 0; tick < 5000; ++tick) mapper.add(tick, bus.arrival(tick)), mapper.timeOf(tick);
		for (int64_t tick = 5000; tick < 12'000; ++tick) {
			mapper.add(tick + (shift < 0 ? 20'000 : 0), bus.arrival(tick) + 20 * second + shift);
			const XrTime time = mapper.timeOf(tick + (shift < 0 ? 20'000 : 0));
			if (tick > 7000) { EXPECT_LT(std::abs(double(time - bus.when(tick) - 20 * second - shift)), 0.5e6) << tick; }
		}
		mapper = ClockMapper(1e-3);
	}
}

TEST(ClockMapper, TheSameReportsGiveTheSameTimes)
{
	Bus one, two;
	ClockMapper a(1e-3), b(1e-3);
	for (int64_t tick = 0; tick < 5000; ++tick) {
		a.add(tick, one.arrival(tick));
		b.add(tick, two.arrival(tick));
		ASSERT_EQ(a.timeOf(tick), b.timeOf(tick));
	}
}
