// One writer at full speed against readers: nobody ever sees half a sample.
#include "runtime/motion/pose_history.h"
#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

using namespace arift;

namespace
{

constexpr XrDuration spacing = millisecond;

/// Every field follows from the index, so that a sample put together from two is recognised.
MotionSample sampleOf(uint64_t index)
{
	const float turn = float(index % 1000) * 1e-3f;
	return {XrTime(index + 1) * spacing, rotationAbout({0, 1, 0}, turn), {turn, 2 * turn, 3 * turn}, {-turn, 5 * turn, 7 * turn}};
}

bool isWhole(const MotionSample &sample)
{
	if (sample.time % spacing != 0) return false;
	const MotionSample expected = sampleOf(uint64_t(sample.time / spacing) - 1);
	return std::memcmp(&sample, &expected, sizeof sample) == 0;
}

struct Tally {
	std::atomic<uint64_t> whole = 0, broken = 0;
};

/// Asks for samples `back` before the newest until told to stop.
void readAgainst(const PoseRing &ring, uint64_t back, Tally &tally, std::stop_token stop)
{
	const PoseHistory history(ring);
	XrTime latest = 0;
	while (!stop.stop_requested()) {
		MotionSample newest;
		if (!history.newest(newest)) continue;
		if (!isWhole(newest) || newest.time < latest) ++tally.broken;
		latest = newest.time;
		const uint64_t index = uint64_t(newest.time / spacing) - 1;
		const HeadMotion motion = history.at(XrTime(index - std::min(index, back) + 1) * spacing);
		if (motion.found == Found::exact) ++(isWhole(motion.at) ? tally.whole : tally.broken);
	}
}

} // namespace

TEST(PoseHistoryThreads, ReadersNeverSeeHalfASample)
{
	const auto ring = std::make_unique<PoseRing>();
	constexpr std::array<uint64_t, 3> backs{0, 40, PoseRing::slotCount - 300};
	std::array<Tally, backs.size()> tallies;
	uint64_t index = 0;
	{
		std::vector<std::jthread> readers;
		for (size_t i = 0; i < backs.size(); ++i) {
			readers.emplace_back([&, i](std::stop_token stop) { readAgainst(*ring, backs[i], tallies[i], stop); });
		}
		PoseWriter writer(*ring);
		const auto haveSeenEnough = [](const Tally &tally) { return tally.whole >= 1000; };
		for (; index < 5 * PoseRing::slotCount || (index < 50'000'000 && !std::ranges::all_of(tallies, haveSeenEnough)); ++index) {
			writer.push(sampleOf(index)); // as fast as it goes
			if (index % 64 == 0) std::this_thread::yield();
		}
	}
	for (const Tally &tally : tallies) {
		EXPECT_EQ(tally.broken, 0u);
		EXPECT_GE(tally.whole, 1000u);
	}
	EXPECT_EQ(PoseHistory(*ring).at(XrTime(index) * spacing).found, Found::exact);
}
