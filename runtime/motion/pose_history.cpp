#include "runtime/motion/pose_history.h"
#include "runtime/motion/prediction.h"
#include <algorithm>
#include <cstring>
#include <utility>

namespace arift
{
namespace
{

using Words = std::array<uint64_t, PoseRing::slotWords>;

/// What the sequence word of sample `index` reads when it is complete: it names the lap, so that a slot overwritten since is known as such.
uint32_t sequenceOf(uint64_t index) { return uint32_t(2 * (index / PoseRing::slotCount + 1)); }

constexpr int tries = 4;           ///< for one slot that is being written
constexpr uint64_t passedOver = 8; ///< slots that may be torn in a row
constexpr int restarts = 3;        ///< of what the writer has overtaken

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
	static_assert(std::is_trivially_copyable_v<MotionSample>);
	constexpr size_t words = sizeof(MotionSample) / sizeof(uint64_t);
	const PoseRing::Slot &slot = ring.slots[index % PoseRing::slotCount];
	for (int attempt = 0; attempt < tries; ++attempt) {
		if (slot.sequence.load(std::memory_order_acquire) != sequenceOf(index)) continue;
		for (size_t i = 0; i < words; ++i) {
			const uint64_t word = slot.words[i].load(std::memory_order_relaxed);
			std::memcpy(reinterpret_cast<std::byte *>(&sample) + i * sizeof word, &word, sizeof word);
		}
		std::atomic_thread_fence(std::memory_order_acquire);
		if (slot.sequence.load(std::memory_order_relaxed) == sequenceOf(index)) return isPlausible(sample);
	}
	return false;
}

/// A sample that can be read, and where it lies.
struct Probe {
	uint64_t index;
	MotionSample sample;
};

/// Reads the sample at `index`, or the nearest before it that can be read, among `count` of them and not too many.
bool probe(const PoseRing &ring, uint64_t index, uint64_t count, Probe &found)
{
	for (uint64_t back = 0; back < std::min(count, passedOver); ++back) {
		found.index = index - back;
		if (readSample(ring, found.index, found.sample)) return true;
	}
	return false;
}

/// Whole intervals in a duration; at most the ring's length.
uint64_t intervals(XrDuration duration, double interval)
{
	return uint64_t(std::clamp(double(duration) / std::max(interval, 1.0), 0.0, double(PoseRing::slotCount)));
}

/// Looks for the two samples around a time: low().time <= time < high().time, with none between them that can be read.
class Search
{
public:
	/// `newest` is later than `time`; `oldest` is the first index that may be asked for.
	Search(const PoseRing &ring, uint64_t oldest, const Probe &newest, XrTime time)
		: ring_(ring), oldest_(oldest), time_(time), floor_(oldest), probes_{newest}
	{
		strideBack();
		narrow();
	}
	bool hasFound() const { return hasLow_; }
	const MotionSample &low() const { return low_->sample; }
	const MotionSample &high() const { return high_->sample; }

private:
	/// Moves low_ or high_ to what can be read at `index` or before it, among `count` samples; says whether anything can.
	bool look(uint64_t index, uint64_t count)
	{
		if (!probe(ring_, index, count, *spare_)) return false;
		const bool isLow = spare_->sample.time <= time_;
		std::swap(spare_, isLow ? low_ : high_); // nothing is copied
		if (isLow) floor_ = low_->index;
		hasLow_ = hasLow_ || isLow;
		return true;
	}

	/// Looks for a sample at or before the time, back in growing strides.
	void strideBack()
	{
		const uint64_t newest = high_->index;
		const XrTime newestTime = high_->sample.time;
		double interval = millisecond;
		for (uint64_t stride = 1; !hasLow_ && high_->index > oldest_; stride *= 2) {
			stride = std::max(stride, intervals(high_->sample.time - time_, interval) + 1);
			const uint64_t index = high_->index - std::min(stride, high_->index - oldest_);
			if (!look(index, index - oldest_ + 1) && index == oldest_) return;
			// Where samples have come as evenly as so far, the next stride reaches it.
			if (high_->index < newest) interval = double(newestTime - high_->sample.time) / double(newest - high_->index);
		}
	}

	/// A few guesses by proportion, which find evenly spaced samples at once, then by halves.
	void narrow()
	{
		constexpr int guesses = 4;
		for (int step = 0; high_->index - floor_ > 1; ++step) {
			const uint64_t span = high_->index - floor_;
			const double part = hasLow_ ? double(time_ - low_->sample.time) / double(high_->sample.time - low_->sample.time) : 0.5;
			const uint64_t guess = step < guesses ? uint64_t(part * double(span)) : span / 2;
			const uint64_t middle = floor_ + std::clamp<uint64_t>(guess, 1, span - 1);
			if (!look(middle, middle - floor_)) floor_ = middle; // torn, or overwritten meanwhile
		}
	}

	const PoseRing &ring_;
	const uint64_t oldest_;
	const XrTime time_;
	uint64_t floor_; ///< between low_ and this nothing can be read
	std::array<Probe, 3> probes_;
	bool hasLow_ = false;
	Probe *high_ = &probes_[0], *low_ = &probes_[1], *spare_ = &probes_[2];
};

/// Spherical; between neighbours less than 1.6 degrees apart the chord is the arc within 1e-7 rad, at a quarter of the cost.
XrQuaternionf between(const XrQuaternionf &a, const XrQuaternionf &b, float part)
{
	const float cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
	if (std::abs(cosine) < 0.9999f) return toXr(glm::slerp(toGlm(a), toGlm(b), double(part)));
	const float ofA = 1 - part, ofB = cosine < 0 ? -part : part;
	return normalized({a.x * ofA + b.x * ofB, a.y * ofA + b.y * ofB, a.z * ofA + b.z * ofB, a.w * ofA + b.w * ofB});
}

MotionSample interpolate(const MotionSample &a, const MotionSample &b, XrTime time)
{
	const float part = float(time - a.time) / float(b.time - a.time);
	const auto mix = [part](const XrVector3f &from, const XrVector3f &to) { return from * (1 - part) + to * part; };
	return {time, between(a.headInOrigin, b.headInOrigin, part), mix(a.angularVelocity, b.angularVelocity),
			mix(a.angularAcceleration, b.angularAcceleration)};
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

PoseMoment::PoseMoment(const PoseRing &ring) : ring_(&ring)
{
	for (int attempt = 0; attempt < restarts && isEmpty_; ++attempt) {
		const uint64_t end = ring.written.load(std::memory_order_acquire);
		for (uint64_t back = 1; back <= std::min(end, passedOver) && isEmpty_; ++back) {
			index_ = end - back;
			isEmpty_ = !readSample(ring, index_, newest_);
		}
	}
}

HeadMotion PoseMoment::before(XrTime time) const
{
	const HeadMotion none{Found::none, {.time = time}};
	if (isEmpty_ || time <= 0) return none;
	// The oldest slot is the next to be overwritten and not worth asking for.
	const uint64_t oldest = index_ + 1 < PoseRing::slotCount ? 0 : index_ + 2 - PoseRing::slotCount;
	const Search found(*ring_, oldest, {index_, newest_}, time);
	if (!found.hasFound()) return none;
	if (found.low().time == time) return {Found::exact, found.low()};
	return {Found::interpolated, interpolate(found.low(), found.high(), time)};
}

HeadMotion PoseMoment::afterNewest(const MotionSample &newest, XrTime time)
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

} // namespace arift
