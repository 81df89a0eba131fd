// The service's side of the well-known socket: the lock that says who may have it, and accepting its own user's connections.
#pragma once
#include "runtime/ipc/socket.h"
#include <filesystem>

namespace arift::ipc
{

/// Only one service per user: a lock file held for life. Nothing where another process holds it.
std::optional<UniqueFd> takeServiceLock(const std::filesystem::path &path);

/// Listens on a socket in a private directory. The caller holds the service lock: what lies at the path is a dead service's and is
/// replaced. Where systemd started this process for its socket unit (sd_listen_fds(3): LISTEN_PID, LISTEN_FDS), that socket is used and
/// stays.
class Listener
{
public:
	/// Throws InputError where the path is too long for a socket or cannot be bound, or where systemd's socket is another than this.
	explicit Listener(const std::filesystem::path &path);
	~Listener();
	Listener(const Listener &) = delete;

	/// The next connection from a process of this user (others are closed and counted out), or nothing by the deadline or after stop().
	std::optional<Socket> accept(XrTime realDeadline);
	/// Ends accept() at once and from then on, from any thread. The socket itself is left alone: systemd may go on listening on it.
	void stop();

private:
	struct Listening {
		Socket socket;
		bool inherited; ///< from systemd, which keeps the path
	};
	static Listening listenOn(const std::filesystem::path &path);

	std::filesystem::path path_;
	Listening listening_;
	UniqueFd stopped_; ///< eventfd
};

/// Connects to a listening service of this user. Nothing where nobody listens. Throws InputError where the path is too long or the
/// listener belongs to somebody else.
std::optional<Socket> connectTo(const std::filesystem::path &path);

} // namespace arift::ipc
