// The life of a session: its state, the order of its frames, and the events that tell of it. Shared by the session, the thread that sends
// its frames and whoever polls for events: each may be the last that needs it. OpenXR 1.1, "Session Lifecycle".
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/pages.h"
#include "runtime/openxr/event_queue.h"
#include "runtime/openxr/frame_order.h"
#include "runtime/openxr/session_state.h"

namespace arift::openxr
{

class Instance;

/// What is known of a session; changes as a whole.
struct Life {
	XrSessionState state = XR_SESSION_STATE_UNKNOWN;
	SessionFacts facts;
	FrameOrder order;
	EventQueue events;
	uint64_t newsTaken = 0; ///< of ClientPage::events
	/// Throws XR_ERROR_SESSION_NOT_RUNNING.
	void requireRunning() const;
};

/// Thread-safe, and holds no other lock while it holds its own.
class SessionLife
{
public:
	/// `id`: the service's. `newsBefore`: how many events the service had written when it was asked for this session.
	SessionLife(const Instance &instance, uint32_t id, bool isHeadless, uint64_t newsBefore);

	/// Posts the first states: only when the session has its handle.
	void announce(XrSession handle);
	/// Changes what is known and posts the states that follow from it.
	template <typename Change> void change(Change change)
	{
		life_.update([&](Life &life) {
			change(life);
			settleLocked(life);
		});
	}
	template <typename Event> void tell(const Event &event) { life_.lock()->events.push(event); }
	/// For looking, and for waiting until it is as wanted.
	Guarded<Life>::Access lock() { return life_.lock(); }

	/// Takes what the service has told since. It may come at any time, and nobody waits for it.
	void takeNews();
	/// Takes news, and the oldest event if there is one.
	bool takeEvent(XrEventDataBuffer &event);
	/// The service, the headset or the application's device is gone.
	void lose();

	XrSessionState state() const { return state_.load(std::memory_order_relaxed); }
	bool isLost() const { return lost_.load(std::memory_order_relaxed); }

private:
	void takeNewsLocked(Life &life);
	void take(Life &life, const ipc::Event &news);
	void tellRecentered(Life &life, const ipc::Event &news) const;
	void settleLocked(Life &life);

	const Instance &instance_;
	const uint32_t id_;
	const bool isHeadless_;
	std::atomic<XrSession> handle_{XR_NULL_HANDLE};
	Guarded<Life> life_;
	std::atomic<XrSessionState> state_{XR_SESSION_STATE_UNKNOWN};
	std::atomic<bool> lost_{false};
};

} // namespace arift::openxr
