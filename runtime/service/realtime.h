// Asks rtkit for a low real-time priority for threads that must not be late, within limits: a thread that runs away gives it back.
#pragma once
#include "runtime/base/guarded.h"
#include <string>
#include <sys/types.h>
#include <vector>

namespace arift
{

/// Thread-safe.
class Realtime
{
public:
	/// Above everything that shares the processor fairly, below the sound system and the kernel's own threads.
	static constexpr uint32_t priority = 5;

	/// For the calling thread, called `name` in the log. No bus, no rtkit or a refusal are states: they are told and everything goes on.
	/// Takes a few milliseconds, at most two seconds where the bus hangs.
	void askFor(const char *name);
	/// Every thread shares the processor fairly again: for SIGXCPU, which comes when one has used it up without a pause (RLIMIT_RTTIME).
	void giveBack();
	size_t granted() { return threads_.lock()->size(); }

private:
	Guarded<std::vector<pid_t>> threads_;
};

/// rtkit's answer for a thread of this process: empty, or why not.
std::string makeRealtime(pid_t thread, uint32_t priority);

} // namespace arift
