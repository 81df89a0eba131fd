#include "runtime/base/clock.h"
#include "runtime/base/error.h"
#include "runtime/ipc/launch.h"
#include "runtime/ipc/listener.h"
#include "runtime/ipc/request.h"
#include "runtime/ipc/runtime_directory.h"
#include "runtime/ipc/spawn.h"
#include "tests/common/temporary_folder.h"
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <thread>

using namespace arift;
using namespace arift::ipc;
namespace fs = std::filesystem;

namespace
{

/// XDG folders of the test's own.
class Launch : public testing::Test
{
protected:
	Launch()
	{
		for (const char *variable : {"XDG_RUNTIME_DIR", "XDG_STATE_HOME", "XDG_CONFIG_HOME"}) ::setenv(variable, root_.c_str(), 1);
		::unsetenv("ARIFT_SERVICE");
		::setenv("ARIFT_TEST_LIST", (root_ / "started").c_str(), 1);
	}
	std::vector<std::string> lines(const char *file) const
	{
		std::ifstream stream(root_ / file);
		std::vector<std::string> result;
		for (std::string line; std::getline(stream, line);) result.push_back(line);
		return result;
	}

	const test::TemporaryFolder folder_;
	const fs::path root_ = folder_.path();
};

} // namespace

TEST_F(Launch, TheRuntimeDirectoryIsPrivate)
{
	const fs::path path = runtimeDirectory();
	EXPECT_EQ(path, root_ / "arift");
	struct stat status {
	};
	ASSERT_EQ(::stat(path.c_str(), &status), 0);
	EXPECT_EQ(status.st_mode & 0777, 0700u);
	fs::permissions(path, fs::perms(0755));
	EXPECT_THROW(runtimeDirectory(), InputError);
}

TEST_F(Launch, ALinkInPlaceOfTheRuntimeDirectoryIsRefused)
{
	fs::create_directory(root_ / "elsewhere");
	fs::permissions(root_ / "elsewhere", fs::perms(0700));
	fs::create_symlink(root_ / "elsewhere", root_ / "arift");
	EXPECT_THROW(runtimeDirectory(), InputError);
}

TEST_F(Launch, WithoutARuntimeDirectoryThereIsAPrivateOneOfTheUsersOwn)
{
	::unsetenv("XDG_RUNTIME_DIR");
	const std::string user = std::to_string(::geteuid());
	const bool madeBefore = fs::exists("/run/user/" + user + "/arift") || fs::exists("/tmp/arift-" + user);
	const fs::path path = runtimeDirectory();
	EXPECT_TRUE(path == "/run/user/" + user + "/arift" || path == "/tmp/arift-" + user) << path;
	EXPECT_EQ(fs::status(path).permissions(), fs::perms(0700));
	if (!madeBefore) fs::remove(path);
	::setenv("XDG_RUNTIME_DIR", "relative/folder", 1);
	EXPECT_TRUE(runtimeDirectory().is_absolute()) << "a relative path counts as none, as the XDG specification has it";
	if (!madeBefore) fs::remove(path);
}

/// Only root can give a folder away, or become somebody else.
class OtherUser : public Launch
{
protected:
	static constexpr uid_t nobody = 65534;
	void SetUp() override
	{
		if (::geteuid() != 0) GTEST_SKIP() << "needs root";
	}
	/// What `work` returns in a process of another user.
	static int asNobody(const std::function<int()> &work)
	{
		const pid_t child = ::fork();
		if (child == 0) ::_exit(::setgid(nobody) == 0 && ::setuid(nobody) == 0 ? work() : 99);
		int status = -1;
		::waitpid(child, &status, 0);
		return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
	}
};

TEST_F(OtherUser, ARuntimeDirectoryOfAnotherUserIsRefused)
{
	ASSERT_EQ(::chown(runtimeDirectory().c_str(), nobody, nobody), 0);
	try {
		runtimeDirectory();
		ADD_FAILURE() << "it was taken";
	} catch (const InputError &error) {
		EXPECT_NE(std::string(error.what()).find("belongs to user 65534, expected user 0"), std::string::npos) << error.what();
	}
}

