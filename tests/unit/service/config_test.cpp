#include "drivers/synthetic/settings.h"
#include "runtime/base/error.h"
#include "runtime/service/config.h"
#include "tests/common/temporary_folder.h"
#include <fstream>
#include <gtest/gtest.h>

using namespace arift;
namespace fs = std::filesystem;

namespace
{

class ConfigFile : public testing::Test
{
protected:
	Config read(const std::string &text, const std::vector<std::string> &overrides = {})
	{
		const fs::path file = root_ / "config.toml";
		std::ofstream(file) << text;
		return readConfig(file, overrides);
	}
	std::string problem(const std::string &text, const std::vector<std::string> &overrides = {})
	{
		try {
			read(text, overrides);
			return "no problem";
		} catch (const InputError &error) {
			const std::string what = error.what(), prefix = root_.string() + "/";
			return what.starts_with(prefix) ? what.substr(prefix.size()) : what;
		}
	}
	const test::TemporaryFolder folder_;
	const fs::path root_ = folder_.path();
};

} // namespace

TEST_F(ConfigFile, ReadsEverySetting)
{
	const Config config = read(R"(
[headset]
driver = "synthetic"
rig = "other"
[clock]
mode = "scaled"
rate = 0.25
[passthrough]
distance = 1.5
view_offset = 0
blend_modes = ["alpha_blend", "opaque"]
[space]
eye_height = 1.2
bounds = [3, 4.5]
[compositor]
target = "offscreen"
applications = "by_start"
[swapchains]
images = "copy"
[synthetic]
motion = "rest"
[replay]
recording = "walk"
)");
	EXPECT_EQ(config.driver, "synthetic");
	EXPECT_FALSE(config.nearerOver);
	EXPECT_EQ(config.rig, "other");
	EXPECT_EQ(config.clock, ClockMode::scaled);
	EXPECT_EQ(config.rate, 0.25);
	EXPECT_EQ(config.passthroughDistance, 1.5);
	EXPECT_EQ(config.viewOffset, 0);
	EXPECT_EQ(config.blendModes, (std::vector{XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, XR_ENVIRONMENT_BLEND_MODE_OPAQUE}));
	EXPECT_EQ(config.eyeHeight, 1.2);
	EXPECT_EQ(config.bounds, (std::array{3.0, 4.5}));
	EXPECT_EQ(config.target, TargetKind::offscreen);
	EXPECT_EQ(config.images, ImageSharing::copies);
	EXPECT_EQ(config.recording, root_ / "walk");
}

TEST_F(ConfigFile, AnEmptyFileIsTheDefaults)
{
	const Config config = read("");
	EXPECT_EQ(config.driver, "auto");
	EXPECT_EQ(config.clock, ClockMode::real);
	EXPECT_EQ(config.viewOffset, 1);
	EXPECT_EQ(config.blendModes.size(), 3u);
}

