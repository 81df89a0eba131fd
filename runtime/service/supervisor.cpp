#include "runtime/service/supervisor.h"
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/base/log.h"
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace arift
{

namespace
{

constexpr XrDuration firstPause = 100 * millisecond, longestPause = 5 * second;

sigset_t watchedSignals()
{
	sigset_t set;
	sigemptyset(&set);
	for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGCHLD}) sigaddset(&set, number);
	return set;
}

/// The parent's view of the service.
class Watch
{
public:
	Watch() : watched_(watchedSignals()) { ::sigprocmask(SIG_BLOCK, &watched_, &before_); }

	/// False in the child.
	bool start()
	{
		child_ = ::fork();
		if (child_ == 0) ::sigprocmask(SIG_SETMASK, &before_, nullptr);
		return child_ != 0;
	}
	/// Waits for the child's end; its status as waitpid has it.
	int await()
	{
		int status = 0;
		while (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == 0) handle(::sigwaitinfo(&watched_, nullptr));
		return child_ > 0 ? status : W_EXITCODE(EXIT_FAILURE, 0); // no process could be made
	}
	/// False where the end is asked for in the meantime.
	bool pause(XrDuration duration)
	{
		child_ = 0;
		for (const XrTime end = realTime() + duration; !stopping_;) {
			const XrDuration left = end - realTime();
			if (left <= 0) return true;
			const timespec wait{time_t(left / second), long(left % second)};
			handle(::sigtimedwait(&watched_, nullptr, &wait));
		}
		return false;
	}
	bool stopping() const { return stopping_; }

private:
	void handle(int signal)
	{
		if (signal <= 0 || signal == SIGCHLD) return;
		stopping_ = true;
		if (child_ > 0) ::kill(child_, SIGTERM);
	}

	const sigset_t watched_;
	sigset_t before_{};
	pid_t child_ = 0;
	bool stopping_ = false;
};

bool isFault(int status) { return WIFSIGNALED(status) || WEXITSTATUS(status) == exitAfterFault; }

std::string describe(int status)
{
	return WIFSIGNALED(status) ? fmt::format("signal {} ({}) has ended", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
							   : "a fault has ended";
}

} // namespace

std::optional<XrDuration> RestartPolicy::died(XrDuration lived)
{
	quickInARow_ = lived < quick ? quickInARow_ + 1 : 0;
	if (quickInARow_ > mostQuick) return std::nullopt;
	return std::min(firstPause << std::max(quickInARow_ - 1, 0), longestPause);
}

std::optional<int> supervise(const std::function<void()> &parentBegins)
{
	Watch watch;
	RestartPolicy policy;
	for (bool first = true;; first = false) {
		const XrTime began = realTime();
		if (!watch.start()) return std::nullopt;
		if (first) {
			parentBegins();
			::prctl(PR_SET_NAME, "arift-watch");
		}
		const int status = watch.await();
		if (!isFault(status)) return WEXITSTATUS(status);
		if (watch.stopping()) return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
		const auto pause = policy.died(realTime() - began);
		if (!pause) {
			log::error("{} the service {} times in a row within {} s: it is not started again", describe(status),
					   RestartPolicy::mostQuick + 1, RestartPolicy::quick / second);
			return EXIT_FAILURE;
		}
		log::warning("{} the service: it is started again in {:.1f} s", describe(status), inSeconds(*pause));
		if (!watch.pause(*pause)) return 0;
	}
}

} // namespace arift
