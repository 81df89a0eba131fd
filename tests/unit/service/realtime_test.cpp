// Asking rtkit for a thread's priority, with a bus and an rtkit that this test plays.
#include "runtime/base/clock.h"
#include "runtime/service/realtime.h"
#include "tests/common/temporary_folder.h"
#include <cstring>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-bus.h>
#include <thread>
#include <unistd.h>

using namespace arift;

namespace
{

constexpr int64_t longestRun = 200'000; // microseconds, as rtkit has it

struct Asked {
	uint64_t thread = 0;
	uint32_t priority = 0;
};

/// A system bus with nobody on it but rtkit. It answers one connection.
class PlayedBus
{
public:
	explicit PlayedBus(bool grants) : grants_(grants), listening_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0))
	{
		const std::string path = (folder_.path() / "bus").string();
		sockaddr_un address{};
		address.sun_family = AF_UNIX;
		path.copy(address.sun_path, sizeof(address.sun_path) - 1);
		EXPECT_EQ(::bind(listening_, reinterpret_cast<const sockaddr *>(&address), sizeof(address)), 0);
		EXPECT_EQ(::listen(listening_, 1), 0);
		::setenv("DBUS_SYSTEM_BUS_ADDRESS", ("unix:path=" + path).c_str(), 1);
		thread_ = std::jthread([this](const std::stop_token &stop) { serve(stop); });
	}
	~PlayedBus()
	{
		::shutdown(listening_, SHUT_RDWR); // ends accept()
		thread_.request_stop();
		thread_.join();
		::close(listening_);
		::unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
	}
	std::optional<Asked> asked() { return *asked_.lock(); }

private:
	void serve(const std::stop_token &stop)
	{
		const int peer = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
		if (peer < 0) return;
		sd_bus *bus = nullptr;
		sd_id128_t id{};
		sd_bus_new(&bus);
		sd_bus_set_fd(bus, peer, peer);
		sd_bus_set_server(bus, 1, id);
		sd_bus_set_anonymous(bus, 1);
		sd_bus_add_filter(bus, nullptr, &PlayedBus::answer, this);
		sd_bus_start(bus);
		while (!stop.stop_requested() && sd_bus_process(bus, nullptr) >= 0) sd_bus_wait(bus, 5'000);
		sd_bus_close_unref(bus);
	}
	static int answer(sd_bus_message *message, void *self, sd_bus_error *)
	{
		auto &bus = *static_cast<PlayedBus *>(self);
		if (sd_bus_message_is_method_call(message, "org.freedesktop.DBus", "Hello"))
			return sd_bus_reply_method_return(message, "s", ":1.1") < 0 ? -1 : 1;
		if (sd_bus_message_is_method_call(message, "org.freedesktop.DBus.Properties", "Get"))
			return sd_bus_reply_method_return(message, "v", "x", longestRun) < 0 ? -1 : 1;
		if (!sd_bus_message_is_method_call(message, "org.freedesktop.RealtimeKit1", "MakeThreadRealtime")) return 0;
		Asked asked;
		sd_bus_message_read(message, "tu", &asked.thread, &asked.priority);
		*bus.asked_.lock() = asked;
		if (!bus.grants_) return sd_bus_reply_method_errorf(message, SD_BUS_ERROR_ACCESS_DENIED, "no") < 0 ? -1 : 1;
		return sd_bus_reply_method_return(message, "") < 0 ? -1 : 1;
	}

	const bool grants_;
	const test::TemporaryFolder folder_;
	const int listening_;
	Guarded<std::optional<Asked>> asked_;
	std::jthread thread_;
};

} // namespace

TEST(Realtime, AsksForTheCallingThreadWithinALimit)
{
	PlayedBus bus(true);
	Realtime realtime;
	realtime.askFor("test");
	EXPECT_EQ(realtime.granted(), 1u);
	ASSERT_TRUE(bus.asked());
	EXPECT_EQ(bus.asked()->thread, uint64_t(::gettid()));
	EXPECT_EQ(bus.asked()->priority, Realtime::priority);
	rlimit limit{};
	::getrlimit(RLIMIT_RTTIME, &limit);
	EXPECT_EQ(limit.rlim_max, rlim_t(longestRun)) << "a thread that runs away is stopped";
	EXPECT_LT(limit.rlim_cur, limit.rlim_max) << "and asked first";
	realtime.giveBack();
	EXPECT_EQ(realtime.granted(), 0u);
	EXPECT_EQ(::sched_getscheduler(0), SCHED_OTHER);
}

TEST(Realtime, ARefusalIsASentence)
{
	PlayedBus bus(false);
	EXPECT_NE(makeRealtime(::gettid(), Realtime::priority).find("rtkit refuses"), std::string::npos);
	EXPECT_TRUE(bus.asked());
}

TEST(Realtime, WithoutABusEverythingGoesOn)
{
	::setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/no/such/bus", 1);
	Realtime realtime;
	const XrTime begin = realTime();
	realtime.askFor("test");
	EXPECT_LT(realTime() - begin, second);
	EXPECT_EQ(realtime.granted(), 0u);
	EXPECT_NE(makeRealtime(::gettid(), Realtime::priority).find("no system bus"), std::string::npos);
	::unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
}
