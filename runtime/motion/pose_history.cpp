#include "runtime/motion/pose_history.h"
#include "runtime/motion/prediction.h"
#include <algorithm>
#include <cstring>
#include <optional>

namespace arift
{
namespace
{

using Words = std::array<uint64_t, PoseRing::slotWords>;

/// What the sequence word of sample `index` reads when it is complete: it names the lap, so that a slot overwritten since is known as such.
uint32_t sequenceOf(uint64_t index) { return uint32_t(2 * (index / PoseRing::slotCount + 1)); }

constexpr int tries = 4;           ///< for one slot that is being written
constexpr uint64_t passedOver = 8; ///< slots that may be torn in a row
constexpr int restarts = 3;        ///< of a whole search that the writer has overtaken

template <typename Read> bool readSlot(const PoseRing &ring, uint64_t index, Read read)
{
	const PoseRing::Slot &slot = ring.slots[index % PoseRing::slotCount];
	for (int attempt = 0; attempt < tries; ++attempt) {
		const uint32_t before = slot.sequence.load(std::memory_order_acquire);
		read(slot);
		std::atomic_thread_fence(std::memory_order_acquire);
		if (before == sequenceOf(index) && before == slot.sequence.load(std::memory_order_relaxed)) return true;
	}
	return false;
}

/// Whether the numbers can be a head's; who wrote them may be broken or hostile.
bool isPlausible(const MotionSample &sample)
{
	constexpr float fastest = 200, mostViolent = 1e5f; // rad/s, rad/s^2: far beyond what any gyroscope reports
	const auto within = [](const XrVector3f &v, float limit) {
		return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
	};
	const XrQuaternionf &q = sample.headInOrigin;
	return sample.time > 0 && std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) <= 0.02f &&
		   within(sample.angularVelocity, fastest) && within(sample.angularAcceleration, mostViolent);
}

bool readSample(const PoseRing &ring, uint64_t index, MotionSample &sample)
{
	std::array<uint64_t, sizeof(MotionSample) / sizeof(uint64_t)> words;
	const bool whole = readSlot(ring, index, [&](const PoseRing::Slot &slot) {
		for (size_t i = 0; i < words.size(); ++i) words[i] = slot.words[i].load(std::memory_order_relaxed);
	});
	if (!whole) return false;
	std::memcpy(static_cast<void *>(&sample), words.data(), sizeof sample);
	return isPlausible(sample);
}

static_assert(offsetof(MotionSample, time) == 0, "readTime reads the first word alone");
bool readTime(const PoseRing &ring, uint64_t index, XrTime &time)
{
	return readSlot(ring, index, [&](const PoseRing::Slot &slot) { time = XrTime(slot.words[0].load(std::memory_order_relaxed)); });
}

/// The newest readable sample among those before `end`, a torn one being passed over for the one before.
bool readNewest(const PoseRing &ring, uint64_t end, MotionSample &sample)
{
	for (uint64_t back = 1; back <= std::min(end, passedOver); ++back) {
		if (readSample(ring, end - back, sample)) return true;
	}
	return false;
}

/// Two neighbouring samples: time[lower] <= time < time[upper].
struct Bracket {
	uint64_t lower, upper;
};

/// What is known at `index`: an index at or before it (after `lowest`) that can be read, and its time.
struct Probe {
	uint64_t index;
	XrTime time;
};
std::optional<Probe> probe(const PoseRing &ring, uint64_t index, uint64_t lowest)
{
	for (uint64_t back = 0; back < passedOver && index - lowest > back; ++back) {
		XrTime time = 0;
		if (readTime(ring, index - back, time)) return Probe{index - back, time};
	}
	return std::nullopt;
}

/// Searches between `oldest`, the first index that may be asked for, and `high`, which is later than `time`: a few guesses by proportion,
/// which find evenly spaced samples at once, then by halves.
std::optional<Bracket> findBracket(const PoseRing &ring, uint64_t oldest, Probe high, XrTime time)
{
	constexpr int guesses = 4;
	std::optional<Probe> low; // known to be at or before `time`
	if (XrTime first = 0; readTime(ring, oldest, first)) {
		if (first > time) return std::nullopt;
		low = {oldest, first};
	}
	uint64_t floor = oldest; // nothing between `low` and this can be read
	for (int step = 0; high.index - floor > 1; ++step) {
		const uint64_t span = high.index - floor;
		const double since = low ? double(time) - double(low->time) : 0, all = low ? double(high.time) - double(low->time) : 0;
		const uint64_t guess = step < guesses && all > 0 ? uint64_t(since / all * double(span)) : span / 2;
		const uint64_t middle = floor + std::clamp<uint64_t>(guess, 1, span - 1);
		const std::optional<Probe> at = probe(ring, middle, floor);
		if (!at)
			floor = middle; // torn, or overwritten meanwhile
		else if (at->time > time)
			high = *at;
		else
			low = at, floor = at->index;
	}
	if (!low) return std::nullopt;
	return Bracket{low->index, high.index};
}

/// Spherical; between neighbours less than 1.6 degrees apart the chord is the arc within 1e-7 rad, at a quarter of the cost.
glm::dquat between(const glm::dquat &a, const glm::dquat &b, double part)
{
	const double cosine = glm::dot(a, b);
	if (std::abs(cosine) < 0.9999) return glm::slerp(a, b, part);
	return a * (1 - part) + b * (cosine < 0 ? -part : part);
}

MotionSample interpolate(const MotionSample &a, const MotionSample &b, XrTime time)
{
	const double part = double(time - a.time) / double(b.time - a.time);
	const auto mix = [part](const XrVector3f &from, const XrVector3f &to) { return from * float(1 - part) + to * float(part); };
	const glm::dquat orientation = between(toGlm(a.headInOrigin), toGlm(b.headInOrigin), part);
	return {time, toXr(glm::normalize(orientation)), mix(a.angularVelocity, b.angularVelocity),
			mix(a.angularAcceleration, b.angularAcceleration)};
}

HeadMotion afterNewest(const MotionSample &newest, XrTime time)
{
	if (time == newest.time) return {Found::exact, newest};
	HeadMotion motion{Found::predicted, predict(newest, std::min(time - newest.time, longestPrediction))};
	if (time - newest.time > longestPrediction) {
		motion.found = Found::frozen;
		motion.at.angularVelocity = motion.at.angularAcceleration = {0, 0, 0};
	}
	motion.at.time = time;
	return motion;
}

} // namespace