TEST_F(ConfigFile, ComplaintsNamePlaceValueAndWhatWasExpected)
{
	const struct {
		const char *text, *complaint;
	} cases[] = {
		{"[passthrough]\ndistance = -1", "config.toml:2: passthrough.distance = -1, expected a number from 0.1 to 1000"},
		{"[passthrough]\n\nview_offset = 1.5", "config.toml:3: passthrough.view_offset = 1.5, expected a number from 0 to 1"},
		{"[passthrough]\nview_offset = 'eye'", "config.toml:2: passthrough.view_offset = 'eye', expected a number from 0 to 1"},
		{"[clock]\nmode = 'fast'", "config.toml:2: clock.mode = 'fast', expected one of \"real\", \"scaled\", \"stepped\""},
		{"[clock]\nmode = 'real'\nrate = 2", "config.toml:3: clock.rate = 2, expected no rate unless clock.mode = \"scaled\""},
		{"[headset]\ndrive = 'dk1'", "config.toml:2: unknown key headset.drive = 'dk1', expected one of: driver, rig"},
		{"\n[pass_through]\n",
		 "config.toml:2: unknown key pass_through = (a table), expected one of: applications, clock, compositor, headset, "
		 "input, passthrough, replay, space, swapchains, synthetic"},
		{"[dk1]\n", "config.toml:1: unknown key dk1 = (a table), expected one of: applications, clock, compositor, headset, input, "
					"passthrough, replay, space, "
					"swapchains, synthetic"},
		{"[headset]\ndriver = 'dk1'", "config.toml:2: headset.driver = 'dk1', expected one of \"auto\", \"synthetic\", \"replay\""},
		{"[headset]\ndriver = 'synthetic'\n[replay]\nlop = true",
		 "config.toml:4: unknown key replay.lop = true, expected one of: loop, recording"},
		{"headset = 3", "config.toml:1: headset = 3, expected a table"},
	};
	for (const auto &[text, complaint] : cases) EXPECT_EQ(problem(text), complaint) << text;
	const std::string modes = "an array of \"opaque\", \"alpha_blend\" and \"additive\", at least one, none twice";
	EXPECT_EQ(problem("[passthrough]\nblend_modes = []"), "config.toml:2: passthrough.blend_modes = [], expected " + modes);
	EXPECT_TRUE(problem("[passthrough]\nblend_modes = ['opaque', 'opaque']").ends_with(modes));
	EXPECT_TRUE(problem("[passthrough]\nblend_modes = ['glass']").ends_with(modes));
	EXPECT_TRUE(problem("[clock]\nmode = ").starts_with("config.toml:2: ")) << problem("[clock]\nmode = ");
}

TEST_F(ConfigFile, OverridesStandAboveTheFile)
{
	const Config config = read("[clock]\nmode = 'scaled'\nrate = 2\n[passthrough]\ndistance = 3",
							   {"clock.rate=0.5", "headset.driver=synthetic", "passthrough.blend_modes=['opaque']"});
	EXPECT_EQ(config.rate, 0.5);
	EXPECT_EQ(config.driver, "synthetic");
	EXPECT_EQ(config.passthroughDistance, 3);
	EXPECT_EQ(config.blendModes.size(), 1u);
}

TEST_F(ConfigFile, DriversReadOverridesToo)
{
	const Config config = read("[synthetic]\nmotion_file = 'path'\nseed = 1", {"synthetic.seed=7"});
	const synthetic::Settings settings = synthetic::readSettings(config.document);
	EXPECT_EQ(settings.seed, 7u);
	EXPECT_EQ(settings.motionFile, root_ / "path") << "an override leaves the rest of the table as it is";
}

TEST_F(ConfigFile, PathsBeginWhereTheyAreNamed)
{
	const std::string paths = "[replay]\nrecording = 'EuRoC'\n[synthetic]\nmotion_file = '../motion'\ntruth = 'truth.csv'";
	for (const std::vector<std::string> &overrides : {std::vector<std::string>{}, {"clock.mode=stepped"}}) {
		const Config config = read(paths, overrides);
		const synthetic::Settings settings = synthetic::readSettings(config.document);
		EXPECT_EQ(config.recording, root_ / "EuRoC");
		EXPECT_EQ(settings.motionFile, root_ / "../motion");
		EXPECT_EQ(settings.truth, root_ / "truth.csv");
	}
	const Config config = read(paths, {"replay.recording=walk", "synthetic.truth=/tmp/truth"});
	EXPECT_EQ(config.recording, fs::current_path() / "walk");
	EXPECT_EQ(synthetic::readSettings(config.document).truth, "/tmp/truth");
}

TEST_F(ConfigFile, EveryValueIsBlamedOnThePlaceWhereItStands)
{
	const std::string wrong = "synthetic.sample_rate = 300, expected 250, 500 or 1000";
	EXPECT_EQ(problem("[clock]\nmode = 'real'", {"synthetic.sample_rate=300"}), "--set synthetic.sample_rate=300: " + wrong);
	EXPECT_EQ(problem("\n\n[synthetic]\nsample_rate = 300", {"clock.mode=stepped", "synthetic.seed=2"}), "config.toml:4: " + wrong);
	EXPECT_EQ(problem("[synthetic]\nmarkers = 3", {"headset={}"}), "config.toml:2: synthetic.markers = 3, expected an array of tables");
	EXPECT_EQ(problem("", {"synthetic.markers=[{position=[0,0,-1]}]"}),
			  "--set synthetic.markers=[{position=[0,0,-1]}]: synthetic.markers[0].radius is missing, expected a number from 0.001 to 1");
}

