#include "drivers/evdev/devices.h"
#include "runtime/base/log.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <system_error>

namespace arift::evdev
{
namespace
{

/// More are nobody's.
constexpr size_t mostDevices = 32;
/// How often to look (real time) where the folder of devices cannot be watched, for it is not there.
constexpr XrDuration lookAgain = second;

UniqueFd checked(int fd, const char *what)
{
	if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
	return UniqueFd(fd);
}

} // namespace

Devices::Devices(InputPlaces places, std::vector<std::string> wanted)
	: places_(std::move(places)),
	  wanted_(std::move(wanted)),
	  notices_(checked(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC), "inotify")),
	  woken_(checked(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd"))
{
}

void Devices::wake()
{
	const uint64_t once = 1;
	[[maybe_unused]] const ssize_t written = ::write(woken_.get(), &once, sizeof(once));
}

/// Rights come after the node: udev grants them to whoever sits before the machine.
void Devices::watch()
{
	if (watch_ >= 0) return;
	constexpr uint32_t changes = IN_CREATE | IN_DELETE | IN_ATTRIB | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE_SELF | IN_MOVE_SELF;
	watch_ = ::inotify_add_watch(notices_.get(), places_.devices.c_str(), changes);
}

void Devices::unwatch()
{
	::inotify_rm_watch(notices_.get(), watch_); // the kernel has forgotten it already where the folder is gone
	watch_ = -1;
}

/// Whatever changed, the folder is looked through. One that was removed, unmounted or moved away is watched no more, though another may
/// stand in its place already.
void Devices::takeNotices()
{
	isStale_ = true;
	alignas(inotify_event) std::array<char, 4096> notices;
	for (ssize_t size; (size = ::read(notices_.get(), notices.data(), notices.size())) > 0;)
		for (ssize_t at = 0; at < size;) {
			inotify_event notice;
			std::memcpy(&notice, notices.data() + at, sizeof(notice));
			at += ssize_t(sizeof(notice) + notice.len);
			if (notice.wd == watch_ && (notice.mask & (IN_IGNORED | IN_MOVE_SELF))) unwatch();
		}
}

void Devices::open(const Node &node)
{
	try {
		opened_.push_back({next_, node, Device(node)});
		complaints_.erase(node.id);
	} catch (const std::exception &problem) {
		std::string &said = complaints_[node.id];
		if (said != problem.what()) log::warning("input: {}", problem.what());
		said = problem.what();
		return;
	}
	log::info("input: {} is read ({})", node.name, node.id);
	comings_.push_back({.device = next_++, .kind = node.kind, .keys = {}, .gamepad = opened_.back().device.gamepad()});
}

void Devices::close(std::vector<Opened>::iterator opened)
{
	log::info("input: {} is gone ({})", opened->node.name, opened->node.id);
	comings_.push_back({.device = opened->number, .kind = opened->node.kind, .isThere = false, .keys = {}, .gamepad = {}});
	opened_.erase(opened);
	isStale_ = true; // another may have come in its place
}

void Devices::scan()
{
	isStale_ = false;
	watch(); // first: what comes from here on is noticed
	const std::vector<Node> nodes = findNodes(places_);
	std::erase_if(complaints_,
				  [&](const auto &entry) { return std::ranges::none_of(nodes, [&](const Node &node) { return node.id == entry.first; }); });
	for (const Node &node : nodes) {
		const bool isOpen = std::ranges::any_of(opened_, [&](const Opened &opened) { return opened.node.id == node.id; });
		if (!isOpen && isWanted(node, wanted_) && opened_.size() < mostDevices) open(node);
	}
}

/// Whether somebody had something to say.
bool Devices::readOpened(InputReport &report)
{
	for (auto opened = opened_.begin(); opened != opened_.end(); ++opened) {
		report = {.device = opened->number, .kind = opened->node.kind, .keys = {}, .gamepad = {}};
		const Outcome outcome = opened->device.read(report);
		if (outcome == Outcome::ready) return true;
		if (outcome == Outcome::timeout) continue;
		close(opened);
		return false;
	}
	return false;
}

/// Until something happens; false where nothing does but wake() until `deadline`.
bool Devices::sleep(XrTime deadline)
{
	std::vector<pollfd> polled{{notices_.get(), POLLIN, 0}, {woken_.get(), POLLIN, 0}};
	for (const Opened &opened : opened_) polled.push_back({opened.device.fd(), POLLIN, 0});
	const XrTime until = watch_ >= 0 ? deadline : std::min(deadline, realTime() + lookAgain);
	const XrDuration rest = std::max<XrDuration>(until - realTime(), 0);
	const timespec limit{.tv_sec = time_t(rest / second), .tv_nsec = long(rest % second)};
	if (::ppoll(polled.data(), polled.size(), &limit, nullptr) < 0 && errno != EINTR)
		throw std::system_error(errno, std::generic_category(), "poll");
	if (polled[0].revents || watch_ < 0) takeNotices();
	if (watch_ >= 0 && !std::filesystem::exists(places_.devices)) unwatch(); // removed, and held open by somebody
	for (size_t i = polled.size(); i-- > 2;) // a device that is pulled out says so for ever and gives nothing to read
		if (polled[i].revents & (POLLHUP | POLLERR | POLLNVAL)) close(opened_.begin() + ptrdiff_t(i - 2));
	if (!polled[1].revents) return realTime() < deadline;
	uint64_t times = 0; // that it was woken
	[[maybe_unused]] const ssize_t taken = ::read(woken_.get(), &times, sizeof(times));
	return false;
}

Outcome Devices::read(InputReport &report, XrTime deadline)
{
	do {
		if (isStale_) scan();
		if (!comings_.empty()) {
			report = std::move(comings_.front());
			comings_.pop_front();
			return Outcome::ready;
		}
		if (readOpened(report)) return Outcome::ready;
	} while (!comings_.empty() || sleep(deadline));
	return Outcome::timeout;
}

void Devices::rumble(uint32_t device, const Rumble &rumble)
{
	for (Opened &opened : opened_)
		if (opened.number == device) opened.device.rumble(rumble);
}

} // namespace arift::evdev
