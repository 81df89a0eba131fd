#include "runtime/motion/pose_history.h"
#include "runtime/motion/prediction.h"
#include <cstring>
#include <gtest/gtest.h>
#include <random>

using namespace arift;

namespace
{

constexpr double rate = 2.0; // rad/s about y
constexpr XrTime start = 1'000 * second;

MotionSample turningHead(XrTime time)
{
	return {time, rotationAbout({0, 1, 0}, rate * inSeconds(time - start)), {0, float(rate), 0}, {0, 0, 0}};
}

class PoseHistoryTest : public testing::Test
{
protected:
	/// `count` samples `spacing` apart, from `start`.
	void push(int count, XrDuration spacing)
	{
		for (int i = 0; i < count; ++i) writer.push(turningHead(start + i * spacing));
	}
	void expectOnTrack(XrTime time, Found found, double tolerance = 2e-6)
	{
		const HeadMotion motion = history.at(time);
		EXPECT_EQ(motion.found, found) << "at " << time - start;
		EXPECT_EQ(motion.at.time, time);
		EXPECT_LT(angleBetween(motion.at.headInOrigin, turningHead(time).headInOrigin), tolerance) << "at " << time - start;
	}
	/// What a writer that was killed in the middle leaves behind.
	void tear(uint64_t index) { ring->slots[index % PoseRing::slotCount].sequence.fetch_sub(1); }

	std::unique_ptr<PoseRing> ring = std::make_unique<PoseRing>();
	PoseWriter writer{*ring};
	PoseHistory history{*ring};
};

} // namespace

TEST_F(PoseHistoryTest, EmptyRingKnowsNothing)
{
	MotionSample sample;
	EXPECT_FALSE(history.newest(sample));
	EXPECT_EQ(history.at(start).found, Found::none);
	EXPECT_EQ(history.at(0).found, Found::none);
}

TEST_F(PoseHistoryTest, AnswersExactlyAtSamplesAndInterpolatesBetween)
{
	push(1000, 1'050'000); // a DK1's tick is near, not at, a millisecond
	for (int i = 0; i < 1000; ++i) {
		expectOnTrack(start + i * 1'050'000, Found::exact);
		if (i < 999) expectOnTrack(start + i * 1'050'000 + 1 + (i * 997) % 1'049'998, Found::interpolated);
	}
}

TEST_F(PoseHistoryTest, PredictsUpTo100MillisecondsThenFreezes)
{
	push(10, millisecond);
	const XrTime newest = start + 9 * millisecond;
	expectOnTrack(newest + 1, Found::predicted);
	expectOnTrack(newest + 40 * millisecond, Found::predicted);
	expectOnTrack(newest + longestPrediction, Found::predicted);
	const HeadMotion frozen = history.at(newest + 10 * second);
	EXPECT_EQ(frozen.found, Found::frozen);
	EXPECT_LT(angleBetween(frozen.at.headInOrigin, turningHead(newest + longestPrediction).headInOrigin), 2e-6);
	EXPECT_EQ(length(frozen.at.angularVelocity), 0);
	EXPECT_EQ(history.at(std::numeric_limits<XrTime>::max()).found, Found::frozen);
}