TEST_F(OtherUser, ConnectionsAcrossUsersAreRefusedOnBothSides)
{
	const fs::path open = root_ / "open.sock"; // as if somebody had opened the doors before it
	fs::permissions(root_, fs::perms(0755));
	Listener listener(open);
	fs::permissions(open, fs::perms(0777));
	int connected = -1, refusedHere = -1;
	const pid_t main = ::getpid();
	connected = asNobody([&] {
		try {
			connectTo(open);
			return 0;
		} catch (const InputError &error) {
			return std::string(error.what()).find("belongs to user 0, expected user 65534") != std::string::npos ? 1 : 2;
		}
	});
	ASSERT_EQ(::getpid(), main);
	EXPECT_EQ(connected, 1) << "the client notices whose service it is";
	refusedHere = asNobody([&] {
		const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
		sockaddr_un address{};
		address.sun_family = AF_UNIX;
		open.native().copy(address.sun_path, sizeof(address.sun_path) - 1);
		return ::connect(fd, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) == 0 ? 0 : 1;
	});
	EXPECT_EQ(refusedHere, 0) << "the kernel lets it in";
	EXPECT_FALSE(listener.accept(realTime() + second / 5)) << "and the service does not";
}

TEST_F(Launch, ASandboxIsToldTheOptionThatLetsTheSocketThrough)
{
	EXPECT_EQ(sandboxHint(root_), "");
	::setenv("SNAP", "/snap/game/1", 1);
	::setenv("SNAP_NAME", "game", 1);
	EXPECT_NE(sandboxHint(root_).find("snap install --classic game"), std::string::npos);
	::unsetenv("SNAP");
	::unsetenv("SNAP_NAME");
	fs::create_directories(root_ / "run/pressure-vessel");
	EXPECT_NE(sandboxHint(root_).find("PRESSURE_VESSEL_FILESYSTEMS_RW=$XDG_RUNTIME_DIR/arift"), std::string::npos);
	std::ofstream(root_ / ".flatpak-info") << "[Application]\n";
	EXPECT_NE(sandboxHint(root_).find("--filesystem=xdg-run/arift"), std::string::npos);
}

/// From a sandbox nothing is started, though it could be; a service that runs is found.
TEST_F(Launch, InsideASandboxOnlyTheSocketIsTried)
{
	::setenv("ARIFT_SERVICE", LAUNCHED_PROGRAM, 1);
	::setenv("SNAP", "/snap/game/1", 1);
	::setenv("SNAP_NAME", "game", 1);
	const Connection none = connectOrLaunch(10 * second);
	EXPECT_FALSE(none.socket);
	EXPECT_NE(none.problem.find("runs in a sandbox"), std::string::npos) << none.problem;
	EXPECT_TRUE(lines("started").empty());
	Listener listener(socketPath());
	EXPECT_TRUE(connectOrLaunch(10 * second).socket);
	::unsetenv("SNAP");
	::unsetenv("SNAP_NAME");
}

TEST_F(Launch, ASocketPathThatIsTooLongIsSaid)
{
	::setenv("XDG_RUNTIME_DIR", (root_ / std::string(100, 'x')).c_str(), 1);
	fs::create_directory(root_ / std::string(100, 'x'));
	const Connection connection = connectToService();
	EXPECT_FALSE(connection.socket);
	EXPECT_NE(connection.problem.find("at most 107 bytes"), std::string::npos) << connection.problem;
}

TEST_F(Launch, OnlyOneHoldsTheLock)
{
	auto first = takeServiceLock(lockPath());
	ASSERT_TRUE(first);
	EXPECT_FALSE(takeServiceLock(lockPath()));
	first.reset();
	EXPECT_TRUE(takeServiceLock(lockPath()));
}

TEST_F(Launch, WhatADeadServiceLeftIsReplaced)
{
	std::ofstream(socketPath()) << "not a socket";
	Listener listener(socketPath());
	Connection connection = connectToService();
	ASSERT_TRUE(connection.socket) << connection.problem;
	const auto accepted = listener.accept(realTime() + 10 * second);
	ASSERT_TRUE(accepted);
	EXPECT_EQ(peerOf(*accepted).pid, ::getpid());
}

