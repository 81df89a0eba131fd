// The calls that an application makes many times a frame read shared memory: they enter the kernel not once and allocate nothing.
#include "tests/openxr/live_head.h"
#include <csignal>
#include <cstddef>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" void *__libc_malloc(size_t size); // NOLINT(bugprone-reserved-identifier): the C library's own name
static thread_local bool countingAllocations = false;
static int allocations = 0; // of the one thread that counts
/// Stands in for the C library's in the whole process, the library under test included.
extern "C" void *malloc(size_t size)
{
	allocations += countingAllocations;
	return __libc_malloc(size);
}
#else
static bool countingAllocations = false;
static int allocations = 0;
#endif

namespace arift
{
namespace
{

std::atomic<int> systemCalls{0};

/// From now on no system call of this thread is executed: each is counted instead. Never ends.
void trapSystemCalls()
{
	struct sigaction action {
	};
	action.sa_handler = [](int) { systemCalls.fetch_add(1); };
	::sigaction(SIGSYS, &action, nullptr);
	// The return from the signal's handler is a system call itself.
	sock_filter program[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
							 BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 0, 1), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
							 BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP)};
	const sock_fprog filter{4, program};
	if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0)
		throw std::runtime_error("this kernel has no seccomp filters");
}

/// What an application asks in a frame, over and over; objects and entry points are made before.
class Asking
{
public:
	Asking()
	{
		XrActionSetCreateInfo setInfo{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "game", "Game", 0};
		EXPECT_EQ(get<PFN_xrCreateActionSet>("xrCreateActionSet")(head_.application.instance, &setInfo, &active_.actionSet), XR_SUCCESS);
		suggestSelect();
		const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &active_.actionSet};
		EXPECT_EQ(get<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(head_.session, &attach), XR_SUCCESS);
		EXPECT_EQ(head_.application.begin(head_.session), XR_SUCCESS);
		head_.application.states();
	}
	/// Says whether every call answered as it should. A person presses and lets go of a button all the time.
	bool once()
	{
		ipc::InputTable table;
		table.hands[1] = {.isThere = 1, .select = isPressed_};
		table.hasGamepad = 1;
		table.gamepad.triggers[0] = isPressed_ ? 1.0f : 0.0f;
		head_.service.client().input.write(table);
		isPressed_ = 1 - isPressed_;
		XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
		const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active_};
		const XrTime time = head_.nextTime();
		const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, time, head_.local};
		XrViewState state{XR_TYPE_VIEW_STATE};
		XrView views[2] = {{XR_TYPE_VIEW}, {XR_TYPE_VIEW}};
		uint32_t count = 0;
		XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
		XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity};
		return poll_(head_.application.instance, &event) == XR_EVENT_UNAVAILABLE && sync_(head_.session, &sync) == XR_SUCCESS &&
			   isSelected() != (isPressed_ != 0) && locateViews_(head_.session, &info, &state, 2, &count, views) == XR_SUCCESS &&
			   state.viewStateFlags != 0 && locateSpace_(head_.view, head_.local, time, &location) == XR_SUCCESS &&
			   location.locationFlags != 0;
	}

	/// The first time it is there: that is told.
	void meet()
	{
		once();
		XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
		while (poll_(head_.application.instance, &event) == XR_SUCCESS) event = {XR_TYPE_EVENT_DATA_BUFFER};
	}

private:
	template <typename Pfn> Pfn get(const char *name) const { return head_.application.get<Pfn>(name); }
	void suggestSelect()
	{
		const XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, "select", XR_ACTION_TYPE_BOOLEAN_INPUT, 0, nullptr, "Select"};
		EXPECT_EQ(get<PFN_xrCreateAction>("xrCreateAction")(active_.actionSet, &info, &select_), XR_SUCCESS);
		const XrActionSuggestedBinding binding{select_, head_.application.path("/user/hand/right/input/select/click")};
		const XrInteractionProfileSuggestedBinding suggested{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
															 head_.application.path("/interaction_profiles/khr/simple_controller"), 1,
															 &binding};
		EXPECT_EQ(
			get<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(head_.application.instance, &suggested),
			XR_SUCCESS);
	}
	bool isSelected() const
	{
		const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, select_, XR_NULL_PATH};
		XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
		return getBoolean_(head_.session, &info, &state) == XR_SUCCESS && state.isActive && state.currentState;
	}

	LiveHead head_;
	XrActiveActionSet active_{};
	XrAction select_ = XR_NULL_HANDLE;
	uint32_t isPressed_ = 0;
	const PFN_xrPollEvent poll_ = get<PFN_xrPollEvent>("xrPollEvent");
	const PFN_xrSyncActions sync_ = get<PFN_xrSyncActions>("xrSyncActions");
	const PFN_xrGetActionStateBoolean getBoolean_ = get<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean");
	const PFN_xrLocateViews locateViews_ = get<PFN_xrLocateViews>("xrLocateViews");
	const PFN_xrLocateSpace locateSpace_ = get<PFN_xrLocateSpace>("xrLocateSpace");
};

constexpr int rounds = 2000;

/// In a process of its own, on a thread that can do nothing else afterwards. Exits with the number of system calls counted, at most 100,
/// of which one is made on purpose; 101 where an answer was wrong.
[[noreturn]] void countSystemCalls()
{
	Asking asking;
	std::atomic<int> outcome{-1};
	std::thread([&] {
		asking.meet();
		bool good = asking.once(); // whatever is bound or paged in on first use
		trapSystemCalls();
		for (int i = 0; i < rounds; ++i) good = asking.once() && good;
		::getppid();
		outcome = good ? std::min(systemCalls.load(), 100) : 101;
		for (;;) {} // not even ending is possible without a system call
	}).detach();
	while (outcome < 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
	::_exit(outcome);
}

TEST(CommonCase, PollingSyncingAndLocatingMakeNoSystemCall)
{
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	EXPECT_EXIT(countSystemCalls(), testing::ExitedWithCode(1), "") << "one is made on purpose";
}

TEST(CommonCase, PollingSyncingAndLocatingAllocateNothing)
{
	Asking asking;
	asking.meet();
	ASSERT_TRUE(asking.once());
	bool good = true;
	countingAllocations = true;
	for (int i = 0; i < rounds; ++i) good = asking.once() && good;
	countingAllocations = false;
	EXPECT_TRUE(good);
	EXPECT_EQ(allocations, 0);
	const std::string counted(1000, 'x');
	countingAllocations = true;
	const std::string copy = counted;
	countingAllocations = false;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
	EXPECT_EQ(allocations, 1) << "what the test counts by";
#endif
}

} // namespace
} // namespace arift
