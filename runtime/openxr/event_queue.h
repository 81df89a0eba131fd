// Events on their way to xrPollEvent, in order. OpenXR 1.1, "Event Polling".
#pragma once
#include "runtime/openxr/api.h"
#include <atomic>
#include <cstring>
#include <deque>
#include <mutex>
#include <utility>

namespace arift::openxr
{

/// Thread-safe. An empty queue is seen to be empty without a lock.
class EventQueue
{
public:
	static constexpr size_t limit = 256;

	/// A structure with `type` and `next`; when the queue is full the event is counted as lost instead.
	template <typename Event> void push(const Event &event)
	{
		static_assert(sizeof(Event) <= sizeof(XrEventDataBuffer));
		std::lock_guard lock(mutex_);
		if (events_.size() >= limit) {
			++lost_;
			return;
		}
		XrEventDataBuffer &buffer = events_.emplace_back();
		std::memcpy(static_cast<void *>(&buffer), &event, sizeof(event));
		size_.store(events_.size(), std::memory_order_release);
	}

	/// The oldest event, if there is one. How many were lost is told first.
	bool pop(XrEventDataBuffer &event)
	{
		if (size_.load(std::memory_order_acquire) == 0) return false;
		std::lock_guard lock(mutex_);
		if (lost_ > 0) {
			const XrEventDataEventsLost lost{XR_TYPE_EVENT_DATA_EVENTS_LOST, nullptr, std::exchange(lost_, 0)};
			std::memcpy(static_cast<void *>(&event), &lost, sizeof(lost));
			return true;
		}
		if (events_.empty()) return false;
		event = events_.front();
		events_.pop_front();
		size_.store(events_.size(), std::memory_order_release);
		return true;
	}

	/// Forgets the events of a session that is destroyed.
	void dropEventsOf(XrSession session);

private:
	std::atomic<size_t> size_{0};
	std::mutex mutex_;
	std::deque<XrEventDataBuffer> events_;
	uint32_t lost_ = 0;
};

inline void EventQueue::dropEventsOf(XrSession session)
{
	std::lock_guard lock(mutex_);
	std::erase_if(events_, [session](const XrEventDataBuffer &event) {
		// Every event of the core and of this runtime's extensions that names a session does so right after `next`.
		const bool ofSession = event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED ||
							   event.type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING ||
							   event.type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
		return ofSession && reinterpret_cast<const XrEventDataInteractionProfileChanged &>(event).session == session;
	});
	size_.store(events_.size(), std::memory_order_release);
}

} // namespace arift::openxr
