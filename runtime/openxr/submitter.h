// Sends a session's submissions in order, each when all the work on its images is known to be finished. The compositor never waits.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/socket.h"
#include "runtime/openxr/graphics.h"
#include <deque>
#include <thread>

namespace arift::openxr
{

class Submitter
{
public:
	/// `frames` must outlive it.
	explicit Submitter(ipc::Socket &frames);
	/// Sends nothing further; ends within a wait of `waitSlice`.
	~Submitter();

	/// Thread-safe.
	void submit(const ipc::Submission &submission, std::vector<std::shared_ptr<Completion>> work);
	/// Waits until all is sent, or drops what is not sent within `limit` of real time.
	void drain(XrDuration limit);

private:
	static constexpr XrDuration waitSlice = 20 * millisecond;
	static constexpr XrDuration workLimit = 5 * second;
	struct Job {
		ipc::Submission submission;
		std::vector<std::shared_ptr<Completion>> work;
	};
	struct Queue {
		std::deque<Job> jobs;
		bool busy = false;
	};

	void run(const std::stop_token &stop);
	bool waitFor(const Job &job, const std::stop_token &stop) const;

	ipc::Socket &frames_;
	Guarded<Queue> queue_;
	std::jthread thread_;
};

} // namespace arift::openxr
