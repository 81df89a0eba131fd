// The service as this process sees it: requests with bounded waits, the pages it shares, and whether it is still there.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/ipc/request.h"
#include "runtime/ipc/shared_memory.h"
#include "runtime/motion/pose_history.h"
#include "runtime/openxr/error.h"
#include "runtime/openxr/fork.h"
#include <atomic>
#include <memory>

namespace arift::openxr
{

class Service
{
public:
	/// A service that has not stirred for so long (real time) is lost.
	static constexpr XrDuration silenceLimit = 2 * second;
	/// … and neither within so long after somebody noticed: several beats.
	static constexpr XrDuration secondLook = 300 * millisecond;
	/// How long a request may take (real time) of a service that lives. On a busy machine a software renderer takes its time to allocate
	/// and clear images; a process that stands still is noticed by its silence long before.
	static constexpr XrDuration requestLimit = 30 * second;
	/// The first session may come while the service is still opening its devices: its own reason comes before this limit.
	static constexpr XrDuration openingLimit = ipc::openingLimit + 5 * second;

	/// Connects, and starts the service when none runs. Throws XR_ERROR_RUNTIME_UNAVAILABLE with the sentence that says what to do.
	explicit Service(const ipc::Hello &hello);

	const ipc::Welcome &welcome() const { return answer_.reply; }
	const PoseHistory &poses() const { return poses_; }
	const ipc::ClientPage &client() const { return *client_; }
	/// Both throw XR_ERROR_INSTANCE_LOST when the page can not be read: its writer died half-way.
	ipc::ViewTable views() const { return read(system_->views); }
	ipc::TimingTable timing() const { return read(system_->timing); }
	ipc::HeadsetState headset() const { return read(system_->headset); }
	ipc::LensOutlines lensOutlines() const { return read(system_->lensOutlines); }
	ClockAnchor clock() const;
	/// Now, in the time of the service's clock.
	XrTime now() const { return clock().at(realTime()); }

	/// Sends a request; its answer, or an Error with the result the service gave.
	template <typename Reply, typename Request> ipc::Answer<Reply> ask(const Request &request, XrDuration limit = requestLimit)
	{
		requireAlive();
		auto answer = requests_->ask<Reply>(request, limit, {}, [this] { return !isLost(); });
		if (answer.how == ipc::Answered::hungUp) lose("it has gone away");
		if (answer.how == ipc::Answered::timeout) lose("it did not answer in time");
		requireAlive();
		if (!answer) throw Error(XrResult(answer.failure.result), "the service: {}", ipc::textOf(answer.failure.text));
		return answer;
	}

	/// After a fork, in the child.
	bool isOfAnotherProcess() const { return forkCount_ != forkCount(); }
	/// No system call, unless the news is bad.
	bool isLost() const;
	void requireAlive() const
	{
		if (isLost()) throw Error(XR_ERROR_INSTANCE_LOST, "the connection to arift-service is lost");
	}
	/// One system call: sleeps at most so long (real time), until the connection ends, and notes whether it has.
	void noticeHangUp(XrDuration within = 0) const;
	/// Says once why, and lets every later call fail at once.
	void lose(const char *why) const;

private:
	/// A connection, and the service's first word on it.
	struct Greeting {
		std::unique_ptr<ipc::Requests> requests;
		ipc::Answer<ipc::Welcome> answer;
	};
	static Greeting greet(const ipc::Hello &hello);
	explicit Service(Greeting greeting);
	bool isSilentAgain(XrTime beat, XrTime now) const;
	template <typename T> T read(const ipc::Published<T> &published) const
	{
		if (T value; published.read(value)) return value;
		lose("its shared page is torn");
		throw Error(XR_ERROR_INSTANCE_LOST, "the service's shared page is torn");
	}

	std::unique_ptr<ipc::Requests> requests_;
	ipc::Answer<ipc::Welcome> answer_;
	ipc::SharedPageView<ipc::SystemPage> system_;
	ipc::SharedPageView<PoseRing> ring_;
	ipc::SharedPageView<ipc::ClientPage> client_;
	PoseHistory poses_;
	uint32_t forkCount_;
	ClosedInChildren closedInChildren_;
	mutable std::atomic<bool> lost_{false};
	mutable std::atomic<XrTime> suspectedBeat_{-1}, suspectedSince_{0};
};

} // namespace arift::openxr