TEST_F(ConfigFile, WrongOverridesAreNamed)
{
	EXPECT_EQ(problem("", {"clock.mode"}), "--set clock.mode: expected KEY.PATH=VALUE, for instance --set clock.mode=stepped");
	EXPECT_EQ(problem("", {"clock.mode=fast"}),
			  "--set clock.mode=fast: clock.mode = 'fast', expected one of \"real\", \"scaled\", \"stepped\"");
	EXPECT_TRUE(problem("", {"clock.speed=1"}).starts_with("--set clock.speed=1: unknown key clock.speed"));
	EXPECT_EQ(problem("", {"#=1"}), "--set #=1: expected one KEY.PATH=VALUE");
	EXPECT_EQ(problem("", {"a=1\nb=2"}), "--set a=1\nb=2: expected one KEY.PATH=VALUE");
	EXPECT_EQ(problem("", {"headset=3"}), "--set headset=3: headset = 3, expected a table");
}

TEST_F(ConfigFile, AMissingFileIsNamed) { EXPECT_THROW(readConfig(root_ / "none.toml", {}), InputError); }

TEST_F(ConfigFile, LettersOutsideQuotesAreNamed)
{
	EXPECT_TRUE(problem("[headset]\nrig = \u025emine").starts_with("config.toml:2: "));
	EXPECT_EQ(read("", {"headset.rig=\u00e9t\u00e9"}).rig, "\u00e9t\u00e9") << "a bare word in an override is a text";
}

TEST_F(ConfigFile, SettingsOfSingleApplicationsAreReadByTheirNames)
{
	const fs::path applications = folder_.write("applications.toml", R"(
["X-Plane 12"]
passthrough = "chroma"
color = "FF00FF"
tolerance = 0.2
softness = 0.05
opacity = 0.75
[hello_xr]
blend_modes = ["alpha_blend", "opaque"]
)");
	const fs::path programs = folder_.write("overrides.toml", "[applications.\"X-Plane 12\"]\ncolor = \"0000ff\"\n");
	const ApplicationTable all = readConfig({}, {}, {applications, programs}).applications;
	ASSERT_EQ(all.size(), 2u);
	const ForcedPassthrough expected{ipc::Forced::chroma, {{0, 0, 1}, 0.2f, 0.05f}, 0.75f};
	EXPECT_EQ(all.at("X-Plane 12").passthrough, expected);
	EXPECT_TRUE(all.at("X-Plane 12").blendModes.empty());
	EXPECT_EQ(all.at("hello_xr").passthrough, ForcedPassthrough{});
	EXPECT_EQ(all.at("hello_xr").blendModes, (std::vector{XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, XR_ENVIRONMENT_BLEND_MODE_OPAQUE}));
}

TEST_F(ConfigFile, WrongSettingsOfAnApplicationAreExplained)
{
	const auto complaint = [&](const std::string &line) {
		const fs::path file = folder_.write("applications.toml", "[game]\n" + line + "\n");
		try {
			readConfig({}, {}, {.applications = file});
			return std::string("no problem");
		} catch (const InputError &error) {
			return std::string(error.what()).substr(root_.string().size() + 1);
		}
	};
	EXPECT_EQ(complaint("passthrough = \"green\""),
			  "applications.toml:2: applications.game.passthrough = 'green', expected one of \"off\", \"alpha\", \"chroma\", \"underlay\"");
	EXPECT_EQ(complaint("color = \"green\""),
			  "applications.toml:2: applications.game.color = 'green', expected six hexadecimal digits, RRGGBB");
	EXPECT_EQ(complaint("tolerance = 2"), "applications.toml:2: applications.game.tolerance = 2, expected a number from 0 to 1");
	EXPECT_EQ(complaint("opacity = -1"), "applications.toml:2: applications.game.opacity = -1, expected a number from 0 to 1");
	EXPECT_EQ(complaint("colour = 1"),
			  "applications.toml:2: unknown key applications.game.colour = 1, expected one of: blend_modes, color, opacity, passthrough, "
			  "softness, tolerance");
}
