#include "tests/e2e/common/marked_world.h"
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{

std::string markedWorld(double rate)
{
	return fmt::format("[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"scaled\"\nrate = {}\n[compositor]\ntarget = \"offscreen\"\n"
					   "[synthetic]\nmotion = \"rest\"\ncamera_noise = false\n"
					   "[[synthetic.markers]]\nposition = [-0.1, 0.0, -1.0]\nradius = 0.08\n"
					   "[[synthetic.markers]]\nposition = [0.1, 0.0, -1.0]\nradius = 0.08\n",
					   rate);
}

std::array<int, 2> redIn(const PanelPicture &picture)
{
	std::array<int, 2> red{};
	for (size_t i = 0; i < picture.rgba.size() / 4; ++i) {
		const uint8_t *pixel = &picture.rgba[4 * i];
		red[i % picture.width >= picture.width / 2] += pixel[0] > 120 && pixel[1] < pixel[0] / 2 && pixel[2] < pixel[0] / 2;
	}
	return red;
}

void expectTheWorld(PrivateService &service, const std::string &when)
{
	const auto red = redIn(service.screenshot());
	EXPECT_GT(red[0], 300) << when;
	EXPECT_GT(red[1], 300) << when;
}

double affordableRate(double share, const std::function<std::vector<ChildProcess>(PrivateService &)> &start)
{
	constexpr double tried = 0.1;
	PrivateService probe(markedWorld(tried));
	const std::vector<ChildProcess> applications = start(probe);
	eventually(probe, [](const auto &status) { return submittedIn(status) > 3; });
	probe.status(true);
	eventually(probe, [](const auto &status) { return status["frames"]["shown"] > 20; });
	const double cost = probe.status()["frames"]["composeMs"]["median"]; // the p99 of twenty images is the first one
	const double rate = std::clamp(share * refreshPeriod / cost, 0.1, 1.0);
	fmt::print(stderr, "[ FIGURE   ] composing takes {:.1f} ms: the clock runs at {:.2f} of real time\n", cost, rate);
	return rate;
}

uint64_t submittedIn(const nlohmann::json &status)
{
	uint64_t sum = 0;
	for (const auto &client : status["clients"]) sum += client["submitted"].get<uint64_t>();
	return sum;
}

} // namespace arift::e2e
