#include "runtime/openxr/service.h"
#include "runtime/ipc/launch.h"
#include "runtime/openxr/fork.h"
#include <poll.h>
#include <unistd.h>

namespace arift::openxr
{
namespace
{

/// How long the service may take to come up: it listens before it opens devices and GPU.
constexpr XrDuration launchLimit = 15 * second;

/// How long (real time) a service may hang up before its first word: one that is dying takes connections until the kernel has closed its
/// sockets, and the next to connect finds its successor.
constexpr XrDuration dyingLimit = 3 * second;
constexpr XrDuration dyingPause = 20 * millisecond;

ipc::Socket connect()
{
	watchForks();
	ipc::Connection connection = ipc::connectOrLaunch(launchLimit);
	if (!connection.socket) throw Error(XR_ERROR_RUNTIME_UNAVAILABLE, "{}", connection.problem);
	return std::move(*connection.socket);
}

/// The service's first word, checked. It may still be opening its devices.
void requireSense(const ipc::Answer<ipc::Welcome> &answer)
{
	if (!answer) {
		const bool refused = answer.how == ipc::Answered::refused;
		throw Error(refused ? XrResult(answer.failure.result) : XR_ERROR_RUNTIME_UNAVAILABLE, "arift-service: {}",
					ipc::textOf(answer.failure.text));
	}
	const ipc::Welcome &welcome = answer.reply;
	if (welcome.protocol != ipc::protocol)
		throw Error(XR_ERROR_RUNTIME_UNAVAILABLE, "arift-service speaks protocol {} (build {}), this library protocol {}", welcome.protocol,
					ipc::textOf(welcome.build), ipc::protocol);
	if (answer.fdCount < 3) throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent {} shared pages instead of 3", answer.fdCount);
	if (welcome.blendModeCount < 1 || welcome.blendModeCount > welcome.blendModes.size() || welcome.maxLayers > ipc::maxLayers)
		throw Error(XR_ERROR_RUNTIME_FAILURE, "arift-service sent {} blend modes and a limit of {} layers", welcome.blendModeCount,
					welcome.maxLayers);
}

/// CLOCK_MONOTONIC as of the last tick: a few milliseconds old, and several times cheaper.
XrTime coarseTime()
{
	timespec now{};
	::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
	return XrTime(now.tv_sec) * second + now.tv_nsec;
}

} // namespace

Service::Greeting Service::greet(const ipc::Hello &hello)
{
	for (const XrTime giveUp = realTime() + dyingLimit;; ::usleep(useconds_t(dyingPause / microsecond))) {
		Greeting greeting{std::make_unique<ipc::Requests>(connect()), {}};
		greeting.answer = greeting.requests->ask<ipc::Welcome>(hello, openingLimit);
		if (greeting.answer.how == ipc::Answered::hungUp && realTime() < giveUp) continue;
		requireSense(greeting.answer);
		return greeting;
	}
}

Service::Service(const ipc::Hello &hello) : Service(greet(hello)) {}

Service::Service(Greeting greeting)
	: requests_(std::move(greeting.requests)),
	  answer_(std::move(greeting.answer)),
	  system_(std::move(answer_.fds[0])),
	  ring_(std::move(answer_.fds[1])),
	  client_(std::move(answer_.fds[2])),
	  poses_(*ring_),
	  forkCount_(forkCount()),
	  closedInChildren_(requests_->socket().fd())
{
}

ClockAnchor Service::clock() const
{
	const ipc::ClockTable table = read(system_->clock);
	return {table.realAnchor, table.xrAnchor, table.rate};
}

bool Service::isLost() const
{
	if (lost_.load(std::memory_order_relaxed)) return true;
	if (isOfAnotherProcess()) {
		lose("it belongs to the process from which this one was forked");
		return true;
	}
	const XrTime now = coarseTime(), beat = system_->heartbeat.load(std::memory_order_relaxed);
	if (now - beat <= silenceLimit || !isSilentAgain(beat, now)) return false;
	lose("it shows no sign of life");
	return true;
}

/// When the whole machine has stood still (a virtual one that was paused, a quota that was used up), whoever wakes first finds every beat
/// old: the service is given the time to beat once more.
bool Service::isSilentAgain(XrTime beat, XrTime now) const
{
	if (suspectedBeat_.exchange(beat, std::memory_order_relaxed) != beat) suspectedSince_.store(now, std::memory_order_relaxed);
	return now - suspectedSince_.load(std::memory_order_relaxed) >= secondLook;
}

void Service::noticeHangUp(XrDuration within) const
{
	pollfd connection{.fd = requests_->socket().fd(), .events = 0, .revents = 0};
	const timespec limit{.tv_sec = time_t(within / second), .tv_nsec = long(within % second)};
	if (::ppoll(&connection, 1, &limit, nullptr) > 0 && (connection.revents & (POLLHUP | POLLERR))) lose("it has gone away");
}

void Service::lose(const char *why) const
{
	if (!lost_.exchange(true)) log::error("the connection to arift-service is lost: {}", why);
}

} // namespace arift::openxr
