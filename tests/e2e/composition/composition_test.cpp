// Compositions that Khronos' conformance suite shows to people, compared with what must be seen: submitted through OpenXR, composed by the
// service, and computed a second time.
#include "tests/e2e/common/private_service.h"
#include "tests/e2e/composition/expected_panel.h"
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

constexpr auto quietWorld = "[headset]\ndriver = \"synthetic\"\n[compositor]\ntarget = \"offscreen\"\n"
							"[synthetic]\nmotion = \"rest\"\ntracker_noise = false\n";

/// The panel while the application shows a composition.
PanelPicture shown(PrivateService &service, size_t number)
{
	ChildProcess application = service.start("composition_application", {std::to_string(number)});
	const bool isShown = eventually(service, [](const auto &status) {
		return !status["clients"].empty() && status["clients"][0]["shown"] > 5 && status["frames"]["leftOut"] == 0;
	});
	EXPECT_TRUE(isShown) << application.output() << service.process().output();
	PanelPicture picture = service.screenshot();
	EXPECT_EQ(application.stop(std::chrono::seconds(20)), 0) << application.output();
	EXPECT_TRUE(eventually(service, [](const auto &status) { return status["clients"].empty(); }));
	return picture;
}

struct Differences {
	int compared = 0, lit = 0, atEdges = 0, wrong = 0; ///< at edges: differ, and may
	double largest = 0;                                ///< of those that may not
	std::string where;                                 ///< it is
};
Differences differences(const PanelPicture &picture, const ExpectedPanel &expected)
{
	Differences all;
	for (uint32_t y = 1; y < picture.height; y += 4)
		for (uint32_t x = 1; x < picture.width; x += 4) {
			const auto wanted = expected.at({x + 0.5, y + 0.5});
			if (!wanted) continue;
			++all.compared;
			const uint8_t *found = &picture.rgba[4 * (size_t(y) * picture.width + x)];
			double worst = 0;
			for (size_t channel = 0; channel < 3; ++channel) worst = std::max(worst, std::abs(found[channel] - (*wanted)[channel]));
			all.lit += (*wanted)[0] + (*wanted)[1] + (*wanted)[2] > 0;
			const bool differs = worst > 3, isAtAnEdge = differs && expected.isAtAnEdge({x + 0.5, y + 0.5});
			all.atEdges += isAtAnEdge;
			all.wrong += differs && !isAtAnEdge;
			if (isAtAnEdge || worst <= all.largest) continue;
			all.largest = worst;
			all.where = fmt::format("({}, {}): found {} {} {}, expected {:.1f} {:.1f} {:.1f}", x, y, found[0], found[1], found[2],
									(*wanted)[0], (*wanted)[1], (*wanted)[2]);
		}
	return all;
}

TEST(Compositions, AreShownAsTheSpecificationSays)
{
	PrivateService service(quietWorld);
	service.set(ipc::Setting::viewOffset, 0);
	const reference::RigNumbers rig = reference::readRigNumbers(ARIFT_SOURCE_DIR "/calib/rigs/arift.toml");
	for (size_t number = 0; number < compositions().size(); ++number) {
		const Composition &composition = compositions()[number];
		const Differences found = differences(shown(service, number), ExpectedPanel(composition, rig));
		fmt::print(
			stderr,
			"[ FIGURE   ] {}: of {} pixels, {} of them lit, {} differ by more than 3 of 255 at edges and {} elsewhere, there at most "
			"by {:.1f}\n",
			composition.name, found.compared, found.lit, found.atEdges, found.wrong, found.largest);
		EXPECT_EQ(found.wrong, 0) << composition.name << " at " << found.where;
		EXPECT_LT(found.atEdges, found.lit / 20) << composition.name;
		EXPECT_GT(found.compared, 40000) << composition.name;
		EXPECT_GT(found.lit, 800) << composition.name;
	}
}

} // namespace
} // namespace arift::e2e
