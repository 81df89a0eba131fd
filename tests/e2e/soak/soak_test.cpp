// Long runs: what is used stays used, what was fast stays fast, the world never goes dark.
#include "tests/e2e/common/marked_world.h"
#include "tests/e2e/common/process_usage.h"
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace arift::e2e
{
namespace
{

XrDuration durationOr(XrDuration usual)
{
	const char *seconds = std::getenv("ARIFT_SOAK_SECONDS");
	return seconds && *seconds ? std::atol(seconds) * second : usual;
}

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

nlohmann::json clientNamed(const nlohmann::json &status, const std::string &name)
{
	for (const auto &client : status["clients"])
		if (client["name"] == name) return client;
	return {};
}

/// One part of a run: what the service and an application that stays did in it.
struct Window {
	double framesPerSecond = 0;                                            ///< of the system's clock
	double composeMs = 0, slowestMs = 0, latencyMs = 0, cpuMsPerFrame = 0; ///< slowest: composing, all but one image of a hundred
	double shownPerFrame = 0;                                              ///< frames of the application per panel image
	ProcessUsage service, application;                                     ///< the least of each seen in it
};

ProcessUsage least(const ProcessUsage &a, const ProcessUsage &b)
{
	return {std::min(a.descriptors, b.descriptors), std::min(a.mappings, b.mappings), std::min(a.threads, b.threads),
			std::min(a.residentMiB, b.residentMiB)};
}

/// Measures windows one after another of a service and of the application that is called `name`.
class Watch
{
public:
	Watch(PrivateService &service, std::string name, int pid) : service_(service), name_(std::move(name)), pid_(pid) {}

	/// A window of so many seconds (real time), in which `act` is called about once a second.
	template <typename Act> Window window(double seconds, Act act)
	{
		Window window;
		const auto before = clientNamed(service_.status(true), name_);
		window.service = usageOf(service_.process().pid());
		window.application = usageOf(pid_);
		for (const XrTime end = realTime() + fromSeconds(seconds); realTime() < end;) {
			act();
			window.service = least(window.service, usageOf(service_.process().pid()));
			window.application = least(window.application, usageOf(pid_));
		}
		const auto status = service_.status();
		const auto &frames = status["frames"], after = clientNamed(status, name_);
		EXPECT_FALSE(after.is_null()) << name_ << " has gone";
		EXPECT_EQ(frames["withoutCamera"], 0);
		if (after.is_null()) return window;
		window.framesPerSecond = frames["perSecond"];
		window.composeMs = frames["composeMs"]["median"];
		window.slowestMs = frames["composeMs"]["p99"];
		window.cpuMsPerFrame = frames["cpuMsPerFrame"];
		window.latencyMs = after["latencyMs"]["median"];
		window.shownPerFrame = double(after["shown"].get<uint64_t>() - before["shown"].get<uint64_t>()) / frames["shown"].get<double>();
		fmt::print(stderr,
				   "[ FIGURE   ] {:5.0f} s: {:.2f} frames per second, {:.3f} of them new by {}, composing {:.1f} ms, {:.1f} ms of CPU, "
				   "seen {:.1f} "
				   "ms after they came; service {}; application {}\n",
				   inSeconds(realTime() - begun_), window.framesPerSecond, window.shownPerFrame, name_, window.composeMs,
				   window.cpuMsPerFrame, window.latencyMs, describe(window.service), describe(window.application));
		return window;
	}

private:
	PrivateService &service_;
	const std::string name_;
	const int pid_;
	const XrTime begun_ = realTime();
};

void expectFlat(const ProcessUsage &first, const ProcessUsage &last, const char *whose)
{
	EXPECT_LE(last.descriptors, first.descriptors) << whose;
	EXPECT_LE(last.threads, first.threads) << whose;
	EXPECT_LE(last.mappings, first.mappings + 32) << whose << ": allocators take a few more for pictures";
	EXPECT_LE(last.residentMiB, first.residentMiB + 2) << whose;
}

TEST(Soak, FourApplicationsOfWhichThreeMisbehave)
{
	constexpr int windows = 6;
	const double seconds = inSeconds(durationOr(600 * second)) / windows;
	const double rate = affordableRate(0.2, [](PrivateService &service) {
		std::vector<ChildProcess> one;
		one.push_back(service.start("clearing_application", {"transparent", "0"}));
		return one;
	});
	PrivateService service(markedWorld(rate));
	ChildProcess steady = service.start("clearing_application", {"transparent", "0"});
	ASSERT_TRUE(eventually(service, [](const auto &status) { return submittedIn(status) > 30; })) << steady.output();
	Watch watch(service, "clearing_application", steady.pid());
	const Window alone = watch.window(seconds, [] { sleep(1); });

	const ChildProcess one = service.start("stopping_application", {"after xrBeginFrame", "5"}),
					   other = service.start("stopping_application", {"image released", "5"});
	for (const ChildProcess *hung : {&one, &other}) ASSERT_TRUE(hung->stopsItself(std::chrono::minutes(1))) << hung->output();
	std::optional<ChildProcess> killed;
	int kills = 0;
	const auto act = [&] {
		if (killed) {
			::kill(killed->pid(), SIGKILL);
			killed->wait(std::chrono::seconds(10));
			++kills;
		}
		killed.reset();
		killed.emplace(service.start("stopping_application", {"never", "0"}));
		sleep(1);
		if (kills % 5 == 0) expectTheWorld(service, fmt::format("after {} kills", kills));
	};
	Window first, last;
	std::vector<double> rates; ///< of the fourth, frames per second of the clock
	for (int i = 1; i < windows; ++i) {
		last = watch.window(seconds, act);
		if (i <= 2) first = last; // caches have filled by then
		rates.push_back(last.framesPerSecond * last.shownPerFrame);
	}
	std::ranges::sort(rates); // in one window or another the machine may have had something else to do
	EXPECT_GE(rates[rates.size() / 2], 0.9 * alone.framesPerSecond * alone.shownPerFrame) << "the fourth keeps its frame rate";
	fmt::print(stderr, "[ FIGURE   ] {} kills\n", kills);
	EXPECT_GT(kills, windows);
	expectFlat(first.service, last.service, "the service");
	expectFlat(first.application, last.application, "the application that behaves");
}

/// Everything: two applications that draw, live cameras, pictures, settings, recentring.
TEST(Soak, EverythingForAnHour)
{
	const double seconds = inSeconds(durationOr(3600 * second)), part = std::min(60.0, seconds / 4);
	const double rate = affordableRate(0.2, [](PrivateService &service) {
		std::vector<ChildProcess> both;
		both.push_back(service.start("clearing_application", {"translucent", "4"}));
		both.push_back(service.start("hologram_cube", {}));
		return both;
	});
	PrivateService service(markedWorld(rate));
	ChildProcess clearing = service.start("clearing_application", {"translucent", "4"});
	const ChildProcess cube = service.start("hologram_cube", {});
	ASSERT_TRUE(eventually(service, [](const auto &status) { return submittedIn(status) > 60; })) << clearing.output() << cube.output();
	Watch watch(service, "clearing_application", clearing.pid());
	int acts = 0;
	const auto act = [&] {
		service.recenter();
		service.set(ipc::Setting::viewOffset, float(acts % 2));
		service.set(ipc::Setting::rawPassthrough, acts % 10 == 9 ? 1 : 0);
		if (acts % 10 == 5) service.screenshot(acts % 20 == 5 ? ipc::PictureKind::panel : ipc::PictureKind::eyes);
		++acts;
		sleep(1);
	};
	watch.window(part / 2, act); // caches fill
	std::vector<Window> windows;
	for (double gone = 0; gone + part <= seconds; gone += part) windows.push_back(watch.window(part, act));
	const Window &first = windows.front(), &last = windows.back();
	// Where others kept the machine so busy that one image in a hundred took longer than a refresh, frames say nothing of growth.
	const auto isJudged = [&](const Window &window) { return window.slowestMs * rate < refreshPeriod; };
	EXPECT_GT(2 * std::ranges::count_if(windows, isJudged), std::ssize(windows)) << "the machine was too busy to say";
	for (const Window &window : windows) {
		if (!isJudged(window)) continue;
		EXPECT_GE(window.framesPerSecond, 0.98 * first.framesPerSecond);
		EXPECT_GE(window.shownPerFrame, 0.98 * first.shownPerFrame);
	}
	expectFlat(first.service, last.service, "the service");
	expectFlat(first.application, last.application, "an application");
	// The least of a quarter's windows: what others on the machine add is not there in every minute, what has grown is.
	const auto leastOf = [&](auto begin, auto end, double Window::*value) {
		return std::ranges::min(std::ranges::subrange(begin, end), {}, value).*value;
	};
	const auto quarter = std::max<std::ptrdiff_t>(1, std::ssize(windows) / 4);
	for (const auto value : {&Window::latencyMs, &Window::composeMs})
		EXPECT_LE(leastOf(windows.end() - quarter, windows.end(), value),
				  1.1 * leastOf(windows.begin(), windows.begin() + quarter, value) + 1);
}

} // namespace
} // namespace arift::e2e
