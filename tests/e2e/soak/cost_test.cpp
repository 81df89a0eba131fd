// What more work costs the service: a table, and that nothing in it grows faster than the work does.
#include "tests/e2e/common/marked_world.h"
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace arift::e2e
{
namespace
{

struct Load {
	int applications = 1;
	const char *content = "translucent";
	int quads = 0;
	const char *kind = "shown";
	const char *scale = "1";
};

/// A service slow enough for all of it; costs are those of its processor time, not of the clock on the wall.
class Cost : public testing::Test
{
protected:
	static constexpr double rate = 0.1;

	/// The service's processor time per panel image, ms; the best of three looks. Prints it.
	double of(const Load &load, const char *images = "auto")
	{
		PrivateService &service = serviceFor(images);
		std::vector<ChildProcess> applications;
		for (int i = 0; i < load.applications; ++i)
			applications.push_back(
				service.start("clearing_application", {load.content, std::to_string(load.quads), load.kind, load.scale}));
		const bool areShown = eventually(service, [&](const auto &status) {
			return int(status["clients"].size()) == load.applications &&
				   std::ranges::all_of(status["clients"], [](const auto &client) { return client["shown"] > 4; });
		});
		EXPECT_TRUE(areShown || load.applications == 0) << (applications.empty() ? "" : applications.front().output());
		double best = 1e9, planning = 0;
		for (int look = 0; look < 3; ++look) {
			service.status(true);
			eventually(service, [](const auto &status) { return status["frames"]["shown"] >= 8; });
			const auto frames = service.status()["frames"];
			if (frames["cpuMsPerFrame"].get<double>() > best) continue;
			best = frames["cpuMsPerFrame"];
			planning = frames["stagesMs"]["plan"]["median"];
		}
		applications.clear();
		eventually(service, [](const auto &status) { return status["clients"].empty(); });
		fmt::print(stderr,
				   "[ FIGURE   ] {} application(s), {} view of scale {}, {:2} {} quads, images {}: {:6.1f} ms of the service's CPU, "
				   "planning {:.1f}\n",
				   load.applications, load.content, load.scale, load.quads, load.kind, images, best, planning);
		return best;
	}
	/// Twice the work costs at most twice as much more, within what is measured twice alike.
	static void expectLinear(double none, double some, double more, double times, const char *what)
	{
		EXPECT_LE(more - none, 1.25 * times * std::max(some - none, 0.0) + 3) << what;
	}

private:
	PrivateService &serviceFor(const char *images)
	{
		auto &service = services_[images];
		if (!service) {
			// Few camera images: simulating them is not what is measured.
			service.emplace(fmt::format("[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"scaled\"\nrate = {}\n[compositor]\n"
										"target = \"offscreen\"\n[swapchains]\nimages = \"{}\"\n[synthetic]\nmotion = \"rest\"\n"
										"camera_noise = false\ncamera_rate = 6\n",
										rate, images));
			eventually(*service, [](const auto &status) { return status["frames"]["shown"] > 20; });
		}
		return *service;
	}
	std::map<std::string, std::optional<PrivateService>> services_;
};

TEST_F(Cost, LayersCostWhatIsSeenOfThem)
{
	const double none = of({.quads = 0});
	std::map<int, double> shown;
	for (const int quads : {1, 4, 16, 63}) shown[quads] = of({.quads = quads});
	const double hidden = of({.quads = 63, .kind = "hidden"}), empty = of({.quads = 63, .kind = "empty"});
	expectLinear(none, shown[4], shown[16], 4, "four times the layers");
	expectLinear(none, shown[16], shown[63], 4, "four times the layers, over each other");
	EXPECT_LE(hidden - none, 0.2 * (shown[63] - none) + 3) << "layers that no eye sees";
	EXPECT_LE(empty - none, 0.2 * (shown[63] - none) + 3) << "layers with nothing in them";
}

TEST_F(Cost, ApplicationsCostWhatTheyShow)
{
	std::map<int, double> cost;
	for (const int applications : {0, 1, 2, 4, 8})
		cost[applications] = of({.applications = applications, .content = "transparent", .quads = 1});
	expectLinear(cost[0], cost[2], cost[8], 4, "four times the applications");
}

TEST_F(Cost, LargerImagesCostNoMoreThanTheirSize)
{
	for (const char *images : {"auto", "copy"}) {
		const double none = of({.applications = 0}, images), small = of({.content = "opaque", .scale = "0.5"}, images),
					 usual = of({.content = "opaque"}, images), large = of({.content = "opaque", .scale = "2"}, images);
		expectLinear(none, small, usual, 4, images);
		expectLinear(none, usual, large, 4, images);
	}
}

} // namespace
} // namespace arift::e2e
