// Who is seen, who has the focus and who has the input, and the events that tell them.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/pages.h"
#include <functional>
#include <vector>

namespace arift
{

/// What a session is among others.
struct SessionRole {
	bool isHeadless = false; ///< XR_MND_headless: it shows nothing and always has the input
	bool isOverlay = false;  ///< XR_EXTX_overlay: it lies over the main sessions
	uint32_t placement = 0;  ///< of an overlay: the highest in front
	bool hasDepth = false;   ///< main session: what overlays are told of it

	bool isMain() const { return !isHeadless && !isOverlay; }
	/// Where its layers are among others': those with the same in the order of xrBeginSession.
	uint64_t order() const { return isOverlay ? 1 + uint64_t(placement) : 0; }
};

/// Every running session is visible. Of the main sessions the one begun last has the focus; overlay sessions, which lie over whatever is
/// there and take nothing from it, and headless ones have it as long as they run. Who has the focus has the input. Thread-safe; the only
/// writer of every ClientPage's events and input.
class Applications
{
public:
	/// `page` must stay until forget().
	void introduce(ipc::ClientPage &page);
	void forget(ipc::ClientPage &page);
	/// xrBeginSession, xrEndSession (or the session is gone; no harm when it never ran).
	void begin(ipc::ClientPage &page, uint32_t session, XrTime now, const SessionRole &role = {});
	void end(ipc::ClientPage &page, uint32_t session, XrTime now);
	bool hasFocus(uint32_t session);
	/// LOCAL has moved for everybody; `pose` is the new origin in the old space.
	void tellRecentered(const XrPosef &pose, XrTime now);
	/// What the devices of input say.
	void tellInput(const ipc::InputTable &input);
	/// Called, without a lock, whenever the focus may have been taken from somebody. To be set before there is anybody.
	std::function<void()> focusMoves = [] {};

private:
	struct Running {
		ipc::ClientPage *page;
		uint32_t session;
		SessionRole role;
		bool told = false, focused = false; ///< what its application was last told
		bool mainVisible = false;           ///< what an overlay was last told
	};
	struct State {
		std::vector<ipc::ClientPage *> pages;
		std::vector<Running> running; ///< in the order of xrBeginSession
		ipc::InputTable input;
	};
	static void write(ipc::ClientPage &page, const ipc::Event &event);
	static void settle(State &state, XrTime now);
	static void tellOverlays(State &state, const Running *main, XrTime now);
	static void writeInput(State &state);
	Guarded<State> state_;
};

} // namespace arift
