// The first application starts the service: a real one, through the loader, with nothing running before.
#include "tests/e2e/common/command.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

using namespace arift::e2e;

namespace
{

Ran runCube(const PrivateTree &tree)
{
	return runCommand(tree, {(programDirectory() / "hologram_cube").string(), "--seconds", "1"}, tree.environment(),
					  std::chrono::seconds(120));
}

/// A process that has ended may be left for its parent to collect: state Z.
bool isRunning(int pid)
{
	const std::string stat = contentOf("/proc/" + std::to_string(pid) + "/stat");
	const size_t name = stat.rfind(')');
	return name != std::string::npos && stat.compare(name, 3, ") Z") != 0;
}

bool endsWithin(int pid, std::chrono::seconds limit)
{
	for (const auto end = std::chrono::steady_clock::now() + limit; std::chrono::steady_clock::now() < end;) {
		if (!isRunning(pid)) return true;
		std::this_thread::sleep_for(std::chrono::milliseconds(10));
	}
	return false;
}

} // namespace

TEST(AutomaticStart, TheFirstApplicationStartsTheServiceWhichOutlivesIt)
{
	const PrivateTree tree;
	ASSERT_EQ(runArift(tree, {"status"}).status, 1) << "nothing runs yet";
	const ServiceEnd end(tree);
	const Ran cube = runCube(tree);
	EXPECT_EQ(cube.status, 0) << cube.output << contentOf(tree.root() / "state/arift/service.log");

	const Ran answer = runArift(tree, {"status", "--json"});
	ASSERT_EQ(answer.status, 0) << answer.output;
	const auto status = nlohmann::json::parse(answer.output);
	const int pid = status["service"]["pid"];
	EXPECT_TRUE(isRunning(pid));
	EXPECT_EQ(status["headset"]["name"], "synthetic headset");
	EXPECT_GT(status["frames"]["shown"].get<int>(), 0);
	EXPECT_NE(contentOf(tree.root() / "state/arift/service.log").find("listens on"), std::string::npos) << "its log is where it should be";

	const Ran again = runCube(tree);
	EXPECT_EQ(again.status, 0) << again.output;
	EXPECT_EQ(nlohmann::json::parse(runArift(tree, {"status", "--json"}).output)["service"]["pid"], pid) << "the next one finds it";

	EXPECT_EQ(runArift(tree, {"stop"}).status, 0);
	EXPECT_TRUE(endsWithin(pid, std::chrono::seconds(30)));
	const Ran gone = runArift(tree, {"status"});
	EXPECT_EQ(gone.status, 1);
	EXPECT_NE(gone.output.find("no arift-service listens on"), std::string::npos) << gone.output;
}

TEST(AutomaticStart, AWrongConfigurationReachesTheApplicationAsAnErrorAndASentence)
{
	const PrivateTree tree;
	const ServiceEnd end(tree);
	const auto file = tree.write("config/arift/config.toml", "[clock]\nmode = \"fast\"\n");
	const Ran cube = runCube(tree);
	EXPECT_EQ(cube.status, 1) << cube.output;
	EXPECT_NE(cube.output.find("xrCreateInstance failed with XrResult -51"), std::string::npos) << cube.output; // RUNTIME_UNAVAILABLE
	EXPECT_NE(cube.output.find(file.string() + ":2: clock.mode = 'fast', expected one of"), std::string::npos) << cube.output;
	EXPECT_EQ(runArift(tree, {"status"}).status, 1) << "no half-started service is left";
}

TEST(AutomaticStart, AHeadsetThatCannotBeOpenedIsAnErrorAndASentence)
{
	const PrivateTree tree;
	const ServiceEnd end(tree);
	tree.write("config/arift/config.toml", "[headset]\nrig = \"no_such_rig\"\n");
	const Ran cube = runCube(tree);
	EXPECT_EQ(cube.status, 1) << cube.output;
	EXPECT_NE(cube.output.find("no_such_rig"), std::string::npos) << cube.output;
}