TEST_F(PoseHistoryTest, KnowsNothingBeforeTheOldestKept)
{
	const int count = 3 * PoseRing::slotCount + 17; // wrapped around three times
	push(count, millisecond);
	const XrTime newest = start + (count - 1) * millisecond;
	const XrTime oldest = newest - XrDuration(PoseRing::slotCount - 2) * millisecond;
	expectOnTrack(oldest, Found::exact);
	for (XrTime t = oldest; t < newest; t += 777'777) expectOnTrack(t, t == oldest ? Found::exact : Found::interpolated);
	EXPECT_EQ(history.at(oldest - 2 * millisecond).found, Found::none);
	EXPECT_EQ(history.at(start).found, Found::none);
	EXPECT_EQ(history.at(1).found, Found::none);
}

TEST_F(PoseHistoryTest, ToleratesJitterAndGaps)
{
	std::mt19937 random(5);
	std::exponential_distribution<double> jitter(1 / 1e6);
	std::vector<XrTime> times{start};
	for (int i = 0; i < 10'000; ++i) {
		times.push_back(times.back() + 1 + XrDuration(jitter(random)) + (i % 500 == 0 ? 300 * millisecond : 0));
		writer.push(turningHead(times.back()));
	}
	for (size_t i = times.size() - PoseRing::slotCount + 1; i + 1 < times.size(); ++i) {
		expectOnTrack(times[i], Found::exact);
		const XrTime middle = times[i] + (times[i + 1] - times[i]) / 2;
		if (middle > times[i]) expectOnTrack(middle, Found::interpolated);
	}
}

TEST_F(PoseHistoryTest, IgnoresSamplesThatAreNotLater)
{
	push(10, millisecond);
	writer.push(turningHead(start + 3 * millisecond));
	writer.push(turningHead(start + 9 * millisecond));
	EXPECT_EQ(ring->written.load(), 10u);
}

TEST_F(PoseHistoryTest, TornSlotsArePassedOverForTheOneBefore)
{
	push(100, millisecond);
	tear(99), tear(98), tear(50), tear(49), tear(48);
	MotionSample newest;
	ASSERT_TRUE(history.newest(newest));
	EXPECT_EQ(newest.time, start + 97 * millisecond);
	expectOnTrack(start + 99 * millisecond, Found::predicted);
	expectOnTrack(start + 49 * millisecond, Found::interpolated);
	expectOnTrack(start + 48 * millisecond + 500'000, Found::interpolated);
	expectOnTrack(start + 47 * millisecond, Found::exact);
	for (int i = 0; i < 970; ++i) expectOnTrack(start + i * 100'000 + 1, Found::interpolated);
}

TEST_F(PoseHistoryTest, AWriterThatTakesOverFromAKilledOneMendsTheSlot)
{
	push(10, millisecond);
	PoseRing::Slot &next = ring->slots[10];
	next.sequence.store(1); // began sample 10 and died
	expectOnTrack(start + 9 * millisecond + 5, Found::predicted);
	PoseWriter heir(*ring);
	heir.push(turningHead(start + 10 * millisecond));
	expectOnTrack(start + 10 * millisecond, Found::exact);
}

TEST_F(PoseHistoryTest, HostileContentsNeverLeadOutsideNorToNonsense)
{
	std::mt19937_64 random(99);
	for (int round = 0; round < 300; ++round) {
		push(5000, millisecond);
		ring->written.store(round % 3 == 0 ? random() : 4096 + random() % 9000);
		for (PoseRing::Slot &slot : ring->slots) {
			if (random() % 4 == 0) slot.sequence.store(round % 2 ? uint32_t(random()) : uint32_t(random() % 8));
			if (random() % 4 == 0) slot.words[random() % PoseRing::slotWords].store(random());
		}
		for (const XrTime time : {XrTime(random()), XrTime(random() >> 1), start, start + 4000 * millisecond, XrTime(1),
								  std::numeric_limits<XrTime>::max(), std::numeric_limits<XrTime>::min()}) {
			const HeadMotion motion = history.at(time);
			EXPECT_TRUE(isValidPose({motion.at.headInOrigin, {0, 0, 0}}));
			EXPECT_TRUE(isFinite(motion.at.angularVelocity) && isFinite(motion.at.angularAcceleration));
			EXPECT_EQ(motion.at.time, time);
		}
	}
}

TEST_F(PoseHistoryTest, ASampleWithImpossibleNumbersIsPassedOver)
{
	push(10, millisecond);
	MotionSample broken = turningHead(start + 10 * millisecond);
	broken.headInOrigin.x = NAN;
	writer.push(broken);
	expectOnTrack(start + 10 * millisecond, Found::predicted);
	broken = turningHead(start + 11 * millisecond);
	broken.angularVelocity.y = INFINITY;
	writer.push(broken);
	expectOnTrack(start + 11 * millisecond, Found::predicted);
}
