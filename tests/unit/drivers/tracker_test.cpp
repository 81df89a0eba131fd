// The whole synthetic tracker: motion -> firmware -> 62 bytes -> host -> samples, under a stepped clock.
#include "drivers/dk1/tracker.h"
#include "drivers/synthetic/transport.h"
#include "drivers/trajectory.h"
#include "tests/unit/drivers/support.h"
#include <fstream>
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::synthetic;

namespace
{

struct Simulation {
	std::unique_ptr<Clock> clock = makeSteppedClock(100 * second);
	Clock::Hold hold{*clock};
	std::shared_ptr<World> world = std::make_shared<World>();
	std::stop_source stop;

	explicit Simulation(std::shared_ptr<const HeadMotion> motion = makeRest())
	{
		world->start = clock->now();
		world->motion = std::move(motion);
	}
	dk1::Tracker tracker(const WireSettings &wire, int rate = 500, std::unique_ptr<TruthFile> truth = nullptr)
	{
		return {*clock, std::make_unique<SyntheticTransport>(*clock, world, wire, std::move(truth)), rate};
	}
	/// Reads for `length` and hands every report to `use`.
	template <typename Use> void read(dk1::Tracker &tracker, XrDuration length, Use use)
	{
		const XrTime end = clock->now() + length;
		for (ImuReport report; tracker.read(report, end, stop.get_token()) == Outcome::ready;) use(report);
	}
};

} // namespace

TEST(SyntheticTracker, DeliversEveryTickOnceAtItsTime)
{
	Simulation setup;
	auto tracker = setup.tracker({.latency = millisecond / 2});
	int64_t expected = 0, samples = 0;
	std::optional<int64_t> offset;
	setup.read(tracker, 20 * second, [&](const ImuReport &report) {
		EXPECT_EQ(report.lostTicks, 0u);
		EXPECT_EQ(report.restarted, samples == 0);
		EXPECT_EQ(setup.clock->now(), report.arrival);
		for (uint32_t i = 0; i < report.sampleCount; i++, samples++) {
			const ImuSample &sample = report.samples[i];
			if (samples > 0) { EXPECT_EQ(sample.tick, expected); }
			expected = sample.tick + 1;
		}
		const int64_t difference = report.arrival - report.samples[report.sampleCount - 1].tick * millisecond;
		if (!offset) offset = difference;
		EXPECT_EQ(difference, *offset);
	});
	EXPECT_NEAR(double(samples), 20'000, 12) << "20 s without a gap: keep-alives were sent";
	EXPECT_EQ(tracker.info().malformed, 0u);
}

TEST(SyntheticTracker, ASlowControlTransferNeverDelaysReading)
{
	Simulation setup;
	auto tracker = setup.tracker({.controlDelay = 6 * second}); // each takes twice as long as the time between two
	XrTime last = 0;
	XrDuration longest = 0;
	setup.read(tracker, 30 * second, [&](const ImuReport &report) {
		if (last) longest = std::max(longest, setup.clock->now() - last);
		last = report.arrival;
	});
	EXPECT_EQ(longest, 2 * millisecond);
	EXPECT_NEAR(inSeconds(setup.clock->now() - last), 0, 0.003);
}

TEST(SyntheticTracker, FeelsTheMotionOfTheHead)
{
	const glm::dvec3 neck{0, -0.075, 0.0805};
	const auto motion = std::shared_ptr<const HeadMotion>(makeNatural(3, 0, neck));
	Simulation setup(motion);
	const XrPosef imuInHead{rotationAbout({0, 0, 1}, 0.3), {0.01f, 0.02f, -0.05f}};
	auto tracker = setup.tracker({.errors = {.quantisation = false}, .imuInHead = imuInHead}, 1000);
	double worstTurn = 0, worstForce = 0;
	setup.read(tracker, 10 * second, [&](const ImuReport &report) {
		const HeadState head = motion->at(inSeconds(report.arrival - setup.world->start)); // no latency: the newest sample's time
		const ImuTruth truth = imuTruth(head, imuInHead);
		const ImuSample &sample = report.samples[report.sampleCount - 1];
		worstTurn = std::max(worstTurn, glm::length(toGlm(sample.angularVelocity) - truth.angularVelocity));
		worstForce = std::max(worstForce, glm::length(toGlm(sample.acceleration) - truth.specificForce));
	});
	EXPECT_GT(worstTurn, 0);
	EXPECT_LT(worstTurn, 2e-4) << "rounding to 1e-4, with a remainder carried, on three axes";
	EXPECT_LT(worstForce, 2e-4);
}

TEST(SyntheticTracker, RestsLevelAndTellsItsName)
{
	Simulation setup;
	auto tracker = setup.tracker({});
	ImuReport report;
	ASSERT_EQ(tracker.read(report, setup.clock->now() + second, setup.stop.get_token()), Outcome::ready);
	EXPECT_NEAR(report.samples[0].acceleration.y, 9.80665, 3e-3);
	EXPECT_NEAR(report.temperature, 31.5, 1e-4);
	EXPECT_NEAR(report.magneticField->y, -43.5e-6, 0.2e-6);
	EXPECT_NEAR(report.magneticField->z, -20.3e-6, 0.2e-6);
	EXPECT_EQ(tracker.info().name, "Synthetic DK1 tracker");
}

TEST(SyntheticTracker, TimesOutAtTheDeadlineAndOnStop)
{
	Simulation setup;
	auto tracker = setup.tracker({.latency = 50 * millisecond});
	ImuReport report;
	const XrTime deadline = setup.clock->now() + 5 * millisecond;
	EXPECT_EQ(tracker.read(report, deadline, setup.stop.get_token()), Outcome::timeout);
	EXPECT_EQ(setup.clock->now(), deadline);
	setup.stop.request_stop();
	EXPECT_EQ(tracker.read(report, deadline + second, setup.stop.get_token()), Outcome::timeout);
}

TEST(SyntheticTracker, IsTheSameEveryTime)
{
	const auto sum = [] {
		Simulation setup(makeNatural(5, 0, {0, -0.075, 0.0805}));
		auto tracker = setup.tracker({.errors = {.noise = true, .seed = 11}});
		double total = 0;
		setup.read(tracker, 2 * second, [&](const ImuReport &r) { total += r.samples[0].acceleration.x * double(r.samples[0].tick); });
		return total;
	};
	EXPECT_EQ(sum(), sum());
}

TEST(TruthFile, HoldsWholeLinesOfTheTruePoses)
{
	const test::TemporaryFolder folder;
	const auto file = folder.path() / "truth.csv";
	const std::vector<Marker> markers{{{0.5, 0, -2}, 0.03}};
	Simulation setup(makeConstantRate({0, 1, 0}, 0, {0, -0.075, 0.0805}));
	{
		auto tracker = setup.tracker({}, 500, std::make_unique<TruthFile>(file, markers));
		setup.read(tracker, second, [](const ImuReport &) {});
	}
	std::ifstream stream(file);
	std::string line;
	std::getline(stream, line);
	EXPECT_EQ(line, "# marker 0 0.5 0 -2 0.03");
	std::getline(stream, line);
	EXPECT_EQ(line, "time_ns,px,py,pz,qw,qx,qy,qz");
	stream.close();
	const Trajectory poses = readTrajectoryCsv(file);
	EXPECT_NEAR(double(poses.size()), 1000, 3);
	EXPECT_NEAR(poses[500].seconds, 0.5, 1e-9);
	const double turn = angleBetween(toXr(poses[0].orientation), toXr(poses[500].orientation));
	EXPECT_NEAR(turn, 0.5, 1e-6);
}
