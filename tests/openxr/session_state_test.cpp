#include "runtime/openxr/session_state.h"
#include <gtest/gtest.h>
#include <vector>

namespace arift::openxr
{
namespace
{

using States = std::vector<XrSessionState>;

States statesFrom(XrSessionState state, const SessionFacts &facts)
{
	States passed;
	settle(state, facts, [&](XrSessionState s) { passed.push_back(s); });
	return passed;
}

constexpr auto unknown = XR_SESSION_STATE_UNKNOWN, idle = XR_SESSION_STATE_IDLE, ready = XR_SESSION_STATE_READY,
			   synchronized = XR_SESSION_STATE_SYNCHRONIZED, visible = XR_SESSION_STATE_VISIBLE, focused = XR_SESSION_STATE_FOCUSED,
			   stopping = XR_SESSION_STATE_STOPPING, exiting = XR_SESSION_STATE_EXITING, lossPending = XR_SESSION_STATE_LOSS_PENDING;

struct Row {
	const char *what;
	XrSessionState from;
	SessionFacts facts;
	States passed;
};

const Row rows[] = {
	{"a new session is ready at once", unknown, {}, {idle, ready}},
	{"ready until it is begun", ready, {.visible = true, .focused = true}, {}},
	{"begun, but no frame yet", ready, {.begun = true, .visible = true, .focused = true}, {}},
	{"in step, not shown", ready, {.begun = true, .frameSynchronized = true}, {synchronized}},
	{"in step, shown and focused",
	 ready,
	 {.begun = true, .frameSynchronized = true, .visible = true, .focused = true},
	 {synchronized, visible, focused}},
	{"loses the focus", focused, {.begun = true, .frameSynchronized = true, .visible = true}, {visible}},
	{"is hidden, step by step", focused, {.begun = true, .frameSynchronized = true, .focused = true}, {visible, synchronized}},
	{"focus alone shows nothing", synchronized, {.begun = true, .frameSynchronized = true, .focused = true}, {}},
	{"exit from focused passes every state",
	 focused,
	 {.begun = true, .exitRequested = true, .frameSynchronized = true, .visible = true, .focused = true},
	 {visible, synchronized, stopping}},
	{"exit before the first frame", ready, {.begun = true, .exitRequested = true}, {synchronized, stopping}},
	{"exit of a session that was not begun waits", ready, {.exitRequested = true}, {}},
	{"ended after exit", stopping, {.exitRequested = true}, {idle, exiting}},
	{"ended without exit may begin again", stopping, {}, {idle, ready}},
	{"stopping until it is ended", stopping, {.begun = true, .exitRequested = true}, {}},
	{"loss comes from everywhere", visible, {.begun = true, .visible = true, .lossPending = true}, {lossPending}},
	{"nothing follows exiting", exiting, {.begun = true, .visible = true}, {}},
};

TEST(SessionState, Table)
{
	for (const Row &row : rows) EXPECT_EQ(statesFrom(row.from, row.facts), row.passed) << row.what;
}

/// However the facts lie, it settles, and only steps the specification draws are taken.
TEST(SessionState, EveryCombinationSettles)
{
	for (int bits = 0; bits < 64; ++bits)
		for (int state = unknown; state <= exiting; ++state) {
			const SessionFacts facts{.begun = bool(bits & 1),
									 .exitRequested = bool(bits & 2),
									 .frameSynchronized = bool(bits & 4),
									 .visible = bool(bits & 8),
									 .focused = bool(bits & 16),
									 .lossPending = bool(bits & 32)};
			EXPECT_LE(statesFrom(XrSessionState(state), facts).size(), 5u) << "state " << state << ", facts " << bits;
		}
}

} // namespace
} // namespace arift::openxr
