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

Submitter::Submitter(ipc::Socket &frames, std::function<void()> fail)
	: frames_(frames), fail_(std::move(fail)), thread_(startThread([this](const std::stop_token &stop) { run(stop); }))
{
}

Submitter::~Submitter() = default;

void Submitter::submit(const ipc::Submission &submission, std::vector<std::shared_ptr<Completion>> work)
{
	queue_.update([&](Queue &queue) {
		if (!queue.failed) queue.jobs.push_back({submission, std::move(work)});
	});
}

void Submitter::drain(XrDuration limit)
{
	const auto isIdle = [](const Queue &queue) { return queue.jobs.empty() && !queue.busy; };
	auto queue = queue_.lock();
	if (!queue.waitFor({}, std::chrono::nanoseconds(limit), isIdle)) queue->jobs.clear();
}

void Submitter::run(const std::stop_token &stop)
{
	for (bool failed = false; !failed;) {
		Job job;
		{
			auto queue = queue_.lock();
			if (!queue.wait(stop, [](const Queue &q) { return !q.jobs.empty(); }) || stop.stop_requested()) return;
			job = std::move(queue->jobs.front());
			queue->jobs.pop_front();
			queue->busy = true;
		}
		failed = !send(job, stop);
		job.work.clear();
		queue_.update([&](Queue &queue) {
			queue.busy = false;
			queue.failed = failed;
			if (failed) queue.jobs.clear();
		});
	}
	fail_();
}

bool Submitter::send(const Job &job, const std::stop_token &stop) const
{
	const Completion::Outcome work = waitFor(job, stop);
	if (work == Completion::Outcome::notYet) return true;
	if (work == Completion::Outcome::failed) {
		log::error("the application's GPU device is lost");
		return false;
	}
	switch (frames_.send(job.submission, realTime() + sendLimit)) {
	case ipc::Transfer::done: return true;
	case ipc::Transfer::timeout:
		log::error("arift-service did not take frame {} within {} s", job.submission.frame, inSeconds(sendLimit));
		break;
	default: break; // closed: every other use of the channel notices
	}
	return false;
}

Completion::Outcome Submitter::waitFor(const Job &job, const std::stop_token &stop) const
{
	using Outcome = Completion::Outcome;
	const XrTime deadline = realTime() + workLimit;
	for (const auto &work : job.work)
		for (;;) {
			const Outcome outcome = work->wait(waitSlice);
			if (outcome == Outcome::done) break;
			if (outcome == Outcome::failed || stop.stop_requested()) return outcome;
			if (realTime() < deadline) continue;
			log::error("the application's GPU did not finish frame {} within {} s; it is not shown", job.submission.frame,
					   inSeconds(workLimit));
			return outcome;
		}
	return Outcome::done;
}

} // namespace arift::openxr
