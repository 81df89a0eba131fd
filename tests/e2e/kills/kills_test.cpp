// Applications that are killed, hang or never begin: the world goes on as if they had not been there.
#include "tests/e2e/common/marked_world.h"
#include "tests/e2e/common/process_usage.h"
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

constexpr std::array points{"before xrWaitFrame", "inside xrWaitFrame", "after xrWaitFrame", "after xrBeginFrame", "image acquired",
							"image waited for",   "work submitted",     "image released",    "inside xrEndFrame",  "after xrEndFrame"};

void sleep(double milliseconds) { std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds)); }

constexpr auto patience = std::chrono::seconds(60); // of a busy machine

/// A service whose clock runs so slowly that composing takes at most half a refresh, with an application drawing: one for all tests.
class Kills : public testing::Test
{
protected:
	static void SetUpTestSuite()
	{
		rate_ = affordableRate(0.3, [](PrivateService &service) {
			std::vector<ChildProcess> one;
			one.push_back(service.start("stopping_application", {"never", "0"}));
			return one;
		});
		running_.emplace(markedWorld(rate_));
		eventually(*running_, [](const auto &status) { return status["frames"]["shown"] > 30; }); // the cameras' images have faded in
	}
	static void TearDownTestSuite() { running_.reset(); }

	/// Lets the system's clock go on by a second.
	void oneSecond() const { sleep(1000 / rate_); }
	ChildProcess start(const char *point) const { return service_.start("stopping_application", {point, "5"}); }
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
	/// So many applications, five at a time, each killed where it happens to be.
	void killAnywhere(int count, std::mt19937 &random)
	{
		constexpr int together = 5;
		for (; count > 0; count -= together) {
			std::vector<ChildProcess> applications;
			for (int i = 0; i < together; ++i) applications.push_back(start("never"));
			const bool areDrawing = eventually(service_, [](const auto &status) {
				return status["clients"].size() == together &&
					   std::ranges::all_of(status["clients"], [](const auto &client) { return client["submitted"] > 2; });
			});
			ASSERT_TRUE(areDrawing) << applications.front().output();
			for (ChildProcess &application : applications) {
				sleep(std::uniform_real_distribution(0.0, 2 * refreshPeriod / rate_)(random));
				kill(application);
			}
			ASSERT_TRUE(isForgotten());
		}
	}
	/// Two applications that stand still at these points are killed at once; the gaps of the second after.
	std::optional<int> killTwoAt(const char *one, const char *other)
	{
		const std::string when = std::string(one) + ", " + other;
		std::vector<ChildProcess> applications;
		for (const char *point : {one, other}) applications.push_back(start(point));
		for (const ChildProcess &application : applications)
			EXPECT_TRUE(application.stopsItself(patience)) << when << "\n" << application.output();
		expectTheWorld(service_, when);
		service_.status(true);
		for (ChildProcess &application : applications) kill(application);
		const auto gaps = gapsInASecond(when.c_str());
		expectTheWorld(service_, when);
		EXPECT_TRUE(isForgotten()) << when;
		return gaps;
	}
	/// Gaps in a second from now, during which no image may be without the cameras. Nothing where others kept the machine so busy that
	/// composing took longer than half a refresh, or the machine's host had it stand still: then gaps say nothing of applications.
	std::optional<int> gapsInASecond(const char *when)
	{
		const double stolenBefore = stolenSeconds();
		const XrTime began = realTime();
		oneSecond();
		const auto frames = service_.status()["frames"];
		const double stolen = (stolenSeconds() - stolenBefore) * double(second) / double(realTime() - began);
		EXPECT_GT(frames["shown"].get<int>(), 5) << when;
		EXPECT_EQ(frames["withoutCamera"], 0) << when;
		if (frames["composeMs"]["p99"].get<double>() * rate_ > refreshPeriod / 2 || stolen > 0.05) return std::nullopt;
		return frames["gaps"];
	}
	/// Gaps per second, of the seconds that can be judged.
	struct Gaps {
		int all = 0, most = 0, judged = 0, unjudged = 0;
		void add(std::optional<int> gaps)
		{
			if (!gaps) {
				unjudged++;
				return;
			}
			judged++, all += *gaps, most = std::max(most, *gaps);
		}
		double mean() const { return judged ? double(all) / judged : 0; }
		void print(const char *when) const
		{
			fmt::print(stderr, "[ FIGURE   ] {}: {} gaps in {} seconds, at most {} in one; in {} more the machine was too busy to say\n",
					   when, all, judged, most, unjudged);
		}
	};
	/// At most one gap in a second in which something happens, less those of as many seconds in which nothing does: the machine's own.
	/// Few seconds say little on a machine that others use too: where they are against us, or fewer than half of them can be judged, up to
	/// four times as many are looked at.
	template <typename Second> void judge(const char *when, int seconds, Second second)
	{
		const int enough = (seconds + 1) / 2;
		Gaps with, without;
		const auto excess = [&] { return with.mean() - without.mean(); };
		for (int round = 0; round < 4 && (with.judged < enough || excess() > 1); ++round) {
			for (int i = 0; i < seconds; ++i) with.add(second());
			if (excess() <= 1) continue;
			for (int i = 0; i < seconds; ++i) {
				service_.status(true);
				without.add(gapsInASecond("nothing happens"));
			}
		}
		with.print(when);
		if (without.judged + without.unjudged > 0) without.print("equal seconds without");
		EXPECT_GE(with.judged, enough) << when << ": nothing is known, the machine was too busy";
		EXPECT_LE(excess(), 1) << when;
	}

