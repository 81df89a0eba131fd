// Requests and their replies over one connection: typed, numbered, bounded in time.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/ipc/socket.h"
#include <algorithm>
#include <functional>
#include <mutex>
#include <string>

namespace arift::ipc
{

enum class Answered { yes, refused /**< the service replied Failed */, timeout, hungUp };

template <typename Reply> struct Answer {
	Answered how = Answered::hungUp;
	Reply reply;    ///< where how == yes
	Failed failure; ///< otherwise: XrResult and a sentence
	std::array<UniqueFd, maxFds> fds;
	size_t fdCount = 0;
	explicit operator bool() const { return how == Answered::yes; }
};

/// A text of at most size - 1 bytes, always terminated.
template <size_t size> void copyText(char (&to)[size], std::string_view text)
{
	const size_t length = text.size() < size - 1 ? text.size() : size - 1;
	std::memcpy(to, text.data(), length);
	std::memset(to + length, 0, size - length);
}
/// The text in a fixed field that another process filled: ends at the first NUL or at the field's end.
template <size_t size> std::string textOf(const char (&from)[size]) { return std::string(from, ::strnlen(from, size)); }

/// Thread-safe: one request at a time, others wait for it (each request is bounded).
class Requests
{
public:
	explicit Requests(Socket socket) : socket_(std::move(socket)) {}

	/// Sends `request` with a new sequence number and waits until its reply is there, at most `limit` of real time.
	/// A reply that comes after its request has timed out is dropped when it comes. `isWorthWaiting` is asked now and then meanwhile: false
	/// is a time-out at once.
	template <typename Reply, typename Request>
	Answer<Reply> ask(Request request, XrDuration limit, std::span<const int> fds = {}, const std::function<bool()> &isWorthWaiting = {})
	{
		const XrTime deadline = realTime() + limit;
		const std::lock_guard lock(mutex_); // whoever has it waits for a limited time too
		request.header.sequence = ++sequence_;
		Answer<Reply> answer;
		Received received;
		Transfer transfer = socket_.send(request, fds, deadline);
		while (transfer == Transfer::done) {
			do transfer = socket_.receive(received, std::min(deadline, realTime() + lookAround));
			while (transfer == Transfer::timeout && realTime() < deadline && (!isWorthWaiting || isWorthWaiting()));
			if (transfer != Transfer::done) break;
			const auto header = received.header();
			if (!header || header->sequence != sequence_) continue;
			if (const auto reply = received.as<Reply>()) {
				answer.how = Answered::yes;
				answer.reply = *reply;
				answer.fds = std::move(received.fds);
				answer.fdCount = received.fdCount;
			} else if (const auto failed = received.as<Failed>()) {
				answer.how = Answered::refused;
				answer.failure = *failed;
			} else {
				copyText(answer.failure.text, "the service sent a reply of the wrong kind");
			}
			return answer;
		}
		answer.how = transfer == Transfer::timeout ? Answered::timeout : Answered::hungUp;
		answer.failure.result = XR_ERROR_RUNTIME_FAILURE;
		copyText(answer.failure.text, transfer == Transfer::timeout ? "the service did not answer in time" : "the service has gone away");
		return answer;
	}
	/// As above for requests that are answered without content.
	template <typename Request> Answer<Done> command(Request request, XrDuration limit) { return ask<Done>(request, limit); }

	/// For noticing that the service has gone: readable or hung up means so between requests.
	const Socket &socket() const { return socket_; }
	void hangUp() { socket_.hangUp(); }

private:
	static constexpr XrDuration lookAround = 100 * millisecond; ///< real time
	std::mutex mutex_;
	Socket socket_;
	uint32_t sequence_ = 0;
};

} // namespace arift::ipc
