// The service's side of the wire for tests of the client library: a thread that answers, shared pages the test writes as it likes, and a
// record of what the application sent. With a GPU device it hands out real images.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/ipc/listener.h"
#include "runtime/ipc/shared_memory.h"
#include "runtime/motion/pose_history.h"
#include "tests/common/temporary_folder.h"
#include <functional>
#include <optional>
#include <thread>
#include <vector>

namespace arift
{

class FakeService
{
public:
	/// Makes the images of a swapchain; one fd each.
	using MakeImages = std::function<std::vector<UniqueFd>(const ipc::CreateSwapchain &, ipc::SwapchainCreated &)>;

	/// Listens in a runtime directory of its own, which the environment of this process names from now on.
	explicit FakeService(const ipc::Welcome &welcome = usualWelcome(), MakeImages makeImages = {});
	~FakeService();
	FakeService(const FakeService &) = delete;

	static ipc::Welcome usualWelcome();

	// ---- what the library reads
	ipc::SystemPage &system() { return *system_; }
	ipc::ClientPage &client() { return *client_; }
	PoseWriter &poses() { return writer_; }
	void send(const ipc::Event &event);
	/// Whether a submission is let go of as soon as the next one comes, as when every refresh shows the newest.
	void setShowing(bool showing) { showing_ = showing; }
	/// How long xrWaitFrame takes.
	void setPace(XrDuration pace) { pace_ = pace; }
	/// The next so many that say hello are hung up on.
	void hangUpOnHello(int times) { deaf_ = times; }
	/// Nothing is answered from now on.
	void stopAnswering() { answering_ = false; }
	void stopHeart() { heart_ = {}; }
	/// Sessions made from now on have a frame channel that is full and is not read.
	void stopReadingFrames() { readingFrames_ = false; }
	/// The frame channel that was not read is from now on.
	void readFrames();
	/// What sessions made from now on are told of their images; one descriptor behind the frame channel, or none. Else they may share
	/// images of VK_FORMAT_R8G8B8A8_SRGB.
	using Grant = std::function<UniqueFd(ipc::SessionCreated &)>;
	void setGrant(Grant grant) { *grant_.lock() = std::move(grant); }
	/// Looks at every message before it is answered, in the thread of its connection; `isFrame`: it came through a session's frame channel.
	using Watch = std::function<void(const ipc::Received &message, bool isFrame)>;
	void setWatch(Watch watch) { *watch_.lock() = std::move(watch); }
	/// What CreateSession is answered with from now on.
	void refuseSessions(XrResult result) { refusal_ = result; }
	/// Ends every connection as a process that is killed does.
	void hangUp();
	/// As before the first of them, whose processes are gone: a service that lives on for further ones. What was set stays set.
	void forgetClients();

	// ---- what the library sent
	struct Record {
		std::vector<ipc::Hello> hellos;
		std::vector<ipc::Submission> submissions;
		std::vector<uint64_t> relinquished;
		std::vector<uint32_t> waits;                 ///< the submissions each WaitFrame announced
		std::vector<ipc::MessageType> frameMessages; ///< all that came through the frame channel, in order
		std::vector<ipc::CreateSwapchain> swapchains;
		uint32_t sessionsCreated = 0, sessionsDestroyed = 0, swapchainsDestroyed = 0;
		bool running = false;
		std::vector<ipc::CreateSession> sessions;
		std::vector<ipc::Vibrate> vibrations;
		std::vector<ipc::ShowPassthrough> passthroughShown;
		std::vector<ipc::StylePassthrough> passthroughStyles;
	};
	/// The record when it fulfils `ready`; the test fails after ten seconds.
	Record waitFor(const std::function<bool(const Record &)> &ready);
	Record record() { return *record_.lock(); }

private:
	void accept(const std::stop_token &stop);
	void serve(ipc::Socket &socket, const std::stop_token &stop);
	void serveFrames(ipc::Socket &socket, const std::stop_token &stop);
	void watch(const ipc::Received &received, bool isFrame);
	void answer(ipc::Socket &socket, const ipc::Received &received);
	void beat(const std::stop_token &stop);
	struct Connection {
		std::shared_ptr<ipc::Socket> socket;
		std::jthread thread;
	};
	void start(std::shared_ptr<ipc::Socket> socket, void (FakeService::*work)(ipc::Socket &, const std::stop_token &));

	const test::TemporaryFolder folder_;
	ipc::Welcome welcome_;
	MakeImages makeImages_;
	ipc::SharedPage<ipc::SystemPage> system_{"fake-system"};
	ipc::SharedPage<PoseRing> ring_{"fake-poses"};
	ipc::SharedPage<ipc::ClientPage> client_{"fake-client"};
	PoseWriter writer_{*ring_};
	std::atomic<bool> showing_{true}, readingFrames_{true}, answering_{true};
	std::atomic<int> deaf_{0};
	std::atomic<XrDuration> pace_{0};
	std::atomic<XrResult> refusal_{XR_SUCCESS};
	Guarded<Grant> grant_{[](ipc::SessionCreated &created) {
		created.formats[0] = 43;
		return UniqueFd();
	}};
	Guarded<Watch> watch_{[](const ipc::Received &, bool) {}};
	std::optional<ipc::Socket> unread_; ///< the service's end of a frame channel
	Guarded<Record> record_;
	Guarded<std::vector<Connection>> connections_;
	std::unique_ptr<ipc::Listener> listener_;
	std::jthread heart_, acceptor_;
};

} // namespace arift