void PoseWriter::push(const MotionSample &sample)
{
	if (sample.time <= newest_) return;
	newest_ = sample.time;
	Words words{};
	std::memcpy(words.data(), &sample, sizeof sample);
	const uint64_t index = ring_.written.load(std::memory_order_relaxed);
	PoseRing::Slot &slot = ring_.slots[index % PoseRing::slotCount];
	slot.sequence.store(sequenceOf(index) - 1, std::memory_order_relaxed);
	std::atomic_thread_fence(std::memory_order_release);
	for (size_t i = 0; i < words.size(); ++i) slot.words[i].store(words[i], std::memory_order_relaxed);
	slot.sequence.store(sequenceOf(index), std::memory_order_release);
	ring_.written.store(index + 1, std::memory_order_release);
}

bool PoseHistory::newest(MotionSample &sample) const
{
	for (int attempt = 0; attempt < restarts; ++attempt) {
		if (readNewest(*ring_, ring_->written.load(std::memory_order_acquire), sample)) return true;
	}
	return false;
}

HeadMotion PoseHistory::at(XrTime time) const
{
	if (time <= 0) return {Found::none, {.time = time}};
	for (int attempt = 0; attempt < restarts; ++attempt) {
		const uint64_t end = ring_->written.load(std::memory_order_acquire);
		const std::optional<Probe> newest = end > 0 ? probe(*ring_, end - 1, end - 1 - std::min(end - 1, passedOver)) : std::nullopt;
		MotionSample before, after;
		if (!newest || newest->time <= time) {
			if (readNewest(*ring_, end, before) && before.time <= time) return afterNewest(before, time);
			continue;
		}
		// The oldest slot is the next to be overwritten and not worth asking for.
		const uint64_t oldest = end < PoseRing::slotCount ? 0 : end - PoseRing::slotCount + 1;
		const std::optional<Bracket> bracket = findBracket(*ring_, oldest, *newest, time);
		if (!bracket) break;
		if (!readSample(*ring_, bracket->lower, before) || !readSample(*ring_, bracket->upper, after)) continue;
		if (before.time == time) return {Found::exact, before};
		if (before.time < time && time < after.time) return {Found::interpolated, interpolate(before, after, time)};
	}
	return {Found::none, {.time = time}};
}

} // namespace arift
