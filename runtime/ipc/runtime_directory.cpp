#include "runtime/ipc/runtime_directory.h"
#include "runtime/base/error.h"
#include "runtime/base/user_directories.h"
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace arift::ipc
{

namespace fs = std::filesystem;

namespace
{

void requirePrivate(const fs::path &path)
{
	struct stat status {
	};
	if (::lstat(path.c_str(), &status) != 0) throw InputError("{}: {}", path.string(), std::strerror(errno));
	if (!S_ISDIR(status.st_mode)) throw InputError("{}: expected a directory, not a link or file", path.string());
	if (status.st_uid != ::geteuid())
		throw InputError("{}: belongs to user {}, expected user {}", path.string(), status.st_uid, ::geteuid());
	if (status.st_mode & 077)
		throw InputError("{}: has mode {:o}, expected 700 (chmod 700 {})", path.string(), status.st_mode & 0777, path.string());
}

bool isOwnDirectory(const fs::path &path)
{
	struct stat status {
	};
	return ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid();
}

} // namespace

fs::path runtimeDirectory()
{
	fs::path base = directoryFrom("XDG_RUNTIME_DIR");
	const std::string user = std::to_string(::geteuid());
	if (base.empty() && isOwnDirectory("/run/user/" + user)) base = "/run/user/" + user;
	const fs::path path = base.empty() ? fs::path("/tmp/arift-" + user) : base / "arift";
	if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST)
		throw InputError("{}: cannot be made: {}", path.string(), std::strerror(errno));
	requirePrivate(path);
	return path;
}

fs::path socketPath() { return runtimeDirectory() / "service.sock"; }
fs::path lockPath() { return runtimeDirectory() / "service.lock"; }

fs::path logPath()
{
	fs::path base = directoryFrom("XDG_STATE_HOME");
	if (base.empty()) base = homeDirectory() / ".local/state";
	const fs::path folder = base / "arift";
	std::error_code problem;
	fs::create_directories(folder, problem);
	if (problem) throw InputError("{}: cannot be made: {}", folder.string(), problem.message());
	return folder / "service.log";
}

} // namespace arift::ipc
