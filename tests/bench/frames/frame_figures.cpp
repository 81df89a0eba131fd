// What the whole system costs on this machine, in real time with the synthetic headset. Options are those of other benchmarks, and ignored.
#include "tests/bench/frames/instance_time.h"
#include "tests/bench/frames/shown_frames.h"
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

using namespace arift;
using namespace arift::e2e;

namespace
{

constexpr const char *configuration = "[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"real\"\n[compositor]\ntarget = \"offscreen\"\n";
constexpr auto measured = std::chrono::seconds(5);

double millisecondsSince(XrTime begin) { return double(realTime() - begin) * 1e-6; }

void print(const char *what, const std::string &figure) { std::printf("%-64s %s\n", what, figure.c_str()); }
void print(const char *what, double milliseconds)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.1f ms", milliseconds);
	print(what, text);
}

uint64_t shownOf(const nlohmann::json &status, const std::string &client)
{
	for (const auto &one : status["clients"])
		if (one["name"] == client) return one["shown"];
	return 0;
}

/// Figures of the next seconds, from the service's own record.
void frames(PrivateService &service, const std::string &what)
{
	service.status(true);
	std::this_thread::sleep_for(measured); // the machine is the system's alone while it is measured
	const nlohmann::json status = service.status();
	const nlohmann::json &figures = status["frames"], &compose = figures["composeMs"];
	if (figures["shown"] == 0) throw std::runtime_error(what + ": no frame was shown");
	char text[160];
	std::snprintf(text, sizeof text, "%.1f shown per second (%d missed), composing %.1f ms (p99 %.1f), %.1f ms of CPU per frame",
				  figures["perSecond"].get<double>(), figures["missed"].get<int>(), compose["median"].get<double>(),
				  compose["p99"].get<double>(), figures["cpuMsPerFrame"].get<double>());
	print(what.c_str(), text);
}

/// This process is an application of the service in `tree` from now on.
void enter(const PrivateTree &tree)
{
	for (const auto &[name, value] : tree.environment()) ::setenv(name.c_str(), value.c_str(), 1);
}

void startUp()
{
	const PrivateTree tree;
	enter(tree);
	const ServiceEnd end(tree);
	print("xrCreateInstance, starting the service", instanceMilliseconds());
}

void atWork()
{
	XrTime begin = realTime();
	PrivateService service(configuration);
	if (!eventually(service, [](const auto &status) { return status["frames"]["shown"] > 0; }))
		throw std::runtime_error("no frame is shown:\n" + service.process().output());
	print("service, from its start until its first frame is shown", millisecondsSince(begin));

	enter(service.tree());
	std::array<double, 5> times;
	for (double &time : times) time = instanceMilliseconds();
	std::ranges::sort(times);
	print("xrCreateInstance, the service running", times[2]);

	frames(service, "no application");
	begin = realTime();
	ChildProcess cube = service.start("hologram_cube", {});
	if (!eventually(service, [](const auto &status) { return shownOf(status, "hologram_cube") > 0; }))
		throw std::runtime_error("no frame of hologram_cube is shown:\n" + cube.output());
	print("hologram_cube, from its start until its first frame is shown", millisecondsSince(begin));
	frames(service, "with hologram_cube");
}

} // namespace

int main()
{
	try {
		startUp();
		atWork();
		bench::shownFrames();
		return 0;
	} catch (const std::exception &problem) {
		std::fprintf(stderr, "bench_frames: %s\n", problem.what());
		return 1;
	}
}
