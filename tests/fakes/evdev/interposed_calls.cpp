// open(), access() and ioctl() of a program under test: on the nodes of fake devices of input (sockets) as the kernel answers for a real
// one, on everything else the kernel itself. What the program tells its device's motors goes to the test through the socket.
#include "tests/fakes/evdev/fake_state.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

namespace
{

using arift::fake::InputState;

/// By descriptor. Mappings stay until the program ends.
std::array<std::atomic<const InputState *>, 1024> states{};
/// Whether an effect was uploaded: there is room for one.
std::array<std::atomic<bool>, 1024> effects{};

int failed(int code)
{
	errno = code;
	return -1;
}

int openDirectly(const char *path, int flags, mode_t mode) { return int(::syscall(SYS_openat, AT_FDCWD, path, flags, mode)); }

bool isNode(const char *path, struct stat &status) { return ::stat(path, &status) == 0 && S_ISSOCK(status.st_mode); }

const InputState *stateOf(const char *path)
{
	const int file = openDirectly((std::string(path) + arift::fake::stateEnding).c_str(), O_RDONLY | O_CLOEXEC, 0);
	if (file < 0) return nullptr;
	void *mapped = ::mmap(nullptr, sizeof(InputState), PROT_READ, MAP_SHARED, file, 0);
	::close(file);
	return mapped == MAP_FAILED ? nullptr : static_cast<const InputState *>(mapped);
}

int openNode(const char *path, const struct stat &status, int flags)
{
	if ((status.st_mode & 0444) == 0) return failed(EACCES); // tests run as root too, whom the kernel refuses nothing
	if ((status.st_mode & 0222) == 0 && (flags & O_ACCMODE) != O_RDONLY) return failed(EACCES);
	const InputState *state = stateOf(path);
	sockaddr_un address{};
	address.sun_family = AF_UNIX;
	if (!state || std::strlen(path) >= sizeof(address.sun_path)) return failed(ENXIO);
	std::strcpy(address.sun_path, path);
	const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (fd < 0) return fd;
	if (size_t(fd) >= states.size() || ::connect(fd, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0) {
		::close(fd);
		return failed(ENODEV);
	}
	states[size_t(fd)] = state;
	effects[size_t(fd)] = false;
	return fd;
}

template <typename T> int give(unsigned long request, void *out, const T &value)
{
	const size_t size = std::min(size_t(_IOC_SIZE(request)), sizeof(T));
	std::memcpy(out, &value, size);
	return int(size);
}

int giveTypeBits(const InputState &state, unsigned type, unsigned long request, void *out)
{
	std::memset(out, 0, _IOC_SIZE(request));
	switch (type) {
	case 0: return give(request, out, state.types);
	case EV_KEY: return give(request, out, state.keys);
	case EV_REL: return give(request, out, state.relative);
	case EV_ABS: return give(request, out, state.absolute);
	case EV_FF: return give(request, out, state.effects);
	default: return 0;
	}
}

int uploadEffect(int fd, ff_effect *effect)
{
	constexpr int16_t chosen = 3; // by the kernel; anything but 0, which a driver might take for granted
	if (effect->id < 0 && effects[size_t(fd)].exchange(true)) return failed(ENOSPC);
	effect->id = chosen;
	return ::send(fd, effect, sizeof(*effect), MSG_NOSIGNAL) == ssize_t(sizeof(*effect)) ? 0 : failed(ENODEV);
}

int answer(const InputState &state, int fd, unsigned long request, void *argument)
{
	const unsigned number = _IOC_NR(request);
	if (_IOC_DIR(request) == _IOC_WRITE) return request == EVIOCSFF ? uploadEffect(fd, static_cast<ff_effect *>(argument)) : 0;
	if (number >= _IOC_NR(EVIOCGABS(0)) && number < _IOC_NR(EVIOCGABS(0)) + ABS_CNT)
		return give(request, argument, state.axes[number - _IOC_NR(EVIOCGABS(0))]);
	if (number >= 0x20 && number < 0x20 + EV_CNT) return giveTypeBits(state, number - 0x20, request, argument);
	switch (number) {
	case _IOC_NR(EVIOCGVERSION): return give(request, argument, int(EV_VERSION)) > 0 ? 0 : -1;
	case _IOC_NR(EVIOCGID): return give(request, argument, state.id) > 0 ? 0 : -1;
	case _IOC_NR(EVIOCGNAME(0)): return give(request, argument, state.name);
	case _IOC_NR(EVIOCGPHYS(0)):
	case _IOC_NR(EVIOCGUNIQ(0)): return failed(ENOENT);
	case _IOC_NR(EVIOCGMTSLOTS(0)): return failed(EINVAL);
	case _IOC_NR(EVIOCGKEY(0)): return give(request, argument, state.pressed);
	default: std::memset(argument, 0, _IOC_SIZE(request)); return 0;
	}
}

int interposedOpen(const char *path, int flags, mode_t mode)
{
	struct stat status {
	};
	return isNode(path, status) ? openNode(path, status, flags) : openDirectly(path, flags, mode);
}

mode_t modeIn(int flags, va_list rest) { return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0; }

} // namespace

// NOLINTBEGIN(cert-dcl50-cpp): the C library's own functions
extern "C" {

__attribute__((visibility("default"))) int open(const char *path, int flags, ...)
{
	va_list rest;
	va_start(rest, flags);
	const mode_t mode = modeIn(flags, rest);
	va_end(rest);
	return interposedOpen(path, flags, mode);
}

__attribute__((visibility("default"))) int access(const char *path, int mode) noexcept
{
	struct stat status {
	};
	if (isNode(path, status) && (mode & R_OK) != 0 && (status.st_mode & 0444) == 0) return failed(EACCES);
	return int(::syscall(SYS_faccessat, AT_FDCWD, path, mode));
}

__attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...) noexcept
{
	va_list rest;
	va_start(rest, request);
	void *const argument = va_arg(rest, void *);
	va_end(rest);
	const InputState *state = fd >= 0 && size_t(fd) < states.size() ? states[size_t(fd)].load() : nullptr;
	if (state && _IOC_TYPE(request) == 'E') return answer(*state, fd, request, argument);
	return int(::syscall(SYS_ioctl, fd, request, argument));
}
}
// NOLINTEND(cert-dcl50-cpp)
