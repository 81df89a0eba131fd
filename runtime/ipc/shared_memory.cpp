#include "runtime/ipc/shared_memory.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>

#ifndef F_SEAL_FUTURE_WRITE
#define F_SEAL_FUTURE_WRITE 0x0010 // Linux 5.1; glibc names it only with _GNU_SOURCE and new headers
#endif

namespace arift::ipc
{

namespace
{

[[noreturn]] void fail(const char *what) { throw std::system_error(errno, std::generic_category(), what); }

void seal(int fd, int seals)
{
	if (::fcntl(fd, F_ADD_SEALS, seals) != 0) fail("sealing shared memory");
}

Mapping map(int fd, size_t size, int protection)
{
	void *address = ::mmap(nullptr, size, protection, MAP_SHARED, fd, 0);
	if (address == MAP_FAILED) fail("mapping shared memory");
	return {address, size};
}

} // namespace

Mapping::~Mapping()
{
	if (address_) ::munmap(address_, size_);
}

UniqueFd makeSharedMemory(const char *name, size_t size)
{
	UniqueFd fd(::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING));
	if (!fd) fail("memfd_create");
	if (::ftruncate(fd.get(), off_t(size)) != 0) fail("sizing shared memory");
	seal(fd.get(), F_SEAL_SHRINK | F_SEAL_GROW);
	return fd;
}

void sealAgainstWriting(int fd) { seal(fd, F_SEAL_FUTURE_WRITE | F_SEAL_SEAL); }

Mapping mapWritable(int fd, size_t size) { return map(fd, size, PROT_READ | PROT_WRITE); }

Mapping mapReadOnly(int fd, size_t size)
{
	struct stat status {
	};
	if (::fstat(fd, &status) != 0) fail("shared memory");
	if (status.st_size < off_t(size)) throw std::runtime_error("shared memory is smaller than the page it should hold");
	const int seals = ::fcntl(fd, F_GET_SEALS);
	if (seals < 0 || !(seals & F_SEAL_SHRINK)) throw std::runtime_error("shared memory is not sealed against shrinking");
	return map(fd, size, PROT_READ);
}

UniqueFd makeSealedCopy(const char *name, std::span<const std::byte> bytes)
{
	UniqueFd fd = makeSharedMemory(name, bytes.size());
	if (!bytes.empty()) {
		const Mapping mapping = mapWritable(fd.get(), bytes.size());
		std::memcpy(mapping.address(), bytes.data(), bytes.size());
	}
	seal(fd.get(), F_SEAL_WRITE | F_SEAL_SEAL);
	return fd;
}

} // namespace arift::ipc