TEST_F(Launch, StopEndsAccept)
{
	Listener listener(socketPath());
	std::jthread stopper([&] { listener.stop(); });
	EXPECT_FALSE(listener.accept(realTime() + 60 * second));
}

TEST_F(Launch, AMissingServiceIsSaid)
{
	::setenv("ARIFT_SERVICE", "/no/such/program", 1);
	const Connection connection = connectOrLaunch(second);
	EXPECT_FALSE(connection.socket);
	EXPECT_EQ(connection.problem, "ARIFT_SERVICE=/no/such/program is not an executable file");
}

TEST_F(Launch, AServiceThatCannotStartSaysWhy)
{
	::setenv("ARIFT_SERVICE", LAUNCHED_PROGRAM, 1);
	::setenv("ARIFT_TEST_COMPLAINT", "config.toml:3: that is no number", 1);
	const Connection connection = connectOrLaunch(60 * second);
	::unsetenv("ARIFT_TEST_COMPLAINT");
	EXPECT_FALSE(connection.socket);
	EXPECT_EQ(connection.problem, "config.toml:3: that is no number");
}

TEST_F(Launch, TwentyAtOnceStartOneService)
{
	::setenv("ARIFT_SERVICE", LAUNCHED_PROGRAM, 1);
	std::array<Connection, 20> connections;
	{
		std::vector<std::jthread> threads;
		for (Connection &connection : connections) threads.emplace_back([&] { connection = connectOrLaunch(60 * second); });
	}
	for (const Connection &connection : connections) EXPECT_TRUE(connection.socket) << connection.problem;
	const auto started = lines("started");
	EXPECT_EQ(std::ranges::count_if(started, [](const std::string &line) { return line.starts_with("listens"); }), 1);
	Requests(std::move(*connections[0].socket)).command(ShutDown{}, 10 * second);
}

/// A killed service keeps its lock until the kernel has closed its files: who starts one meanwhile starts another.
TEST_F(Launch, ALockThatIsLetGoLateHindersNobody)
{
	::setenv("ARIFT_SERVICE", LAUNCHED_PROGRAM, 1);
	auto dying = takeServiceLock(lockPath());
	ASSERT_TRUE(dying);
	std::jthread end([&] {
		std::this_thread::sleep_for(std::chrono::milliseconds(300)); // longer than the first one started takes to leave
		dying.reset();
	});
	Connection connection = connectOrLaunch(10 * second);
	ASSERT_TRUE(connection.socket) << connection.problem;
	Requests(std::move(*connection.socket)).command(ShutDown{}, 10 * second);
}

TEST_F(Launch, TheServiceHasNothingOfItsHost)
{
	::setenv("ARIFT_SERVICE", LAUNCHED_PROGRAM, 1);
	::setenv("LD_PRELOAD_OF_THE_HOST", "secret", 1);
	const UniqueFd left(::dup(0)); // without close-on-exec
	sigset_t blocked;
	sigemptyset(&blocked);
	sigaddset(&blocked, SIGTERM);
	::pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
	Connection connection = connectOrLaunch(60 * second);
	::pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);
	ASSERT_TRUE(connection.socket) << connection.problem;
	const auto started = lines("started");
	ASSERT_EQ(started.size(), 1u);
	// pid, session leader's child, cwd, descriptors beyond the launch pipe, blocked signals, variables of the host
	EXPECT_EQ(started[0], "listens cwd=/ own-session=1 descriptors=0 blocked=0 host-variables=0");
	Requests(std::move(*connection.socket)).command(ShutDown{}, 10 * second);
}

TEST(Environment, OnlyWhatAServiceNeedsPasses)
{
	for (const char *variable : {"HOME=/home/x", "XDG_RUNTIME_DIR=/run", "ARIFT_LOG=debug", "DISPLAY=:0", "VK_ICD_FILENAMES=x", "LC_ALL=C"})
		EXPECT_TRUE(passesToService(variable)) << variable;
	for (const char *variable :
		 {"LD_PRELOAD=x.so", "LD_LIBRARY_PATH=/steam", "HOMEX=1", "VK_INSTANCE_LAYERS=x", "GIO_EXTRA_MODULES=y", "ARIFT_LAUNCH_FD=3"})
		EXPECT_FALSE(passesToService(variable)) << variable;
}
