// The session life cycle as a pure function: (state, facts) -> next state. OpenXR 1.1, "Session Lifecycle". No clock, queue or lock.
#pragma once
#include "runtime/openxr/api.h"

namespace arift::openxr
{

struct SessionFacts {
	bool begun = false;             ///< between xrBeginSession and xrEndSession
	bool exitRequested = false;     ///< by the application or by the service
	bool frameSynchronized = false; ///< since it was begun, a frame went through xrWaitFrame, xrBeginFrame and xrEndFrame
	bool visible = false;           ///< the service shows it
	bool focused = false;           ///< and gives it the input
	bool lossPending = false;       ///< its service or its headset is gone
};

constexpr XrSessionState next(XrSessionState state, const SessionFacts &facts)
{
	const bool stays = !facts.exitRequested;
	if (facts.lossPending) return XR_SESSION_STATE_LOSS_PENDING;
	switch (state) {
	case XR_SESSION_STATE_UNKNOWN: return XR_SESSION_STATE_IDLE;
	case XR_SESSION_STATE_IDLE: return stays ? XR_SESSION_STATE_READY : XR_SESSION_STATE_EXITING;
	case XR_SESSION_STATE_READY: return facts.begun && (facts.frameSynchronized || !stays) ? XR_SESSION_STATE_SYNCHRONIZED : state;
	case XR_SESSION_STATE_SYNCHRONIZED:
		if (!stays) return XR_SESSION_STATE_STOPPING;
		return facts.visible ? XR_SESSION_STATE_VISIBLE : state;
	case XR_SESSION_STATE_VISIBLE:
		if (!stays || !facts.visible) return XR_SESSION_STATE_SYNCHRONIZED;
		return facts.focused ? XR_SESSION_STATE_FOCUSED : state;
	case XR_SESSION_STATE_FOCUSED: return stays && facts.visible && facts.focused ? state : XR_SESSION_STATE_VISIBLE;
	case XR_SESSION_STATE_STOPPING: return facts.begun ? state : XR_SESSION_STATE_IDLE;
	default: return state;
	}
}

/// Steps until nothing changes any more; emit(state) hears of every state on the way.
template <typename Emit> constexpr XrSessionState settle(XrSessionState state, const SessionFacts &facts, Emit emit)
{
	for (XrSessionState after = next(state, facts); after != state; after = next(state, facts)) emit(state = after);
	return state;
}

} // namespace arift::openxr
