// One end of a SOCK_SEQPACKET connection: whole messages with file descriptors, every wait bounded in real time.
#pragma once
#include "runtime/base/unique_fd.h"
#include "runtime/base/xr.h"
#include "runtime/ipc/messages.h"
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace arift::ipc
{

/// How a bounded transfer ended. All four are expected: none is an exception.
enum class Transfer {
	done,
	timeout,  ///< the real-time deadline came first; nothing was transferred
	hungUp,   ///< the peer is gone, or hangUp() was called on this end
	malformed ///< a message longer than any of ours; it was dropped whole and its descriptors closed
};

constexpr size_t maxMessageSize = 32768;
static_assert(sizeof(Submission) <= maxMessageSize);

/// A message as it came, with the descriptors it carried. Descriptors nobody takes are closed with it.
struct Received {
	alignas(8) std::array<std::byte, maxMessageSize> bytes;
	size_t size = 0;
	std::array<UniqueFd, maxFds> fds;
	size_t fdCount = 0;

	/// Type and sequence; nothing where the message is too short to have them.
	std::optional<Header> header() const;
	/// The message as an M; nothing where type or size say it is none.
	template <typename M> std::optional<M> as() const
	{
		const auto found = header();
		if (!found || found->type != M::type || size != sizeof(M)) return std::nullopt;
		M message;
		std::memcpy(static_cast<void *>(&message), bytes.data(), sizeof(M));
		return message;
	}
};

/// A struct of messages.h: its bytes are what travels. (A container of bytes is none: its own bytes are pointers.)
template <typename M>
concept WireMessage = std::is_trivially_copyable_v<M> && requires(M message)
{
	{
		M::type
		} -> std::convertible_to<MessageType>;
	{
		message.header
		} -> std::convertible_to<Header>;
};

/// Bytes of a message that travel: all of it, except layers a Submission does not use.
template <typename M> size_t wireSize(const M &) { return sizeof(M); }
inline size_t wireSize(const Submission &submission) { return offsetof(Submission, layers) + submission.layerCount * sizeof(Layer); }

/// Thread-safe: messages are whole, so one thread may send while another receives. hangUp() ends both.
class Socket
{
public:
	explicit Socket(UniqueFd fd) : fd_(std::move(fd)) {}
	/// Two connected ends in this process; either may be sent elsewhere.
	static std::pair<Socket, Socket> pair();

	/// Sends bytes and duplicates of `fds` (at most maxFds) as one message, or nothing at all.
	Transfer send(std::span<const std::byte> bytes, std::span<const int> fds, XrTime realDeadline);
	template <WireMessage M> Transfer send(const M &message, std::span<const int> fds, XrTime realDeadline)
	{
		return send({reinterpret_cast<const std::byte *>(&message), wireSize(message)}, fds, realDeadline);
	}
	template <WireMessage M> Transfer send(const M &message, XrTime realDeadline)
	{
		return send(message, std::span<const int>{}, realDeadline);
	}
	/// Receives the next message.
	Transfer receive(Received &received, XrTime realDeadline);

	/// Ends the connection now: whoever waits on it, on either side, is told.
	void hangUp();
	int fd() const { return fd_.get(); }
	/// Gives up ownership, for instance to send this end to another process.
	UniqueFd take() { return std::move(fd_); }

private:
	UniqueFd fd_;
};

/// The process and user at the other end (SO_PEERCRED). Throws std::system_error where the kernel does not say.
struct Peer {
	int pid = 0;
	unsigned uid = 0;
};
Peer peerOf(const Socket &socket);

} // namespace arift::ipc
