#include "runtime/service/realtime.h"
#include "runtime/base/log.h"
#include <cstring>
#include <memory>
#include <sched.h>
#include <sys/resource.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

namespace arift
{

namespace
{

constexpr const char *service = "org.freedesktop.RealtimeKit1", *object = "/org/freedesktop/RealtimeKit1";
constexpr uint64_t answerLimitUs = 500'000;

using Bus = std::unique_ptr<sd_bus, decltype([](sd_bus *bus) { sd_bus_flush_close_unref(bus); })>;

std::string failed(const char *what, int error) { return fmt::format("{}: {}", what, std::strerror(-error)); }

/// rtkit grants nothing to a process that could keep a processor for itself: it wants a limit no longer than this.
int longestRun(sd_bus *bus, int64_t &microseconds)
{
	return sd_bus_get_property_trivial(bus, service, object, service, "RTTimeUSecMax", nullptr, 'x', &microseconds);
}

/// SIGXCPU at three quarters of it, SIGKILL at the whole.
bool limitRun(int64_t microseconds)
{
	const rlimit limit{rlim_t(microseconds) * 3 / 4, rlim_t(microseconds)};
	return ::setrlimit(RLIMIT_RTTIME, &limit) == 0;
}

} // namespace

std::string makeRealtime(pid_t thread, uint32_t priority)
{
	sd_bus *opened = nullptr;
	if (const int result = sd_bus_open_system(&opened); result < 0) return failed("no system bus", result);
	const Bus bus(opened);
	sd_bus_set_method_call_timeout(bus.get(), answerLimitUs);
	int64_t microseconds = 0;
	if (const int result = longestRun(bus.get(), microseconds); result < 0) return failed("no rtkit", result);
	if (microseconds <= 0 || !limitRun(microseconds)) return failed("RLIMIT_RTTIME", -errno);
	const int result =
		sd_bus_call_method(bus.get(), service, object, service, "MakeThreadRealtime", nullptr, nullptr, "tu", uint64_t(thread), priority);
	return result < 0 ? failed("rtkit refuses", result) : std::string();
}

void Realtime::askFor(const char *name)
{
	const pid_t thread = ::gettid();
	if (const std::string problem = makeRealtime(thread, priority); !problem.empty()) {
		log::info("the {} thread has no real-time priority: {}", name, problem);
		return;
	}
	log::info("the {} thread has real-time priority {}", name, priority);
	threads_.lock()->push_back(thread);
}

void Realtime::giveBack()
{
	std::vector<pid_t> threads;
	threads_.update([&](std::vector<pid_t> &all) { all.swap(threads); });
	const sched_param fair{};
	for (const pid_t thread : threads) ::sched_setscheduler(thread, SCHED_OTHER, &fair);
	if (!threads.empty()) log::warning("a thread kept the processor for too long: real-time priority is given back");
}

} // namespace arift
