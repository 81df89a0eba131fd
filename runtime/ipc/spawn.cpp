#include "runtime/ipc/spawn.h"
#include "runtime/ipc/launch.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>

extern "C" char **environ;

namespace arift::ipc
{

namespace
{

constexpr int launchFd = 3;

/// Everything the child needs, prepared before fork(): after it only async-signal-safe calls are allowed.
struct Prepared {
	std::vector<std::string> texts;
	std::vector<char *> arguments, environment;
};

Prepared prepare(const std::filesystem::path &program, const std::vector<std::string> &arguments)
{
	Prepared prepared;
	prepared.texts.push_back(program.string());
	prepared.texts.insert(prepared.texts.end(), arguments.begin(), arguments.end());
	const size_t argumentCount = prepared.texts.size();
	for (char **variable = environ; variable && *variable; ++variable)
		if (passesToService(*variable)) prepared.texts.emplace_back(*variable);
	prepared.texts.push_back(std::string(launchFdVariable) + "=" + std::to_string(launchFd));
	for (size_t i = 0; i < prepared.texts.size(); ++i)
		(i < argumentCount ? prepared.arguments : prepared.environment).push_back(prepared.texts[i].data());
	prepared.arguments.push_back(nullptr);
	prepared.environment.push_back(nullptr);
	return prepared;
}

void closeFrom(int first)
{
#ifdef SYS_close_range
	if (::syscall(SYS_close_range, unsigned(first), ~0u, 0u) == 0) return;
#endif
	for (int fd = first; fd < 65536; ++fd) ::close(fd);
}

void restoreSignals()
{
	for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
	sigset_t none;
	sigemptyset(&none);
	::sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void becomeService(const Prepared &prepared, int launchPipe, int log)
{
	restoreSignals();
	// Above the descriptors that are about to be overwritten, so that no dup2 destroys what a later one needs.
	const int pipe = ::fcntl(launchPipe, F_DUPFD, 10), output = ::fcntl(log, F_DUPFD, 10), input = ::open("/dev/null", O_RDONLY);
	if (input > 0) ::dup2(input, 0);
	::dup2(output, 1);
	::dup2(output, 2);
	::dup2(pipe, launchFd);
	closeFrom(launchFd + 1);
	if (::chdir("/") == 0) ::execve(prepared.arguments[0], prepared.arguments.data(), prepared.environment.data());
	constexpr std::string_view text = "arift-service could not be executed";
	[[maybe_unused]] const ssize_t written = ::write(launchFd, text.data(), text.size());
	::_exit(127);
}

} // namespace

bool passesToService(std::string_view variable)
{
	constexpr std::array prefixes{"XDG_",           "ARIFT_", "LC_",    "MESA_", "LIBGL_",  "LP_",   "GALLIUM_", "VK_ICD_", "VK_DRIVER_",
								  "VK_ADD_DRIVER_", "DRI_",   "__GLX_", "__NV_", "NVIDIA_", "ASAN_", "UBSAN_",   "TSAN_",   "LSAN_"};
	constexpr std::array names{"HOME", "PATH",   "USER",    "LOGNAME",         "LANG",       "LANGUAGE",
							   "TZ",   "TMPDIR", "DISPLAY", "WAYLAND_DISPLAY", "XAUTHORITY", "DBUS_SESSION_BUS_ADDRESS"};
	const std::string_view name = variable.substr(0, variable.find('='));
	if (name == launchFdVariable) return false;
	return std::ranges::any_of(prefixes, [&](std::string_view prefix) { return name.starts_with(prefix); }) ||
		   std::ranges::any_of(names, [&](std::string_view known) { return name == known; });
}

UniqueFd spawnDetached(const std::filesystem::path &program, const std::vector<std::string> &arguments, const std::filesystem::path &log)
{
	const Prepared prepared = prepare(program, arguments);
	UniqueFd output(::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
	if (!output) throw std::system_error(errno, std::generic_category(), log.string());
	int ends[2];
	if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
	UniqueFd reading(ends[0]), writing(ends[1]);
	const pid_t child = ::fork();
	if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
	if (child == 0) {
		::setsid();
		if (::fork() == 0) becomeService(prepared, writing.get(), output.get());
		::_exit(0);
	}
	int status = 0;
	while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {} // ECHILD where the host ignores SIGCHLD
	return reading;
}

} // namespace arift::ipc
