#include "runtime/ipc/listener.h"
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>

namespace arift::ipc
{

namespace
{

sockaddr_un addressOf(const std::filesystem::path &path)
{
	sockaddr_un address{};
	address.sun_family = AF_UNIX;
	if (path.native().size() >= sizeof(address.sun_path))
		throw InputError("{}: the path of a socket may have at most {} bytes, this has {}; choose a shorter XDG_RUNTIME_DIR", path.string(),
						 sizeof(address.sun_path) - 1, path.native().size());
	std::memcpy(address.sun_path, path.c_str(), path.native().size() + 1);
	return address;
}

Socket makeSocket(int flags)
{
	UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | flags, 0));
	if (!fd) throw std::system_error(errno, std::generic_category(), "socket");
	return Socket(std::move(fd));
}

/// The socket systemd handed over, if it did; sd_listen_fds(3). The variables are taken away: they are not for programs started from here.
std::optional<Socket> inheritedSocket(const std::filesystem::path &path)
{
	constexpr int firstFd = 3;
	const char *pid = std::getenv("LISTEN_PID"), *fds = std::getenv("LISTEN_FDS");
	if (!pid || !fds || std::to_string(::getpid()) != pid) return std::nullopt;
	const std::string count = fds;
	for (const char *name : {"LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES"}) ::unsetenv(name);
	sockaddr_un address{};
	socklen_t size = sizeof(address) - 1;
	int listening = 0, type = 0;
	socklen_t length = sizeof(int);
	const bool fits = count == "1" && ::getsockname(firstFd, reinterpret_cast<sockaddr *>(&address), &size) == 0 &&
					  address.sun_family == AF_UNIX && path == address.sun_path &&
					  ::getsockopt(firstFd, SOL_SOCKET, SO_ACCEPTCONN, &listening, &length) == 0 && listening &&
					  ::getsockopt(firstFd, SOL_SOCKET, SO_TYPE, &type, &length) == 0 && type == SOCK_SEQPACKET;
	if (!fits)
		throw InputError("systemd handed over {} sockets, the first being \"{}\"; expected one SOCK_SEQPACKET that listens on {}", count,
						 address.sun_path, path.string());
	::fcntl(firstFd, F_SETFD, FD_CLOEXEC);
	::fcntl(firstFd, F_SETFL, ::fcntl(firstFd, F_GETFL) | O_NONBLOCK);
	return Socket(UniqueFd(firstFd));
}

} // namespace

std::optional<UniqueFd> takeServiceLock(const std::filesystem::path &path)
{
	UniqueFd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
	if (!fd) throw InputError("{}: cannot be opened: {}", path.string(), std::strerror(errno));
	if (::flock(fd.get(), LOCK_EX | LOCK_NB) == 0) return fd;
	if (errno != EWOULDBLOCK) throw InputError("{}: cannot be locked: {}", path.string(), std::strerror(errno));
	return std::nullopt;
}

Listener::Listening Listener::listenOn(const std::filesystem::path &path)
{
	const sockaddr_un address = addressOf(path);
	if (auto inherited = inheritedSocket(path)) return {std::move(*inherited), true};
	Socket socket = makeSocket(SOCK_NONBLOCK);
	::unlink(path.c_str());
	if (::bind(socket.fd(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0 || ::listen(socket.fd(), 64) != 0)
		throw InputError("{}: cannot listen: {}", path.string(), std::strerror(errno));
	return {std::move(socket), false};
}

Listener::Listener(const std::filesystem::path &path)
	: path_(path), listening_(listenOn(path)), stopped_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
{
	if (!stopped_) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Listener::~Listener()
{
	if (!listening_.inherited) ::unlink(path_.c_str());
}

void Listener::stop()
{
	const uint64_t once = 1;
	[[maybe_unused]] const ssize_t written = ::write(stopped_.get(), &once, sizeof(once));
}

std::optional<Socket> Listener::accept(XrTime realDeadline)
{
	for (;;) {
		const XrDuration left = realDeadline - realTime();
		const timespec timeout = left > 0 ? timespec{time_t(left / second), long(left % second)} : timespec{};
		std::array<pollfd, 2> polled{pollfd{listening_.socket.fd(), POLLIN, 0}, pollfd{stopped_.get(), POLLIN, 0}};
		const int ready = ::ppoll(polled.data(), polled.size(), &timeout, nullptr);
		if (polled[1].revents != 0) return std::nullopt; // stop() was called
		if (ready == 0 || (ready > 0 && !(polled[0].revents & POLLIN)) || (ready < 0 && errno != EINTR)) return std::nullopt;
		UniqueFd fd(::accept4(listening_.socket.fd(), nullptr, nullptr, SOCK_CLOEXEC));
		if (!fd) {
			if (left <= 0) return std::nullopt;
			if (errno == EMFILE || errno == ENFILE) ::poll(nullptr, 0, 20); // out of descriptors: others must close some first
			continue;
		}
		Socket socket(std::move(fd));
		if (const Peer peer = peerOf(socket); peer.uid == ::geteuid()) return socket;
		log::warning("refused a connection from another user");
	}
}

std::optional<Socket> connectTo(const std::filesystem::path &path)
{
	const sockaddr_un address = addressOf(path);
	Socket socket = makeSocket(0);
	// A full backlog blocks connect(): bounded, as everything is.
	const timeval limit{1, 0};
	::setsockopt(socket.fd(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof(limit));
	if (::connect(socket.fd(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0) return std::nullopt;
	if (const Peer peer = peerOf(socket); peer.uid != ::geteuid())
		throw InputError("{}: the service there belongs to user {}, expected user {}", path.string(), peer.uid, ::geteuid());
	return socket;
}

} // namespace arift::ipc
