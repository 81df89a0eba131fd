// Events on their way to xrPollEvent, in order. OpenXR 1.1, "Event Polling".
#pragma once
#include "runtime/openxr/api.h"
#include <cstring>
#include <deque>
#include <utility>

namespace arift::openxr
{

/// Knows no lock: it lies in a Guarded value.
class EventQueue
{
public:
	static constexpr size_t limit = 256;

	/// A structure with `type` and `next`; when the queue is full the event is counted as lost instead.
	template <typename Event> void push(const Event &event)
	{
		static_assert(sizeof(Event) <= sizeof(XrEventDataBuffer));
		if (events_.size() >= limit) return lose(1);
		std::memcpy(static_cast<void *>(&events_.emplace_back()), &event, sizeof(event));
	}
	/// Events that never came this far.
	void lose(uint32_t count) { lost_ += count; }

	/// The oldest event, if there is one. How many were lost is told first.
	bool pop(XrEventDataBuffer &event)
	{
		if (lost_ > 0) {
			const XrEventDataEventsLost lost{XR_TYPE_EVENT_DATA_EVENTS_LOST, nullptr, std::exchange(lost_, 0)};
			std::memcpy(static_cast<void *>(&event), &lost, sizeof(lost));
			return true;
		}
		if (events_.empty()) return false;
		event = events_.front();
		events_.pop_front();
		return true;
	}

private:
	std::deque<XrEventDataBuffer> events_;
	uint32_t lost_ = 0;
};

} // namespace arift::openxr
