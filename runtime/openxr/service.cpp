#include "runtime/openxr/service.h"
#include "runtime/ipc/launch.h"
#include "runtime/openxr/fork.h"
#include <poll.h>

namespace arift::openxr
{
namespace
{

/// How long the service may take to come up: it listens before it opens devices and GPU.
constexpr XrDuration launchLimit = 15 * second;

ipc::Socket connect()
{
	watchForks();
	ipc::Connection connection = ipc::connectOrLaunch(launchLimit);
	if (!connection.socket) throw Error(XR_ERROR_RUNTIME_UNAVAILABLE, "{}", connection.problem);
	return std::move(*connection.socket);
}

/// The service's first word. It may still be opening its devices.
ipc::Answer<ipc::Welcome> greet(ipc::Requests &requests, const ipc::Hello &hello)
{
	auto answer = requests.ask<ipc::Welcome>(hello, Service::openingLimit);
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
	return answer;
}

/// CLOCK_MONOTONIC as of the last tick: a few milliseconds old, and several times cheaper.
XrTime coarseTime()
{
	timespec now{};
	::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
	return XrTime(now.tv_sec) * second + now.tv_nsec;
}

std::unique_ptr<ipc::Requests> requestsOver(ipc::Socket socket) { return std::make_unique<ipc::Requests>(std::move(socket)); }

} // namespace

Service::Service(const ipc::Hello &hello) : Service(hello, connect()) {}

Service::Service(const ipc::Hello &hello, ipc::Socket socket)
	: requests_(requestsOver(std::move(socket))),
	  answer_(greet(*requests_, hello)),
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
