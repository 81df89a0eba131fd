// Head motion by time: one writer, any number of readers, in this process or another. Lies in shared memory that readers map read-only.
#pragma once
#include "runtime/motion/motion_sample.h"
#include <array>
#include <atomic>
#include <cstddef>

namespace arift
{

/// The shared memory itself: a ring of slots, each guarded by its own sequence word (odd while it is written). Nothing in it is trusted
/// by readers: indices are clamped, loops bounded, a slot that stays torn is passed over for the one before.
struct PoseRing {
	static constexpr uint32_t slotCount = 4096; ///< 4 s at 1000 samples per second
	static constexpr uint32_t slotWords = 7;    ///< MotionSample packed into 64-bit words
	/// One cache line: reading a sample after a sleep costs one miss.
	struct alignas(64) Slot {
		std::atomic<uint32_t> sequence;
		std::atomic<uint32_t> reserved;
		std::array<std::atomic<uint64_t>, slotWords> words;
	};
	std::atomic<uint64_t> written; ///< samples ever pushed; the newest lies in slot (written - 1) % slotCount
	std::array<Slot, slotCount> slots;
};
static_assert(sizeof(MotionSample) <= PoseRing::slotWords * sizeof(uint64_t) && sizeof(PoseRing::Slot) == 64);
static_assert(std::atomic<uint64_t>::is_always_lock_free);

/// Writes; the tracker thread alone.
class PoseWriter
{
public:
	explicit PoseWriter(PoseRing &ring) : ring_(ring) {}
	/// Times must rise; a sample that is not later than the newest is ignored.
	void push(const MotionSample &sample);

private:
	PoseRing &ring_;
	XrTime newest_ = 0;
};

/// What the history holds at one moment: the newest sample is read once, however many times are asked for.
class PoseMoment
{
public:
	explicit PoseMoment(const PoseRing &ring);
	/// As PoseHistory::at.
	HeadMotion at(XrTime time) const { return isEmpty_ || newest_.time > time || time <= 0 ? before(time) : afterNewest(newest_, time); }
	/// Null when nothing was ever pushed, or nothing of it can be read.
	const MotionSample *newest() const { return isEmpty_ ? nullptr : &newest_; }

private:
	/// The answer for a time that is not after the newest sample's.
	HeadMotion before(XrTime time) const;
	static HeadMotion afterNewest(const MotionSample &newest, XrTime time);

	const PoseRing *ring_;
	bool isEmpty_ = true;
	uint64_t index_ = 0; ///< of newest_
	MotionSample newest_;
};

/// Reads; any thread, any process; no lock, no system call, no allocation.
class PoseHistory
{
public:
	explicit PoseHistory(const PoseRing &ring) : ring_(&ring) {}
	PoseMoment now() const { return PoseMoment(*ring_); }
	/// Motion at `time`: between two samples interpolated (spherically), after the newest predicted by at most 100 ms (frozen beyond),
	/// `none` before the oldest one kept or when nothing was ever pushed.
	HeadMotion at(XrTime time) const { return now().at(time); }
	/// The newest sample, if there is one.
	bool newest(MotionSample &sample) const
	{
		const PoseMoment moment = now();
		if (moment.newest()) sample = *moment.newest();
		return moment.newest();
	}

private:
	const PoseRing *ring_;
};

} // namespace arift
