// A full disk, a machine that stands still for a while, a wall clock that is set.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

using namespace arift;
using namespace arift::e2e;
using namespace std::chrono_literals;

namespace
{

constexpr const char *configuration =
	"[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"scaled\"\nrate = 0.25\n[compositor]\ntarget = \"offscreen\"\n";

} // namespace

TEST(FullDisk, NeitherLogNorTraceNorPicturesEndTheService)
{
	const PrivateTree tree;
	auto environment = tree.environment();
	environment["ARIFT_TRACE"] = "/dev/full";
	environment["ARIFT_LOG"] = "debug";
	ChildProcess service({(programDirectory() / "arift-service").string(), "--set", "headset.driver=synthetic"}, environment, "/dev/full");
	nlohmann::json status;
	for (int i = 0; i < 1000 && status.is_null(); ++i) {
		const Ran answer = runArift(tree, {"status", "--json"});
		if (answer.status == 0) status = nlohmann::json::parse(answer.output);
	}
	ASSERT_FALSE(status.is_null()) << "a service that cannot write its log serves";

	const auto picture = tree.root() / "panel.png";
	const std::string arift = (programDirectory() / "arift").string();
	const Ran full =
		runCommand(tree, {"/bin/sh", "-c", "ulimit -f 8; exec " + arift + " screenshot " + picture.string()}, tree.environment());
	EXPECT_EQ(full.status, 1) << full.output;
	EXPECT_NE(full.output.find(picture.string()), std::string::npos) << full.output;
	EXPECT_FALSE(std::filesystem::exists(picture)) << "half a picture is none";
	EXPECT_EQ(std::distance(std::filesystem::directory_iterator(tree.root()), {}), 4)
		<< "nothing is left but its log and the three folders";
	EXPECT_EQ(runArift(tree, {"screenshot", picture.string()}).status, 0);
	EXPECT_EQ(service.stop(), 0);
}

TEST(Trace, OfARunningServiceHasEveryStageOfEveryFrame)
{
	const test::TemporaryFolder folder;
	const auto file = folder.path() / "trace.json";
	::setenv("ARIFT_TRACE", file.c_str(), 1);
	PrivateService service(configuration);
	::unsetenv("ARIFT_TRACE");
	const ChildProcess application = service.start("stopping_application", {"never", "0"});
	ASSERT_TRUE(eventually(service, [](const auto &status) {
		return !status["clients"].empty() && status["clients"][0]["shown"] > 5 && status["frames"]["shown"] > 20;
	}));
	const auto status = service.status();
	::kill(service.process().pid(), SIGKILL);
	service.process().wait(10s);

	const auto events = nlohmann::json::parse(std::ifstream(file));
	std::map<std::string, std::map<uint64_t, int>> frames;
	for (const auto &event : events)
		if (event["ph"] == "X") frames[event["name"]][event["args"]["frame"].get<uint64_t>()]++;
	const auto &stages = status["frames"]["stagesMs"];
	ASSERT_EQ(stages.size(), 7u);
	for (const auto &[stage, figure] : stages.items()) {
		EXPECT_GE(figure["p99"], figure["median"]) << stage;
		ASSERT_GT(frames[stage].size(), 10u) << stage;
		EXPECT_EQ(frames[stage].begin()->first, 1u) << stage;
		EXPECT_EQ(frames[stage].rbegin()->first, frames[stage].size()) << "no frame is left out: " << stage;
	}
	EXPECT_GT(stages["draw"]["median"], 0.1);
	EXPECT_GT(frames["received until seen"].size(), 3u);
	const auto &latency = status["clients"][0]["latencyMs"];
	EXPECT_GT(latency["median"], 20) << "the panel alone takes 25 ms";
	EXPECT_LT(latency["median"], 400);
}

TEST(Clocks, AProcessThatStoodStillMakesUpForNothing)
{
	PrivateService service(configuration);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 10; }));
	service.status(true);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 2; })); // a gap is one between two images
	const auto before = service.status();
	::kill(service.process().pid(), SIGSTOP);
	std::this_thread::sleep_for(
		4s); // a second of its clock: sixty images, forty-three of each camera and a thousand samples of the tracker
	::kill(service.process().pid(), SIGCONT);
	const XrTime begin = realTime();
	nlohmann::json after;
	EXPECT_TRUE(eventually(service, [&](const auto &status) {
		after = status;
		return status["frames"]["longestGapMs"] >= 900;
	})) << "what was missed is told";
	const double passed = 0.25 * inSeconds(realTime() - begin);
	EXPECT_LE(after["frames"]["shown"].get<double>(), 62 * passed + 5) << "no burst of images";
	const auto received = [&](size_t camera) {
		return after["cameras"][camera]["received"].get<int>() - before["cameras"][camera]["received"].get<int>();
	};
	EXPECT_LE(received(0), 43 * passed + 5);
	EXPECT_LE(received(1), 43 * passed + 5);
	service.status(true);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 10; }));
	const auto frames = service.status()["frames"];
	EXPECT_LT(frames["poseAgeMs"]["median"], 200) << "nothing lags behind";
	EXPECT_LT(frames["cameraAgeMs"]["median"], 300);
}

TEST(Clocks, NothingWaitsByAClockThatCanBeSet)
{
	const auto library = programDirectory().parent_path() / "lib/libopenxr_arift.so";
	for (const auto &binary : {programDirectory() / "arift-service", library}) {
		const PrivateTree tree;
		const Ran symbols = runCommand(tree, {"/usr/bin/nm", "-D", "--undefined-only", binary.string()}, tree.environment());
		ASSERT_EQ(symbols.status, 0) << symbols.output;
		EXPECT_NE(symbols.output.find("clock_gettime"), std::string::npos) << binary;
		for (const char *waits : {" pthread_cond_timedwait", " sem_timedwait", " pthread_mutex_timedlock", " mq_timed", " gettimeofday"})
			EXPECT_EQ(symbols.output.find(waits), std::string::npos) << binary << " uses" << waits;
	}
}
