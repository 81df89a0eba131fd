// A process that forks leaves its child a copy of everything but the threads, and a second hold on every socket.
#pragma once
#include <atomic>
#include <cstdint>

namespace arift::openxr
{

/// From the first call on forks are counted. The C library forgets the handler when this library is unloaded.
void watchForks();

namespace detail
{
extern std::atomic<uint32_t> forks;
}

/// Forks that lie between this process and the one in which the library was first used. An object made at another count belongs to the
/// parent: its threads do not exist here and its connection is not this process's to use.
inline uint32_t forkCount() { return detail::forks.load(std::memory_order_relaxed); }

/// While it lives, `fd` is replaced in forked children by a descriptor of nothing, so that the service notices when the parent dies.
class ClosedInChildren
{
public:
	explicit ClosedInChildren(int fd);
	~ClosedInChildren();
	ClosedInChildren(const ClosedInChildren &) = delete;

private:
	int slot_ = -1;
};

} // namespace arift::openxr
