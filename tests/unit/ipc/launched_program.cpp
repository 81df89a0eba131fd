// Stands in for arift-service in the tests of launching: takes the lock, says what it has of its host, listens until it is told to stop.
#include "runtime/base/clock.h"
#include "runtime/ipc/launch.h"
#include "runtime/ipc/listener.h"
#include "runtime/ipc/runtime_directory.h"
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <list>
#include <string>
#include <unistd.h>

using namespace arift;
using namespace arift::ipc;

namespace
{

int blockedSignals()
{
	sigset_t set;
	::sigprocmask(SIG_SETMASK, nullptr, &set);
	int count = 0;
	for (int number = 1; number < 32; ++number) count += sigismember(&set, number) == 1;
	return count;
}

/// Counted before anything is opened here.
int descriptorsBeyond(int first)
{
	int count = 0;
	for (int fd = first; fd < 1024; ++fd) count += ::fcntl(fd, F_GETFD) >= 0;
	return count;
}

void sayWhatIsThere(int descriptors)
{
	const pid_t session = ::getsid(0), parent = ::getppid();
	std::ofstream list(std::getenv("ARIFT_TEST_LIST"), std::ios::app);
	list << "listens cwd=" << std::filesystem::current_path().string() << " own-session=" << (session != 0 && session != ::getsid(parent))
		 << " descriptors=" << descriptors << " blocked=" << blockedSignals()
		 << " host-variables=" << (std::getenv("LD_PRELOAD_OF_THE_HOST") != nullptr) << std::endl;
}

} // namespace

int main()
{
	const int descriptors = descriptorsBeyond(4);
	if (const char *complaint = std::getenv("ARIFT_TEST_COMPLAINT")) {
		const std::string text = complaint;
		return ::write(std::atoi(std::getenv(launchFdVariable)), text.data(), text.size()) < 0;
	}
	const auto lock = takeServiceLock(lockPath());
	if (!lock) return 0;
	sayWhatIsThere(descriptors);
	Listener listener(socketPath());
	std::list<Socket> clients;
	for (const XrTime end = realTime() + 30 * second; realTime() < end;) {
		if (auto client = listener.accept(realTime() + 5 * millisecond)) clients.push_back(std::move(*client));
		for (Socket &client : clients) {
			Received received;
			if (client.receive(received, 0) != Transfer::done || !received.as<ShutDown>()) continue;
			Done done;
			done.header.sequence = received.header()->sequence;
			client.send(done, realTime() + second);
			return 0;
		}
	}
	return 1;
}
