// Applications that are killed, hang or never begin: the world goes on as if they had not been there.
#include "tests/e2e/common/private_service.h"
#include "tests/e2e/kills/process_usage.h"
#include <algorithm>
#include <csignal>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

using namespace arift;
using namespace arift::e2e;

namespace
{

constexpr double period = 1000 / 59.91; // ms
constexpr std::array points{"before xrWaitFrame", "inside xrWaitFrame", "after xrWaitFrame", "after xrBeginFrame", "image acquired",
							"image waited for",   "work submitted",     "image released",    "inside xrEndFrame",  "after xrEndFrame"};

/// Two red discs, so that a picture says whether it shows what the cameras see: one before each camera at rest.
std::string configuration(double rate)
{
	return fmt::format("[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"scaled\"\nrate = {}\n[compositor]\ntarget = \"offscreen\"\n"
					   "[synthetic]\nmotion = \"rest\"\ncamera_noise = false\n"
					   "[[synthetic.markers]]\nposition = [-0.1, 0.0, -1.0]\nradius = 0.08\n"
					   "[[synthetic.markers]]\nposition = [0.1, 0.0, -1.0]\nradius = 0.08\n",
					   rate);
}

/// Red pixels in the left and in the right half.
std::array<int, 2> redIn(const PanelPicture &picture)
{
	std::array<int, 2> red{};
	for (size_t i = 0; i < picture.rgba.size() / 4; ++i) {
		const uint8_t *pixel = &picture.rgba[4 * i];
		red[i % picture.width >= picture.width / 2] += pixel[0] > 120 && pixel[1] < pixel[0] / 2 && pixel[2] < pixel[0] / 2;
	}
	return red;
}

void sleep(double milliseconds) { std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds)); }

template <typename Condition> bool await(Condition holds)
{
	for (const XrTime end = realTime() + 60 * second; realTime() < end; sleep(2))
		if (holds()) return true;
	return false;
}

uint64_t submitted(const nlohmann::json &status)
{
	uint64_t sum = 0;
	for (const auto &client : status["clients"]) sum += client["submitted"].get<uint64_t>();
	return sum;
}

/// A service whose clock runs so slowly that composing takes at most half a refresh, with an application drawing: one for all tests.
class Kills : public testing::Test
{
protected:
	static void SetUpTestSuite()
	{
		rate_ = affordableRate();
		running_.emplace(configuration(rate_));
		eventually(*running_, [](const auto &status) { return status["frames"]["shown"] > 30; }); // the cameras' images have faded in
	}
	static void TearDownTestSuite() { running_.reset(); }

	static double affordableRate()
	{
		constexpr double tried = 0.1;
		PrivateService probe(configuration(tried));
		const ChildProcess application = probe.start("stopping_application", {"never", "0"});
		eventually(probe, [](const auto &status) { return submitted(status) > 3; });
		probe.status(true);
		eventually(probe, [](const auto &status) { return status["frames"]["shown"] > 20; });
		const double cost = probe.status()["frames"]["composeMs"]["median"]; // the p99 of twenty images is the first one
		const double rate = std::clamp(0.3 * period / cost, 0.1, 1.0);
		fmt::print(stderr, "[ FIGURE   ] composing takes {:.1f} ms: the clock runs at {:.2f} of real time\n", cost, rate);
		return rate;
	}

	/// Lets the system's clock go on by a second.
	void oneSecond() const { sleep(1000 / rate_); }
	ChildProcess start(const char *point) { return service_.start("stopping_application", {point, "5"}); }
	/// An application that has stopped itself at the point.
	static bool isStopped(const ChildProcess &application) { return application.output().ends_with("stopped\n"); }
	bool isForgotten()
	{
		return eventually(service_, [](const auto &status) { return status["clients"].empty(); });
	}
	void kill(ChildProcess &application)
	{
		::kill(application.pid(), SIGKILL);
		application.wait(std::chrono::seconds(10));
		std::filesystem::remove(service_.tree().root() / "stopping_application.log"); // the next one writes its own
	}
	/// Gaps in a second from now, during which no image may be without the cameras. Nothing where others kept the machine so busy that
	/// composing took longer than half a refresh: then gaps say nothing of applications.
	std::optional<int> gapsInASecond(const char *when)
	{
		oneSecond();
		const auto frames = service_.status()["frames"];
		EXPECT_GT(frames["shown"].get<int>(), 5) << when;
		EXPECT_EQ(frames["withoutCamera"], 0) << when;
		if (frames["composeMs"]["p99"].get<double>() * rate_ > period / 2) return std::nullopt;
		return frames["gaps"];
	}
	/// Gaps per second that can be judged, and how many those are.
	struct Rate {
		double gaps = 0;
		int seconds = 0;
	};
	static Rate rateOf(const std::vector<std::optional<int>> &seconds, const char *when)
	{
		int all = 0, most = 0, judged = 0;
		for (const auto &gaps : seconds) {
			if (!gaps) continue;
			judged++;
			all += *gaps;
			most = std::max(most, *gaps);
		}
		fmt::print(stderr, "[ FIGURE   ] {}: {} gaps in {} seconds, at most {} in one; in {} more the machine was too busy to say\n", when,
				   all, judged, most, int(seconds.size()) - judged);
		return {judged ? double(all) / judged : 0, judged};
	}
	/// Less those of as many seconds in which nothing happens: the machine's own.
	void judge(const std::vector<std::optional<int>> &seconds, const char *when)
	{
		const Rate with = rateOf(seconds, when);
		if (with.gaps <= 1) return;
		std::vector<std::optional<int>> quiet;
		for (size_t i = 0; i < seconds.size(); ++i) {
			service_.status(true);
			quiet.push_back(gapsInASecond("nothing happens"));
		}
		const Rate without = rateOf(quiet, "an equal run without");
		if (without.seconds > 0) { EXPECT_LE(with.gaps - without.gaps, 1) << when; }
	}
	void expectTheWorld(const char *when)
	{
		const auto red = redIn(service_.screenshot());
		EXPECT_GT(red[0], 300) << when;
		EXPECT_GT(red[1], 300) << when;
	}

