#include "runtime/ipc/launch.h"
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/ipc/listener.h"
#include "runtime/ipc/runtime_directory.h"
#include "runtime/ipc/spawn.h"
#include <cstdlib>
#include <dlfcn.h>
#include <poll.h>
#include <sstream>
#include <string_view>

namespace arift::ipc
{

namespace fs = std::filesystem;

namespace
{

bool isExecutable(const fs::path &path)
{
	std::error_code ignored;
	return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

/// The program or library this code was linked into.
fs::path ownFile()
{
	Dl_info info{};
	if (!::dladdr(reinterpret_cast<const void *>(&ownFile), &info) || !info.dli_fname) return {};
	std::error_code ignored;
	const fs::path named = fs::canonical(info.dli_fname, ignored);
	return named.empty() ? fs::canonical("/proc/self/exe", ignored) : named;
}

/// What the launched service says of itself before it listens: empty while it is starting, and when it leaves because another was faster.
class Complaint
{
public:
	explicit Complaint(UniqueFd pipe) : pipe_(std::move(pipe)) {}
	/// Waits at most `limit` for news; says whether a complaint is there.
	bool waitFor(XrDuration limit)
	{
		if (ended_) {
			::poll(nullptr, 0, int(limit / millisecond));
			return false;
		}
		pollfd polled{pipe_.get(), POLLIN, 0};
		if (::poll(&polled, 1, int(limit / millisecond)) <= 0) return false;
		std::array<char, 512> part;
		const ssize_t size = ::read(pipe_.get(), part.data(), part.size());
		if (size > 0) text_.append(part.data(), size_t(size));
		ended_ = size <= 0;
		return ended_ && !text_.empty();
	}
	const std::string &text() const { return text_; }
	/// It has left without a word.
	bool isSilent() const { return ended_ && text_.empty(); }

private:
	UniqueFd pipe_;
	std::string text_;
	bool ended_ = false;
};

/// Another was faster, or one that is dying still holds the lock: after so long (real time) without a listener it was the latter.
constexpr XrDuration fasterListens = 200 * millisecond;

Connection launchAndConnect(const fs::path &service, XrDuration limit)
{
	const XrTime deadline = realTime() + limit;
	const fs::path log = logPath();
	while (realTime() < deadline) {
		Complaint complaint(spawnDetached(service, {"--launched"}, log));
		XrDuration pause = 2 * millisecond;
		for (XrTime left = 0; realTime() < deadline;) {
			if (auto socket = connectTo(socketPath())) return {std::move(socket), {}};
			if (complaint.waitFor(pause)) return {std::nullopt, complaint.text()};
			pause = std::min(2 * pause, 50 * millisecond);
			if (complaint.isSilent() && left == 0) left = realTime();
			if (left != 0 && realTime() - left > fasterListens) break;
		}
	}
	return {std::nullopt, fmt::format("{} did not listen on {} within {:.1f} s; its log is {}", service.string(), socketPath().string(),
									  inSeconds(limit), log.string())};
}

} // namespace

std::string sandboxHint(const fs::path &root)
{
	std::error_code ignored;
	if (fs::exists(root / ".flatpak-info", ignored)) return "run this program with: flatpak run --filesystem=xdg-run/arift …";
	if (fs::exists(root / "run/pressure-vessel", ignored))
		return "set the launch option: PRESSURE_VESSEL_FILESYSTEMS_RW=$XDG_RUNTIME_DIR/arift %command%";
	const char *snap = std::getenv("SNAP_NAME");
	if (snap && *snap && std::getenv("SNAP"))
		return fmt::format("install this program so that it may leave its snap: snap install --classic {}", snap);
	return {};
}

fs::path findService()
{
	if (const char *named = std::getenv("ARIFT_SERVICE"); named && *named) return isExecutable(named) ? fs::path(named) : fs::path();
	if (const fs::path own = ownFile(); !own.empty()) {
		for (fs::path folder = own.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
			if (fs::path beside = folder / "bin/arift-service"; isExecutable(beside)) return beside;
	}
	std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "/usr/local/bin:/usr/bin");
	for (std::string folder; std::getline(path, folder, ':');)
		if (!folder.empty() && isExecutable(fs::path(folder) / "arift-service")) return fs::path(folder) / "arift-service";
	return {};
}

Connection connectToService()
{
	try {
		const fs::path path = socketPath();
		if (auto socket = connectTo(path)) return {std::move(socket), {}};
		return {std::nullopt, fmt::format("no arift-service listens on {}", path.string())};
	} catch (const std::exception &problem) {
		return {std::nullopt, problem.what()};
	}
}

Connection connectOrLaunch(XrDuration limit)
{
	try {
		if (auto socket = connectTo(socketPath())) return {std::move(socket), {}};
		if (const std::string hint = sandboxHint(); !hint.empty())
			return {std::nullopt,
					fmt::format(
						"no arift-service can be reached on {} and this program runs in a sandbox: start `arift service` outside, and {}",
						socketPath().string(), hint)};
		const fs::path service = findService();
		if (service.empty()) {
			const char *named = std::getenv("ARIFT_SERVICE");
			return {std::nullopt, named && *named ? fmt::format("ARIFT_SERVICE={} is not an executable file", named)
												  : "arift-service is neither beside this library nor on PATH"};
		}
		return launchAndConnect(service, limit);
	} catch (const std::exception &problem) {
		return {std::nullopt, problem.what()};
	}
}

} // namespace arift::ipc
