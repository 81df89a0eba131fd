// One application's session: its frame channel, the newest thing it wants shown, and its hold on a stepped clock.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/base/guarded.h"
#include "runtime/compositor/frame_record.h"
#include "runtime/compositor/frame_source.h"
#include "runtime/ipc/pages.h"
#include "runtime/ipc/shared_memory.h"
#include "runtime/ipc/socket.h"
#include "runtime/service/decode.h"
#include "runtime/service/layers.h"
#include "runtime/service/pace.h"
#include <functional>
#include <thread>

namespace arift
{

/// The frame channel has a thread of its own. A message that is malformed ends the session through `onMalformed` (called once, on that
/// thread).
///
/// Stepped clock: from FrameReady on the session holds the clock, until its next WaitFrame has come and with it every submission announced
/// so far (WaitFrame.header.sequence counts the application's xrEndFrame calls), or five seconds of real time have passed.
class Session final : public FrameSource
{
public:
	static constexpr XrDuration longestHold = 5 * second;

	/// What the session asks of its client, on its own thread.
	struct Images {
		FindSwapchain find;
		/// Brings in what a submission shows, before it is shown. May throw: the session is lost then.
		std::function<void(const ipc::Submission &)> fetch = [](const ipc::Submission &) {};
		std::function<void(const ipc::Vibrate &)> vibrate = [](const ipc::Vibrate &) {};
	};
	/// `order`: where its layers are among other sessions'.
	Session(uint32_t number, Clock &clock, ipc::Socket channel, Images images, std::shared_ptr<ipc::SharedPage<ipc::ClientPage>> page,
			std::function<void(const std::string &)> onMalformed, uint64_t order = 0);
	~Session() override;

	/// The application finds its session lost; everything else goes on until close(). Thread-safe.
	void hangUp() { channel_.hangUp(); }
	/// Hangs up and ends the thread: from here on only the compositor's calls are allowed, and nothing is shown.
	void close();

	uint32_t number() const override { return number_; }
	uint64_t order() const override { return order_; }
	/// xrBeginSession and xrEndSession. An application that waits for a frame when its session ends is told not to draw.
	void setRunning(bool running);
	bool running();
	/// How its submissions are shown from now on, the one that came last included. One change at a time.
	template <typename Change> void present(Change change)
	{
		const auto shown = shown_.lock();
		change(shown->presentation);
		show(shown->content());
	}
	struct Count {
		uint64_t submitted = 0, shown = 0;
	};
	Count count();
	/// From the arrival of a finished submission until it was first seen, of the newest ones.
	Figure latency();

	void wake(const Opportunity &opportunity) override;
	std::shared_ptr<const FrameContent> content() override;
	void shown(const std::shared_ptr<const FrameContent> &content) override;
	void displayed(const FrameContent &content, XrTime display) override;

private:
	/// A ring of the newest ones.
	struct Latencies {
		std::array<XrDuration, 256> values{};
		uint64_t count = 0, newest = 0; ///< newest: the submission that was seen last
	};
	/// What `State::newest` is made of. The compositor, which must not wait, never asks for it.
	struct Shown {
		std::shared_ptr<const ipc::Submission> submission; ///< the newest one to be shown, as it came
		XrTime submissionCame = 0;
		Presentation presentation;

		std::shared_ptr<const FrameContent> content() const;
	};
	struct State {
		bool running = false;
		bool waiting = false;      ///< a WaitFrame is unanswered
		uint32_t announced = 0;    ///< submissions the application had made when it last waited
		uint64_t received = 0;     ///< number of the newest submission that came
		uint64_t relinquished = 0; ///< submissions up to this one are not to be shown any more
		uint64_t shown = 0, newestShown = 0;
		std::shared_ptr<const FrameContent> newest; ///< what is to be shown
		Opportunity current;                        ///< the newest one the compositor announced
		XrTime offeredAt = 0;                       ///< when it was
		Pace pace;
		XrTime answered = 0; ///< display time of the newest FrameReady
		std::optional<Clock::Hold> hold;
		XrTime holdSince = 0; ///< real
		Latencies latencies;
	};
	/// What is left to do when the lock is gone: an answer to send, a hold to let go of.
	struct Afterwards {
		std::optional<ipc::FrameReady> ready;
		std::optional<Clock::Hold> released;
	};

	void serve(const std::stop_token &stop);
	void take(const ipc::WaitFrame &message);
	void take(const ipc::Submission &message);
	void take(const ipc::Relinquish &message);
	void take(const ipc::Vibrate &message) { images_.vibrate(message); }
	void dropOldHold();
	void finish(Afterwards &afterwards);
	static void releaseIfComplete(State &state, Afterwards &afterwards);
	static ipc::FrameReady answer(State &state);
	void show(std::shared_ptr<const FrameContent> content);
	static XrTime latchOf(const State &state);

	const uint32_t number_;
	const uint64_t order_;
	Clock &clock_;
	ipc::Socket channel_;
	const Images images_;
	const std::shared_ptr<ipc::SharedPage<ipc::ClientPage>> page_;
	const std::function<void(const std::string &)> onMalformed_;
	Guarded<Shown> shown_; ///< locked before state_ where both are
	Guarded<State> state_;
	std::jthread thread_;
};

} // namespace arift
