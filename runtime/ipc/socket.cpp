#include "runtime/ipc/socket.h"
#include "runtime/base/clock.h"
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>

namespace arift::ipc
{

namespace
{

/// Waits until `events` are possible. Rounds up, so that a deadline in the future never polls without sleeping.
Transfer waitFor(int fd, short events, XrTime realDeadline)
{
	for (;;) {
		const XrDuration left = realDeadline - realTime();
		timespec timeout{};
		if (left > 0) timeout = {time_t(left / second), long(left % second)};
		pollfd polled{fd, events, 0};
		const int ready = ::ppoll(&polled, 1, &timeout, nullptr);
		if (ready > 0) return polled.revents & events ? Transfer::done : Transfer::hungUp;
		if (ready < 0 && errno != EINTR) return Transfer::hungUp;
		if (ready == 0 && realTime() >= realDeadline) return Transfer::timeout;
	}
}

bool wouldBlock(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

/// Takes ownership of every descriptor the kernel handed over.
void takeFds(msghdr &header, Received &received)
{
	for (cmsghdr *control = CMSG_FIRSTHDR(&header); control; control = CMSG_NXTHDR(&header, control)) {
		if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_RIGHTS) continue;
		const size_t count = (control->cmsg_len - CMSG_LEN(0)) / sizeof(int);
		for (size_t i = 0; i < count; ++i) {
			int fd;
			std::memcpy(&fd, CMSG_DATA(control) + i * sizeof(int), sizeof(int));
			UniqueFd owned(fd);
			if (received.fdCount < maxFds) received.fds[received.fdCount++] = std::move(owned);
		}
	}
}

} // namespace

std::optional<Header> Received::header() const
{
	if (size < sizeof(Header)) return std::nullopt;
	Header found;
	std::memcpy(&found, bytes.data(), sizeof(Header));
	return found;
}

std::pair<Socket, Socket> Socket::pair()
{
	int ends[2];
	if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
		throw std::system_error(errno, std::generic_category(), "socketpair");
	return {Socket(UniqueFd(ends[0])), Socket(UniqueFd(ends[1]))};
}

Transfer Socket::send(std::span<const std::byte> bytes, std::span<const int> fds, XrTime realDeadline)
{
	if (bytes.size() > maxMessageSize || fds.size() > maxFds) return Transfer::malformed;
	iovec part{const_cast<std::byte *>(bytes.data()), bytes.size()};
	alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(maxFds * sizeof(int))> control{};
	msghdr header{};
	header.msg_iov = &part;
	header.msg_iovlen = 1;
	if (!fds.empty()) {
		header.msg_control = control.data();
		header.msg_controllen = CMSG_SPACE(fds.size_bytes());
		cmsghdr *rights = CMSG_FIRSTHDR(&header);
		rights->cmsg_level = SOL_SOCKET;
		rights->cmsg_type = SCM_RIGHTS;
		rights->cmsg_len = CMSG_LEN(fds.size_bytes());
		std::memcpy(CMSG_DATA(rights), fds.data(), fds.size_bytes());
	}
	for (;;) {
		if (::sendmsg(fd_.get(), &header, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) return Transfer::done;
		if (errno == EINTR) continue;
		if (!wouldBlock(errno)) return Transfer::hungUp;
		if (const Transfer waited = waitFor(fd_.get(), POLLOUT, realDeadline); waited != Transfer::done) return waited;
	}
}

Transfer Socket::receive(Received &received, XrTime realDeadline)
{
	received.size = 0;
	for (size_t i = 0; i < received.fdCount; ++i) UniqueFd closed = std::move(received.fds[i]);
	received.fdCount = 0;
	for (;;) {
		iovec part{received.bytes.data(), received.bytes.size()};
		alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(maxFds * sizeof(int))> control;
		msghdr header{};
		header.msg_iov = &part;
		header.msg_iovlen = 1;
		header.msg_control = control.data();
		header.msg_controllen = control.size();
		const ssize_t size = ::recvmsg(fd_.get(), &header, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
		if (size < 0 && errno == EINTR) continue;
		if (size < 0 && !wouldBlock(errno)) return Transfer::hungUp;
		if (size < 0) {
			if (const Transfer waited = waitFor(fd_.get(), POLLIN, realDeadline); waited != Transfer::done) return waited;
			continue;
		}
		takeFds(header, received);
		if (size == 0 && received.fdCount == 0) return Transfer::hungUp; // our messages are never empty
		if (header.msg_flags & MSG_TRUNC) {
			for (size_t i = 0; i < received.fdCount; ++i) UniqueFd closed = std::move(received.fds[i]);
			received.fdCount = 0;
			return Transfer::malformed;
		}
		received.size = size_t(size);
		return Transfer::done;
	}
}

void Socket::hangUp()
{
	if (fd_) ::shutdown(fd_.get(), SHUT_RDWR);
}

Peer peerOf(const Socket &socket)
{
	ucred credentials{};
	socklen_t size = sizeof(credentials);
	if (::getsockopt(socket.fd(), SOL_SOCKET, SO_PEERCRED, &credentials, &size) != 0)
		throw std::system_error(errno, std::generic_category(), "SO_PEERCRED");
	return {credentials.pid, credentials.uid};
}

} // namespace arift::ipc
