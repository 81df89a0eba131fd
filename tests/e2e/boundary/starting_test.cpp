// Applications that start the service all at once, by the real programs.
#include "runtime/ipc/launch.h"
#include "runtime/ipc/request.h"
#include "tests/e2e/common/command.h"
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <set>
#include <thread>

using namespace arift;
using namespace arift::e2e;

TEST(StartingTogether, TwentyApplicationsFindOneService)
{
	const PrivateTree tree;
	const ServiceEnd end(tree);
	for (const auto &[name, value] : tree.environment()) ::setenv(name.c_str(), value.c_str(), 1);
	::setenv("ARIFT_SERVICE", (programDirectory() / "arift-service").c_str(), 1);
	std::array<ipc::Connection, 20> connections;
	{
		std::vector<std::jthread> threads;
		for (ipc::Connection &connection : connections) threads.emplace_back([&] { connection = ipc::connectOrLaunch(60 * second); });
	}
	std::set<int> services;
	for (ipc::Connection &connection : connections) {
		ASSERT_TRUE(connection.socket) << connection.problem;
		services.insert(ipc::peerOf(*connection.socket).pid);
	}
	EXPECT_EQ(services.size(), 1u);
	for (ipc::Connection &connection : connections) {
		ipc::Requests requests(std::move(*connection.socket));
		EXPECT_TRUE(requests.ask<ipc::Welcome>(ipc::Hello{}, 60 * second)) << "each is served";
	}
}
