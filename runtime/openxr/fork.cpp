#include "runtime/openxr/fork.h"
#include <array>
#include <atomic>
#include <fcntl.h>
#include <mutex>
#include <pthread.h>
#include <unistd.h>

namespace arift::openxr
{

constinit std::atomic<uint32_t> detail::forks{0};

namespace
{

constinit std::array<std::atomic<int>, 64> sockets{}; ///< descriptor + 1; 0 where free

/// Runs in the child alone, with one thread: only async-signal-safe calls.
void inChild()
{
	detail::forks.fetch_add(1);
	const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
	for (auto &socket : sockets)
		if (const int fd = socket.load() - 1; fd >= 0 && nothing >= 0) ::dup3(nothing, fd, O_CLOEXEC);
	if (nothing >= 0) ::close(nothing);
}

} // namespace

void watchForks()
{
	static std::once_flag once;
	std::call_once(once, [] { ::pthread_atfork(nullptr, nullptr, inChild); });
}

ClosedInChildren::ClosedInChildren(int fd)
{
	for (size_t i = 0; i < sockets.size(); ++i) {
		int expected = 0;
		if (!sockets[i].compare_exchange_strong(expected, fd + 1)) continue;
		slot_ = int(i);
		return;
	}
}

ClosedInChildren::~ClosedInChildren()
{
	if (slot_ >= 0) sockets[size_t(slot_)] = 0;
}

} // namespace arift::openxr
