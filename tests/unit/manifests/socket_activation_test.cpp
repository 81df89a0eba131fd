// What arift.socket promises: the service takes the socket systemd listens on, and leaves it listening when it goes.
#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/ipc/listener.h"
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace arift::ipc
{
namespace
{

constexpr int handedOver = 3;

/// Does what systemd does for a socket unit: listens, puts the socket at descriptor 3 and says so. What was at 3 comes back.
class SocketUnit
{
public:
	explicit SocketUnit(const std::filesystem::path &path) : saved_(::dup(handedOver)), own_(::socket(AF_UNIX, SOCK_SEQPACKET, 0))
	{
		sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
		path.native().copy(address.sun_path, sizeof(address.sun_path) - 1);
		::unlink(path.c_str());
		EXPECT_EQ(::bind(own_.get(), reinterpret_cast<const sockaddr *>(&address), sizeof(address)), 0);
		EXPECT_EQ(::listen(own_.get(), 8), 0);
		handOver();
	}
	~SocketUnit()
	{
		if (saved_) ::dup2(saved_.get(), handedOver);
	}
	void handOver()
	{
		if (own_.get() == handedOver) own_ = UniqueFd(::dup(handedOver));
		EXPECT_EQ(::dup2(own_.get(), handedOver), handedOver);
		::setenv("LISTEN_PID", std::to_string(::getpid()).c_str(), 1);
		::setenv("LISTEN_FDS", "1", 1);
	}

private:
	UniqueFd saved_, own_;
};

class SocketActivation : public testing::Test
{
protected:
	const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("arift-activation-" + std::to_string(::getpid()));
	const std::filesystem::path path = folder / "service.sock";
	void SetUp() override { std::filesystem::create_directories(folder); }
	void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(SocketActivation, TheApplicationThatWokeTheServiceIsServed)
{
	SocketUnit unit(path);
	const auto client = connectTo(path); // before the service runs: systemd queues it
	ASSERT_TRUE(client);
	Listener listener(path);
	EXPECT_EQ(std::getenv("LISTEN_FDS"), nullptr) << "not for programs started from here";
	EXPECT_TRUE(listener.accept(realTime() + second));
}

TEST_F(SocketActivation, SystemdGoesOnListeningWhenTheServiceHasGone)
{
	SocketUnit unit(path);
	{
		Listener listener(path);
		listener.stop();
		EXPECT_FALSE(listener.accept(realTime() + second));
	}
	const auto next = connectTo(path);
	EXPECT_TRUE(next) << "the next application is queued for the next service";
	unit.handOver();
	Listener again(path);
	EXPECT_TRUE(again.accept(realTime() + second));
}

TEST_F(SocketActivation, AnotherSocketIsRefusedWithItsName)
{
	SocketUnit unit(folder / "other.sock");
	try {
		Listener listener(path);
		FAIL() << "took a socket that listens elsewhere";
	} catch (const InputError &error) {
		EXPECT_NE(std::string(error.what()).find("other.sock"), std::string::npos) << error.what();
	}
}

} // namespace
} // namespace arift::ipc
