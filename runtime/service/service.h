// arift-service: listens first, opens the headset after, serves clients until it is asked to stop or nobody is left.
#pragma once
#include "runtime/ipc/listener.h"
#include "runtime/service/client.h"
#include "runtime/service/config.h"
#include "runtime/service/input_thread.h"
#include "runtime/service/world.h"
#include <list>
#include <memory>
#include <optional>

namespace arift
{

/// Everything that is open: GPU, devices, compositor. In the order in which one needs the other.
class System;

class Service
{
public:
	struct Options {
		Config config;
		std::optional<XrDuration> idleExit; ///< leave after so long without clients (real time)
	};
	Service(Options options, ipc::Listener &listener);
	~Service();
	Service(const Service &) = delete;

	/// How serving came to its end: without a problem where it was asked to, or nobody was left.
	struct End {
		std::string problem;
		bool fault = false; ///< it did work before: starting it anew may help
	};
	/// Serves until stop(), or until it cannot go on by itself.
	End run();
	/// Thread-safe, and safe in a signal handler's thread.
	void stop();
	Realtime &realtime() { return world_.realtime; }

private:
	void open();
	void recover(const std::string &problem);
	void endSessions();
	void followHeadset();
	void beat(const std::stop_token &stop);
	void removeFinished();
	void admit(ipc::Socket socket);
	bool mayLeave();
	std::unique_ptr<InputThread> readInput();
	void fail(const std::string &problem, bool fault);
	std::vector<std::shared_ptr<Guarded<Client::About>>> abouts();
	void forEachSession(const std::function<void(const std::string &, Session &)> &call);
	void describeClients(nlohmann::json &list);

	const Options options_;
	ipc::Listener &listener_;
	std::unique_ptr<Clock> clock_;
	World world_;
	std::atomic<bool> stopping_ = false;
	std::unique_ptr<System> system_;     ///< made by opener_; read elsewhere once world_.opened says so
	std::unique_ptr<InputThread> input_; ///< null: nothing is switched on
	Guarded<std::list<Client>> clients_{};
	XrTime lastSeen_ = 0;  ///< real: when the newest client was there
	XrTime lookAtUsb_ = 0; ///< real: when to look next what is plugged in
	std::jthread opener_, heart_;
};

} // namespace arift
