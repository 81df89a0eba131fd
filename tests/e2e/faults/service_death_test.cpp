// The service that an application has started is killed: its parent starts it again, and applications find it.
#include "tests/e2e/common/command.h"
#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

using namespace arift::e2e;
using namespace std::chrono_literals;

namespace
{

Ran runCube(const PrivateTree &tree)
{
	return runCommand(tree, {(programDirectory() / "hologram_cube").string(), "--seconds", "1"}, tree.environment(), 120s);
}

/// Nothing where no service answers.
std::optional<nlohmann::json> statusOf(const PrivateTree &tree)
{
	const Ran answer = runArift(tree, {"status", "--json"});
	if (answer.status != 0) return std::nullopt;
	return nlohmann::json::parse(answer.output);
}

std::optional<int> servicePid(const PrivateTree &tree)
{
	const auto status = statusOf(tree);
	return status ? std::optional<int>((*status)["service"]["pid"].get<int>()) : std::nullopt;
}

/// The pid of another service than `before`, once one answers.
std::optional<int> nextService(const PrivateTree &tree, int before)
{
	for (const auto end = std::chrono::steady_clock::now() + 60s; std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(20ms))
		if (const auto pid = servicePid(tree); pid && *pid != before) return pid;
	return std::nullopt;
}

bool isGone(int pid)
{
	const std::string stat = contentOf("/proc/" + std::to_string(pid) + "/stat");
	const size_t name = stat.rfind(')');
	return name == std::string::npos || stat.compare(name, 3, ") Z") == 0;
}

int parentOf(int pid)
{
	const std::string stat = contentOf("/proc/" + std::to_string(pid) + "/stat");
	return std::atoi(stat.c_str() + stat.rfind(')') + 4);
}

} // namespace

TEST(ServiceDeath, AKilledServiceComesBackAndTheNextApplicationWorks)
{
	const PrivateTree tree;
	const ServiceEnd end(tree);
	ASSERT_EQ(runCube(tree).status, 0) << "it starts the service";
	const int first = servicePid(tree).value();
	const int parent = parentOf(first);
	EXPECT_EQ(contentOf("/proc/" + std::to_string(parent) + "/comm"), "arift-watch\n");

	const auto killedAt = std::chrono::steady_clock::now();
	::kill(first, SIGKILL);
	const auto second = nextService(tree, first);
	const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - killedAt;
	ASSERT_TRUE(second) << contentOf(tree.root() / "state/arift/service.log");
	std::fprintf(stderr, "[ FIGURE   ] a killed service answers again after %.2f s\n", passed.count());
	EXPECT_EQ(parentOf(*second), parent) << "nobody asked for it: its parent has started it";
	EXPECT_NE(
		contentOf(tree.root() / "state/arift/service.log").find("signal 9 (Killed) has ended the service: it is started again in 0.1 s"),
		std::string::npos);
	EXPECT_EQ(runCube(tree).status, 0);

	EXPECT_EQ(runArift(tree, {"stop"}).status, 0);
	for (int i = 0; i < 1000 && !(isGone(*second) && isGone(parent)); ++i) std::this_thread::sleep_for(10ms);
	EXPECT_TRUE(isGone(*second));
	EXPECT_TRUE(isGone(parent)) << "it ends when the service ends in order";
	EXPECT_FALSE(statusOf(tree));
}

TEST(ServiceDeath, AServiceWhoseParentIsKilledGoesOn)
{
	const PrivateTree tree;
	const ServiceEnd end(tree);
	ASSERT_EQ(runCube(tree).status, 0);
	const int service = servicePid(tree).value();
	::kill(parentOf(service), SIGKILL);
	EXPECT_EQ(runCube(tree).status, 0);
	EXPECT_EQ(servicePid(tree), service);
}