	static inline double rate_ = 1; ///< of the clock
	static inline std::optional<PrivateService> running_;
	PrivateService &service_ = *running_;
};

} // namespace

TEST_F(Kills, FiftyKillsLeaveNoGapAndNothingBehind)
{
	std::mt19937 random(7);
	expectTheWorld(service_, "before the first kill");
	killAnywhere(5, random); // they only fill the allocator's caches
	const ProcessUsage before = settledUsage(service_.process().pid());
	killAnywhere(40, random);
	judge("a second after two kills", int(points.size() / 2), [&, next = size_t(0)]() mutable {
		const size_t point = std::exchange(next, (next + 2) % points.size());
		return killTwoAt(points[point], points[point + 1]);
	});
	const ProcessUsage after = settledUsage(service_.process().pid());
	fmt::print(stderr, "[ FIGURE   ] before 50 kills {}\n[ FIGURE   ] after them {}\n", describe(before), describe(after));
	EXPECT_EQ(after.descriptors, before.descriptors);
	EXPECT_EQ(after.threads, before.threads);
	EXPECT_LE(after.mappings, before.mappings);
	EXPECT_LE(after.residentMiB, before.residentMiB + 2);
	EXPECT_EQ(service_.status()["frames"]["withoutCamera"], 0);
}

TEST_F(Kills, AHungApplicationIsLeftOutAndGoesOnLater)
{
	ChildProcess application = start("image released");
	ASSERT_TRUE(application.stopsItself(patience)) << application.output();
	judge("an application hangs", 2, [&] {
		service_.status(true);
		return gapsInASecond("hung");
	});
	expectTheWorld(service_, "hung");
	const uint64_t before = submittedIn(service_.status());
	::kill(application.pid(), SIGCONT);
	EXPECT_TRUE(eventually(service_, [&](const auto &status) { return submittedIn(status) > before + 5; })) << application.output();
	kill(application);
	EXPECT_TRUE(isForgotten());
}

TEST_F(Kills, AConnectionThatSaysNothingIsNoBurden)
{
	std::vector<ipc::Socket> silent;
	for (int i = 0; i < 8; ++i) silent.push_back(connectTo(service_.tree()).value());
	judge("eight connections that say nothing", 2, [&] {
		service_.status(true);
		return gapsInASecond("silent connections");
	});
	expectTheWorld(service_, "silent connections");
}
