// arift-service: the program.
#include "runtime/ipc/launch.h"
#include "runtime/ipc/runtime_directory.h"
#include "runtime/service/build.h"
#include "runtime/service/overrides.h"
#include "runtime/service/service.h"
#include "runtime/service/supervisor.h"
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <malloc.h>

namespace
{

using namespace arift;

struct Arguments {
	std::string config;
	std::vector<std::string> overrides;
	double idleExit = 0; ///< seconds; 0: never, or a minute where an application or systemd started it
	bool launched = false;
};

/// The pipe to whoever launched this process; it ends the launcher's wait.
class Launcher
{
public:
	Launcher()
	{
		const char *fd = std::getenv(ipc::launchFdVariable);
		if (fd) pipe_ = UniqueFd(std::atoi(fd));
		::unsetenv(ipc::launchFdVariable);
	}
	/// Empty: nothing is wrong.
	void complain(const std::string &problem)
	{
		if (pipe_) [[maybe_unused]]
			const ssize_t written = ::write(pipe_.get(), problem.data(), problem.size());
		pipe_ = UniqueFd();
	}

private:
	UniqueFd pipe_;
};

/// Waits for SIGINT and SIGTERM on a thread of its own, which may do what a handler must not.
class SignalThread
{
public:
	static sigset_t blockSignals()
	{
		sigset_t set;
		sigemptyset(&set);
		for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) sigaddset(&set, number);
		pthread_sigmask(SIG_BLOCK, &set, nullptr);
		std::signal(SIGPIPE, SIG_IGN);
		std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of its writer
		return set;
	}
	SignalThread(const sigset_t &set, Service &service)
		: thread_([set, &service](std::stop_token stop) {
			  const timespec slice{0, 100'000'000};
			  while (!stop.stop_requested()) switch (sigtimedwait(&set, nullptr, &slice)) {
				  case -1: break;
				  case SIGXCPU: service.realtime().giveBack(); break;
				  default: service.stop();
				  }
		  })
	{
	}

private:
	std::jthread thread_;
};

/// Clients come and go, each with threads of its own and now and then a picture of megabytes: what they leave goes back to the system
/// instead of lying about in one heap per thread.
void keepMemoryTogether()
{
	::mallopt(M_ARENA_MAX, 4);
	::mallopt(M_MMAP_THRESHOLD, 1 << 20);
	::mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

int serve(const Arguments &arguments)
{
	keepMemoryTogether();
	const sigset_t signals = SignalThread::blockSignals(); // before any thread exists: all inherit it
	const auto lock = ipc::takeServiceLock(ipc::lockPath());
	if (!lock) {
		if (!arguments.launched)
			throw InputError("another arift-service is running (its lock is {}); `arift stop` ends it", ipc::lockPath().string());
		return 0; // another was faster: whoever launched this one finds that
	}
	Service::Options options{readConfig(findConfig(arguments.config), arguments.overrides, {applicationsFile(), overridesFile()}),
							 std::nullopt};
	// systemd starts it for its socket, and again when the next application comes.
	const bool autoStarted = arguments.launched || std::getenv("LISTEN_PID");
	if (arguments.idleExit > 0 || autoStarted) options.idleExit = fromSeconds(arguments.idleExit > 0 ? arguments.idleExit : 60);
	ipc::Listener listener(ipc::socketPath());
	Service service(std::move(options), listener);
	const SignalThread thread(signals, service);
	log::info("{} listens on {}", buildId, ipc::socketPath().string());
	const Service::End end = service.run();
	if (!end.problem.empty()) {
		log::error("{}", end.problem);
		return end.fault ? exitAfterFault : 1;
	}
	log::info("ends");
	return 0;
}

} // namespace

int main(int argc, char **argv)
{
	CLI::App app("The service behind ARift's OpenXR runtime: shows the world through the headset, with holograms in it.", "arift-service");
	Arguments arguments;
	app.add_option("--config", arguments.config, "configuration file instead of the user's own");
	app.add_option("--set", arguments.overrides, "KEY.PATH=VALUE above the configuration, for instance clock.mode=stepped")
		->allow_extra_args(false);
	app.add_option("--idle-exit", arguments.idleExit, "leave after so many seconds without applications")->check(CLI::Range(0.0, 1e6));
	app.add_flag("--launched", arguments.launched, "started by an application: leaves a minute after the last one");
	app.set_version_flag("--version", buildId);
	CLI11_PARSE(app, argc, argv);
	if (arguments.launched)
		if (const auto status = supervise([] { Launcher().complain({}); })) return *status;
	Launcher launcher;
	try {
		return serve(arguments);
	} catch (const std::exception &problem) {
		log::error("{}", problem.what());
		launcher.complain(problem.what());
		return 1;
	}
}
