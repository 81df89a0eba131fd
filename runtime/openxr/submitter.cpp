#include "runtime/openxr/submitter.h"
#include "runtime/base/clock.h"
#include "runtime/base/log.h"
#include <signal.h>

namespace arift::openxr
{
namespace
{

/// A thread in a foreign process: the application's signals are not for it.
class SignalsBlocked
{
public:
	SignalsBlocked()
	{
		sigset_t all;
		::sigfillset(&all);
		::pthread_sigmask(SIG_SETMASK, &all, &before_);
	}
	~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
	SignalsBlocked(const SignalsBlocked &) = delete;

private:
	sigset_t before_{};
};

template <typename Function> std::jthread startThread(Function function)
{
	const SignalsBlocked inherited;
	return std::jthread(std::move(function));
}

} // namespace

Submitter::Submitter(ipc::Socket &frames) : frames_(frames), thread_(startThread([this](const std::stop_token &stop) { run(stop); })) {}

Submitter::~Submitter() = default;

void Submitter::submit(const ipc::Submission &submission, std::vector<std::shared_ptr<Completion>> work)
{
	queue_.update([&](Queue &queue) { queue.jobs.push_back({submission, std::move(work)}); });
}

void Submitter::drain(XrDuration limit)
{
	const auto isIdle = [](const Queue &queue) { return queue.jobs.empty() && !queue.busy; };
	auto queue = queue_.lock();
	if (!queue.waitFor({}, std::chrono::nanoseconds(limit), isIdle)) queue->jobs.clear();
}

void Submitter::run(const std::stop_token &stop)
{
	for (;;) {
		Job job;
		{
			auto queue = queue_.lock();
			if (!queue.wait(stop, [](const Queue &q) { return !q.jobs.empty(); }) || stop.stop_requested()) return;
			job = std::move(queue->jobs.front());
			queue->jobs.pop_front();
			queue->busy = true;
		}
		// A failure to send is the session's end, which every other use of the socket notices.
		if (waitFor(job, stop)) frames_.send(job.submission, realTime() + second);
		job.work.clear();
		queue_.update([](Queue &queue) { queue.busy = false; });
	}
}

bool Submitter::waitFor(const Job &job, const std::stop_token &stop) const
{
	const XrTime deadline = realTime() + workLimit;
	for (const auto &work : job.work)
		while (!work->wait(waitSlice)) {
			if (stop.stop_requested()) return false;
			if (realTime() < deadline) continue;
			log::error("the application's GPU did not finish frame {} within {} s; it is not shown", job.submission.frame,
					   inSeconds(workLimit));
			return false;
		}
	return true;
}

} // namespace arift::openxr