	static inline double rate_ = 1; ///< of the clock
	static inline std::optional<PrivateService> running_;
	PrivateService &service_ = *running_;
};

/// Clients, threads and descriptors go with the connection, a moment after it.
ProcessUsage settledUsage(PrivateService &service)
{
	ProcessUsage before, now = usageOf(service.process().pid());
	await([&] {
		sleep(200);
		before = std::exchange(now, usageOf(service.process().pid()));
		return now.descriptors == before.descriptors && now.threads == before.threads && now.mappings == before.mappings;
	});
	return now;
}

} // namespace

TEST_F(Kills, FiftyKillsLeaveNoGapAndNothingBehind)
{
	std::mt19937 random(7);
	std::vector<std::optional<int>> gaps;
	ProcessUsage before{};
	for (int number = -5; number < 50; ++number) {
		// The first ones only fill the allocator's caches; the last ten are killed at the named points, the others anywhere.
		const char *point = number >= 40 ? points[size_t(number - 40)] : "never";
		if (number < 0) expectTheWorld("before the first kill");
		if (number == 0) before = settledUsage(service_);
		ChildProcess application = start(point);
		if (number >= 40) {
			ASSERT_TRUE(await([&] { return isStopped(application); })) << point << "\n" << application.output();
			expectTheWorld(point);
			service_.status(true);
			kill(application);
			gaps.push_back(gapsInASecond(point));
			expectTheWorld(point);
		} else {
			ASSERT_TRUE(eventually(service_, [](const auto &status) { return submitted(status) > 2; })) << application.output();
			sleep(std::uniform_real_distribution(0.0, 2 * period / rate_)(random));
			kill(application);
		}
		ASSERT_TRUE(isForgotten()) << point;
	}
	const ProcessUsage after = settledUsage(service_);
	fmt::print(stderr, "[ FIGURE   ] before 50 kills {}\n[ FIGURE   ] after them {}\n", describe(before), describe(after));
	judge(gaps, "a second after a kill");
	EXPECT_EQ(after.descriptors, before.descriptors);
	EXPECT_EQ(after.threads, before.threads);
	EXPECT_LE(after.mappings, before.mappings);
	EXPECT_LE(after.residentMiB, before.residentMiB + 2);
	EXPECT_EQ(service_.status()["frames"]["withoutCamera"], 0);
}

TEST_F(Kills, AHungApplicationIsLeftOutAndGoesOnLater)
{
	ChildProcess application = start("image released");
	ASSERT_TRUE(await([&] { return isStopped(application); })) << application.output();
	service_.status(true);
	judge({gapsInASecond("hung")}, "an application hangs");
	expectTheWorld("hung");
	const uint64_t before = submitted(service_.status());
	::kill(application.pid(), SIGCONT);
	EXPECT_TRUE(eventually(service_, [&](const auto &status) { return submitted(status) > before + 5; })) << application.output();
	kill(application);
	EXPECT_TRUE(isForgotten());
}

TEST_F(Kills, AConnectionThatSaysNothingIsNoBurden)
{
	std::vector<ipc::Socket> silent;
	for (int i = 0; i < 8; ++i) silent.push_back(connectTo(service_.tree()).value());
	service_.status(true);
	judge({gapsInASecond("silent connections")}, "eight connections that say nothing");
	expectTheWorld("silent connections");
}
