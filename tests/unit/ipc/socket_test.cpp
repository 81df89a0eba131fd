#include "runtime/base/clock.h"
#include "runtime/ipc/request.h"
#include "runtime/ipc/socket.h"
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <thread>

using namespace arift;
using namespace arift::ipc;

namespace
{

constexpr XrDuration soon = 20 * millisecond, plenty = 10 * second;

XrTime in(XrDuration limit) { return realTime() + limit; }

UniqueFd anyFd() { return UniqueFd(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

/// How many descriptors this process has open.
int openDescriptors()
{
	int count = 0;
	for (int fd = 0; fd < 1024; ++fd)
		if (::fcntl(fd, F_GETFD) >= 0) ++count;
	return count;
}

} // namespace

TEST(Socket, CarriesAMessageWhole)
{
	auto [a, b] = Socket::pair();
	WaitFrame sent;
	sent.header.sequence = 77;
	ASSERT_EQ(a.send(sent, in(plenty)), Transfer::done);
	Received received;
	ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done);
	const auto message = received.as<WaitFrame>();
	ASSERT_TRUE(message);
	EXPECT_EQ(message->header.sequence, 77u);
	EXPECT_FALSE(received.as<FrameReady>()) << "another type";
}

TEST(Socket, ASubmissionTravelsWithItsLayersOnly)
{
	auto [a, b] = Socket::pair();
	Submission submission;
	submission.layerCount = 2;
	ASSERT_EQ(a.send(submission, in(plenty)), Transfer::done);
	Received received;
	ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done);
	EXPECT_EQ(received.size, offsetof(Submission, layers) + 2 * sizeof(Layer));
}

TEST(Socket, DescriptorsArriveOpenAndCloseOnExec)
{
	auto [a, b] = Socket::pair();
	const UniqueFd file = anyFd();
	const std::array fds{file.get(), file.get()};
	ASSERT_EQ(a.send(Done{}, fds, in(plenty)), Transfer::done);
	Received received;
	ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done);
	ASSERT_EQ(received.fdCount, 2u);
	EXPECT_EQ(::fcntl(received.fds[1].get(), F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
}

TEST(Socket, DescriptorsNobodyTakesAreClosed)
{
	auto [a, b] = Socket::pair();
	const UniqueFd file = anyFd();
	const std::vector<int> fds(maxFds, file.get());
	const int before = openDescriptors();
	{
		Received received;
		ASSERT_EQ(a.send(Done{}, fds, in(plenty)), Transfer::done);
		ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done);
		EXPECT_EQ(openDescriptors(), before + int(maxFds));
		ASSERT_EQ(a.send(Done{}, in(plenty)), Transfer::done);
		ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done); // the next message takes the place of the last
		EXPECT_EQ(received.fdCount, 0u);
		EXPECT_EQ(openDescriptors(), before);
	}
	EXPECT_EQ(openDescriptors(), before);
}

TEST(Socket, MoreDescriptorsThanAllowedAreClosed)
{
	auto [a, b] = Socket::pair();
	const UniqueFd file = anyFd();
	constexpr size_t sent = maxFds + 8;
	const int before = openDescriptors();
	// Sent past our own limit, as only a hostile peer does.
	alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sent * sizeof(int))> control{};
	Done done;
	iovec part{&done, sizeof(done)};
	msghdr header{};
	header.msg_iov = &part;
	header.msg_iovlen = 1;
	header.msg_control = control.data();
	header.msg_controllen = control.size();
	cmsghdr *rights = CMSG_FIRSTHDR(&header);
	rights->cmsg_level = SOL_SOCKET;
	rights->cmsg_type = SCM_RIGHTS;
	rights->cmsg_len = CMSG_LEN(sent * sizeof(int));
	const std::vector<int> fds(sent, file.get());
	std::memcpy(CMSG_DATA(rights), fds.data(), sent * sizeof(int));
	ASSERT_GE(::sendmsg(a.fd(), &header, 0), 0);
	{
		Received received;
		ASSERT_EQ(b.receive(received, in(plenty)), Transfer::done);
		EXPECT_LE(received.fdCount, size_t(maxFds));
	}
	EXPECT_EQ(openDescriptors(), before);
}

TEST(Socket, AMessageTooLongIsMalformedAndGone)
{
	auto [a, b] = Socket::pair();
	const std::vector<std::byte> tooLong(maxMessageSize + 1);
	EXPECT_EQ(a.send(tooLong, {}, in(plenty)), Transfer::malformed);
	ASSERT_GE(::send(a.fd(), tooLong.data(), tooLong.size(), 0), 0);
	Received received;
	EXPECT_EQ(b.receive(received, in(plenty)), Transfer::malformed);
	ASSERT_EQ(a.send(Done{}, in(plenty)), Transfer::done);
	EXPECT_EQ(b.receive(received, in(plenty)), Transfer::done);
	EXPECT_TRUE(received.as<Done>());
}

