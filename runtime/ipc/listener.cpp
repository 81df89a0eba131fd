#include "runtime/ipc/listener.h"
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>

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

Socket listenOn(const std::filesystem::path &path)
{
	const sockaddr_un address = addressOf(path);
	Socket socket = makeSocket(SOCK_NONBLOCK);
	::unlink(path.c_str());
	if (::bind(socket.fd(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0 || ::listen(socket.fd(), 64) != 0)
		throw InputError("{}: cannot listen: {}", path.string(), std::strerror(errno));
	return socket;
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

Listener::Listener(const std::filesystem::path &path) : path_(path), socket_(listenOn(path)) {}

Listener::~Listener() { ::unlink(path_.c_str()); }

std::optional<Socket> Listener::accept(XrTime realDeadline)
{
	for (;;) {
		const XrDuration left = realDeadline - realTime();
		const timespec timeout = left > 0 ? timespec{time_t(left / second), long(left % second)} : timespec{};
		pollfd polled{socket_.fd(), POLLIN, 0};
		const int ready = ::ppoll(&polled, 1, &timeout, nullptr);
		if (ready == 0 || (ready > 0 && !(polled.revents & POLLIN)) || (ready < 0 && errno != EINTR)) return std::nullopt;
		UniqueFd fd(::accept4(socket_.fd(), nullptr, nullptr, SOCK_CLOEXEC));
		if (!fd && errno == EINVAL) return std::nullopt; // stop() was called
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
