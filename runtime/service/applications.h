// Who is seen and who has the focus, and the events that tell them.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/pages.h"
#include <vector>

namespace arift
{

/// Every running session is visible; the one begun last has the focus. Thread-safe; the only writer of every ClientPage's events.
class Applications
{
public:
	/// `page` must stay until forget().
	void introduce(ipc::ClientPage &page);
	void forget(ipc::ClientPage &page);
	/// xrBeginSession, xrEndSession (or the session is gone; no harm when it never ran).
	void begin(ipc::ClientPage &page, uint32_t session, XrTime now);
	void end(ipc::ClientPage &page, uint32_t session, XrTime now);
	/// LOCAL has moved for everybody; `pose` is the new origin in the old space.
	void tellRecentered(const XrPosef &pose, XrTime now);

private:
	struct Running {
		ipc::ClientPage *page;
		uint32_t session;
		bool told = false, focused = false; ///< what its application was last told
	};
	struct State {
		std::vector<ipc::ClientPage *> pages;
		std::vector<Running> running; ///< in the order of xrBeginSession
	};
	static void write(ipc::ClientPage &page, const ipc::Event &event);
	static void settle(State &state, XrTime now);
	Guarded<State> state_;
};

} // namespace arift
