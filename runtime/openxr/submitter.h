// Sends a session's submissions in order, each when all the work on its images is known to be finished. The compositor never waits.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/socket.h"
#include "runtime/openxr/graphics.h"
#include <deque>
#include <functional>
#include <thread>

namespace arift::openxr
{

class Submitter
{
public:
	/// `frames` must outlive it. `fail` is called once, in the thread, when frames can no longer reach the service: the channel is closed
	/// or nobody reads it, or the application's device is lost. Nothing is sent from then on.
	explicit Submitter(
		ipc::Socket &frames, std::function<void()> fail = [] {});
	/// Sends nothing further; ends within a wait of `waitSlice`.
	~Submitter();

	/// Thread-safe.
	void submit(const ipc::Submission &submission, std::vector<std::shared_ptr<Completion>> work);
	/// Waits until all is sent, or drops what is not sent within `limit` of real time.
	void drain(XrDuration limit);

private:
	static constexpr XrDuration waitSlice = 20 * millisecond;
	static constexpr XrDuration workLimit = 5 * second;
	static constexpr XrDuration sendLimit = second;
	struct Job {
		ipc::Submission submission;
		std::vector<std::shared_ptr<Completion>> work;
	};
	struct Queue {
		std::deque<Job> jobs;
		bool busy = false;
		bool failed = false; ///< what comes is dropped
	};

	void run(const std::stop_token &stop);
	/// False when nothing more can be sent.
	bool send(const Job &job, const std::stop_token &stop) const;
	Completion::Outcome waitFor(const Job &job, const std::stop_token &stop) const;

	ipc::Socket &frames_;
	const std::function<void()> fail_;
	Guarded<Queue> queue_;
	std::jthread thread_;
};

} // namespace arift::openxr