TEST(Socket, WaitsEndAtTheirDeadline)
{
	auto [a, b] = Socket::pair();
	Received received;
	const XrTime begin = realTime();
	EXPECT_EQ(b.receive(received, begin + soon), Transfer::timeout);
	EXPECT_GE(realTime() - begin, soon);
	// A peer that does not read: the socket's buffer fills up.
	Transfer sent = Transfer::done;
	for (int i = 0; i < 100'000 && sent == Transfer::done; ++i) sent = a.send(Submission{}, in(soon));
	EXPECT_EQ(sent, Transfer::timeout);
}

TEST(Socket, APeerThatHangsUpIsNoticed)
{
	auto [a, b] = Socket::pair();
	ASSERT_EQ(a.send(Done{}, in(plenty)), Transfer::done);
	{
		Socket gone = std::move(a);
	}
	Received received;
	EXPECT_EQ(b.receive(received, in(plenty)), Transfer::done) << "what was sent before still arrives";
	EXPECT_EQ(b.receive(received, in(plenty)), Transfer::hungUp);
	EXPECT_EQ(b.send(Done{}, in(plenty)), Transfer::hungUp);
}

TEST(Socket, HangUpEndsAWaitInAnotherThread)
{
	auto ends = Socket::pair();
	Socket &b = ends.second;
	Transfer outcome = Transfer::done;
	std::thread waiting([&] {
		Received received;
		outcome = b.receive(received, in(plenty));
	});
	b.hangUp();
	waiting.join();
	EXPECT_EQ(outcome, Transfer::hungUp);
}

namespace
{

/// Answers requests as told, on its own thread.
class FakeService
{
public:
	template <typename Serve> FakeService(Socket socket, Serve serve)
		: socket_(std::move(socket)), thread_([this, serve] { serve(socket_); })
	{
	}
	~FakeService() { thread_.join(); }

private:
	Socket socket_;
	std::thread thread_;
};

template <typename M> void answer(Socket &socket, M message, uint32_t sequence)
{
	message.header.sequence = sequence;
	socket.send(message, in(plenty));
}

} // namespace

TEST(Requests, AReplyIsTheOneOfItsRequest)
{
	auto [a, b] = Socket::pair();
	Requests requests(std::move(a));
	FakeService service(std::move(b), [](Socket &socket) {
		Received received;
		socket.receive(received, in(plenty));
		const uint32_t sequence = received.header()->sequence;
		answer(socket, Done{}, sequence - 1); // late, for a request that has given up
		SessionCreated created;
		created.session = 5;
		answer(socket, created, sequence);
	});
	const auto reply = requests.ask<SessionCreated>(CreateSession{}, plenty);
	ASSERT_TRUE(reply);
	EXPECT_EQ(reply.reply.session, 5u);
}

TEST(Requests, ARefusalCarriesResultAndSentence)
{
	auto [a, b] = Socket::pair();
	Requests requests(std::move(a));
	FakeService service(std::move(b), [](Socket &socket) {
		Received received;
		socket.receive(received, in(plenty));
		Failed failed;
		failed.result = XR_ERROR_LIMIT_REACHED;
		copyText(failed.text, "one session at a time");
		answer(socket, failed, received.header()->sequence);
	});
	const auto reply = requests.ask<SessionCreated>(CreateSession{}, plenty);
	EXPECT_EQ(reply.how, Answered::refused);
	EXPECT_EQ(reply.failure.result, XR_ERROR_LIMIT_REACHED);
	EXPECT_EQ(textOf(reply.failure.text), "one session at a time");
}

TEST(Requests, SilenceAndDeathAreDifferent)
{
	auto [a, b] = Socket::pair();
	Requests requests(std::move(a));
	EXPECT_EQ(requests.ask<Done>(Recenter{}, soon).how, Answered::timeout);
	b.hangUp();
	EXPECT_EQ(requests.ask<Done>(Recenter{}, plenty).how, Answered::hungUp);
}

TEST(Texts, AreCutAndTerminated)
{
	char field[8];
	copyText(field, "longer than that");
	EXPECT_EQ(textOf(field), "longer ");
	std::memset(field, 'x', sizeof(field));
	EXPECT_EQ(textOf(field), "xxxxxxxx") << "a peer that forgets the end";
}
