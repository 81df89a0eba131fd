// The library's own thread in the application's process: submissions leave in order, each when its work is finished, and nothing hangs.
#include "runtime/base/clock.h"
#include "runtime/openxr/submitter.h"
#include <atomic>
#include <gtest/gtest.h>
#include <map>
#include <thread>

namespace arift::openxr
{
namespace
{

constexpr XrDuration plenty = 20 * second; // real time, on a machine that is busy

/// Work on a GPU that ends when the test says so.
class Fence : public Completion
{
public:
	Outcome wait(XrDuration limit) const override
	{
		state_.update([](State &state) { state.waits++; });
		auto state = state_.lock();
		state.waitFor({}, std::chrono::nanoseconds(limit), [](const State &now) { return now.outcome != Outcome::notYet; });
		return state->outcome;
	}
	void end(Outcome outcome = Outcome::done) const
	{
		state_.update([outcome](State &state) { state.outcome = outcome; });
	}
	/// Until somebody has waited for it in vain at least once: the submitter is at this frame, and knows that it is not finished.
	bool awaitVainWait() const
	{
		return state_.lock().waitFor({}, std::chrono::nanoseconds(plenty), [](const State &state) { return state.waits >= 2; });
	}

private:
	struct State {
		Outcome outcome = Outcome::notYet;
		int waits = 0;
	};
	mutable Guarded<State> state_;
};

ipc::Submission frame(uint64_t number)
{
	ipc::Submission submission;
	submission.frame = number;
	return submission;
}

struct Wire {
	std::pair<ipc::Socket, ipc::Socket> ends = ipc::Socket::pair();
	ipc::Socket &library = ends.first, &service = ends.second;

	/// The number of the next frame that comes within `limit`; 0 where none does.
	uint64_t next(XrDuration limit = plenty)
	{
		ipc::Received received;
		if (service.receive(received, realTime() + limit) != ipc::Transfer::done) return 0;
		const auto header = received.header();
		if (!header || header->type != ipc::Submission::type) return 0;
		uint64_t number = 0;
		std::memcpy(&number, received.bytes.data() + offsetof(ipc::Submission, frame), sizeof(number));
		return number;
	}
};

TEST(Submitter, ASubmissionLeavesWhenItsWorkIsFinishedAndNoneOvertakes)
{
	Wire wire;
	Submitter submitter(wire.library);
	const auto slow = std::make_shared<Fence>(), done = std::make_shared<Fence>();
	done->end();
	submitter.submit(frame(1), {done, slow});
	submitter.submit(frame(2), {done});
	submitter.submit(frame(3), {});
	ASSERT_TRUE(slow->awaitVainWait());
	EXPECT_EQ(wire.next(0), 0u) << "frame 1 is not finished, and the others wait for it";
	slow->end();
	EXPECT_EQ(wire.next(), 1u);
	EXPECT_EQ(wire.next(), 2u);
	EXPECT_EQ(wire.next(), 3u);
}

TEST(Submitter, DrainWaitsUntilAllIsSent)
{
	Wire wire;
	Submitter submitter(wire.library);
	const auto work = std::make_shared<Fence>();
	submitter.submit(frame(1), {work});
	submitter.submit(frame(2), {work});
	std::jthread gpu([work] {
		if (work->awaitVainWait()) work->end();
	});
	submitter.drain(plenty);
	EXPECT_EQ(wire.next(0), 1u) << "is there already";
	EXPECT_EQ(wire.next(0), 2u);
	submitter.drain(0); // nothing is left
}

TEST(Submitter, DrainDropsWhatDoesNotFinish)
{
	Wire wire;
	Submitter submitter(wire.library);
	const auto work = std::make_shared<Fence>();
	submitter.submit(frame(1), {work});
	submitter.submit(frame(2), {work});
	ASSERT_TRUE(work->awaitVainWait());
	const XrTime before = realTime();
	submitter.drain(10 * millisecond);
	EXPECT_GE(realTime() - before, 10 * millisecond);
	work->end();
	submitter.submit(frame(3), {});
	EXPECT_EQ(wire.next(), 1u) << "was in hand";
	EXPECT_EQ(wire.next(), 3u) << "2 was dropped";
}

TEST(Submitter, EndsWhileWorkIsUnfinishedAndSendsNothing)
{
	Wire wire;
	const auto never = std::make_shared<Fence>();
	XrTime ending = 0;
	{
		Submitter submitter(wire.library);
		submitter.submit(frame(1), {never});
		submitter.submit(frame(2), {});
		ASSERT_TRUE(never->awaitVainWait());
		ending = realTime();
	}
	EXPECT_LT(realTime() - ending, 2 * second) << "does not wait for the five seconds that work may take";
	EXPECT_EQ(wire.next(0), 0u);
	EXPECT_EQ(never.use_count(), 1) << "lets go of the application's objects";
}

TEST(Submitter, AServiceThatHasGoneIsToldOnceAndHoldsNobodyUp)
{
	Wire wire;
	std::atomic<int> told = 0;
	Submitter submitter(wire.library, [&told] { told++; });
	wire.service.hangUp();
	for (uint64_t i = 1; i <= 50; ++i) submitter.submit(frame(i), {});
	const XrTime before = realTime();
	submitter.drain(plenty);
	EXPECT_LT(realTime() - before, plenty / 2);
	for (const XrTime end = realTime() + plenty; told == 0 && realTime() < end;) std::this_thread::yield();
	EXPECT_EQ(told, 1);
}

TEST(Submitter, NothingIsSentAfterTheDeviceIsLost)
{
	Wire wire;
	std::atomic<int> told = 0;
	{
		Submitter submitter(wire.library, [&told] { told++; });
		const auto lost = std::make_shared<Fence>();
		submitter.submit(frame(1), {});
		submitter.submit(frame(2), {lost});
		submitter.submit(frame(3), {});
		ASSERT_TRUE(lost->awaitVainWait());
		lost->end(Completion::Outcome::failed);
		submitter.drain(plenty);
		submitter.submit(frame(4), {});
		submitter.drain(plenty);
	}
	EXPECT_EQ(told, 1);
	EXPECT_EQ(wire.next(0), 1u);
	EXPECT_EQ(wire.next(0), 0u);
}

TEST(Submitter, ManyThreadsMaySubmit)
{
	constexpr uint64_t threads = 4, each = 50;
	Wire wire;
	Submitter submitter(wire.library);
	std::vector<std::jthread> application;
	for (uint64_t thread = 0; thread < threads; ++thread)
		application.emplace_back([&submitter, thread] {
			for (uint64_t i = 0; i < each; ++i) {
				const auto work = std::make_shared<Fence>();
				submitter.submit(frame(1000 * (thread + 1) + i), {work});
				work->end();
			}
		});
	std::map<uint64_t, uint64_t> next;
	for (uint64_t i = 0; i < threads * each; ++i) {
		const uint64_t number = wire.next(), thread = number / 1000;
		ASSERT_GE(thread, 1u) << i << " of " << threads * each << " came";
		EXPECT_EQ(number % 1000, next[thread]++) << "each thread's in its order";
	}
}

} // namespace
} // namespace arift::openxr
