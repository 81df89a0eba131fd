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
#include <gtest/gtest.h>
#include <sys/stat.h>
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
