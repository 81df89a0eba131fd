// One connection: an application or a monitor. What it asks is decoded, checked and answered on a thread of its own.
#pragma once
#include "runtime/ipc/shared_memory.h"
#include "runtime/ipc/socket.h"
#include "runtime/service/passthrough_maps.h"
#include "runtime/service/session.h"
#include "runtime/service/swapchains.h"
#include "runtime/service/world.h"
#include <atomic>
#include <memory>
#include <thread>

namespace arift
{

/// A malformed message ends this connection and nothing else.
class Client
{
public:
	Client(ipc::Socket socket, World &world);
	~Client();
	Client(const Client &) = delete;

	/// Its thread has ended: the object may go.
	bool finished() const { return finished_; }
	/// What others may know of it; lives on when the client has gone.
	struct About {
		uint32_t pid = 0;
		std::string name;
		bool application = false;
		std::shared_ptr<Session> session;
		std::shared_ptr<Swapchains> swapchains; ///< with the session
	};
	std::shared_ptr<Guarded<About>> about() const { return about_; }

private:
	void serve(const std::stop_token &stop);
	void answer(const Request &request);
	void answer(const ipc::Hello &message);
	void answer(const ipc::CreateSession &message);
	void answer(const ipc::DestroySession &message);
	void answer(const ipc::SessionRunning &message);
	void answer(const ipc::CreateSwapchain &message);
	void answer(const ipc::DestroySwapchain &message);
	void answer(const ipc::ShowPassthrough &message);
	void answer(const ipc::StylePassthrough &message);
	void answer(const ipc::GetStatus &message);
	void answer(const ipc::Screenshot &message);
	void answer(const ipc::SetSetting &message);
	void keep(const std::vector<std::string> &table, const Overrides::Values &values);
	void answer(const ipc::Recenter &message);
	void answer(const ipc::ShutDown &message);
	void answer(const ipc::ForcePassthrough &message);
	template <typename Reply> void reply(const ipc::Header &request, Reply message, std::span<const int> fds = {})
	{
		message.header.sequence = request.sequence;
		// Replies are small: a client that lets its socket fill up is not reading.
		if (socket_.send(message, fds, realTime() + 2 * second) == ipc::Transfer::timeout) socket_.hangUp();
	}
	void refuse(const ipc::Header &request, XrResult result, const std::string &text);
	void stopSession();
	void beginSession(uint32_t number, ipc::Socket channel);
	void present(Session &session, const std::string &application) const;
	ipc::Sharing sharingFor(const ipc::CreateSession &message) const;
	UniqueFd offerProbe(ipc::SessionCreated &created) const;
	Session &sessionNumbered(uint32_t number);

	World &world_;
	ipc::Socket socket_;
	const uint32_t peerPid_;
	std::atomic<bool> finished_ = false, application_ = false;
	bool greeted_ = false;
	const std::shared_ptr<ipc::SharedPage<ipc::ClientPage>> page_;
	std::shared_ptr<gpu::Device> device_;         ///< while there is a session
	std::shared_ptr<Compositor> compositor_;      ///< while there is a session
	ipc::Sharing sharing_ = ipc::Sharing::memory; ///< what the session may ask for
	std::shared_ptr<Swapchains> swapchains_;
	std::shared_ptr<Session> session_;
	SessionRole role_;                                 ///< of the session
	std::unique_ptr<PassthroughMaps> passthroughMaps_; ///< with the session
	const std::shared_ptr<Guarded<About>> about_ = std::make_shared<Guarded<About>>();
	std::jthread thread_;
};

/// One entry for `arift status` where it is an application.
void describeClient(nlohmann::json &list, const Client::About &about);

} // namespace arift
