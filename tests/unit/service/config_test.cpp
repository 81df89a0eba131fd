#include "runtime/base/error.h"
#include "runtime/service/config.h"
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace arift;
namespace fs = std::filesystem;

namespace
{

class ConfigFile : public testing::Test
{
protected:
	ConfigFile()
	{
		char name[] = "/tmp/arift-test-XXXXXX";
		root_ = ::mkdtemp(name);
	}
	~ConfigFile() override { fs::remove_all(root_); }

	Config read(const std::string &text, const std::vector<std::string> &overrides = {})
	{
		const fs::path file = root_ / "config.toml";
		std::ofstream(file) << text;
		return readConfig(file, overrides, root_ / "merged.toml");
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
	fs::path root_;
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
[compositor]
target = "offscreen"
[synthetic]
anything = "the driver checks it"
)");
	EXPECT_EQ(config.driver, "synthetic");
	EXPECT_EQ(config.rig, "other");
	EXPECT_EQ(config.clock, ClockMode::scaled);
	EXPECT_EQ(config.rate, 0.25);
	EXPECT_EQ(config.passthroughDistance, 1.5);
	EXPECT_EQ(config.viewOffset, 0);
	EXPECT_EQ(config.blendModes, (std::vector{XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, XR_ENVIRONMENT_BLEND_MODE_OPAQUE}));
	EXPECT_EQ(config.target, TargetKind::offscreen);
	EXPECT_EQ(config.file, root_ / "config.toml");
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
		{"[headset]\ndrive = 'dk1'", "config.toml:2: unknown key headset.drive = 'dk1'"},
		{"\n[pass_through]\n", "config.toml:2: unknown key pass_through = (a table)"},
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

TEST_F(ConfigFile, DriversFindOverridesInTheMergedFile)
{
	std::ofstream(root_ / "path.csv") << "";
	const Config config = read("[synthetic]\nmotion_file = 'path.csv'\nseed = 1", {"synthetic.seed=7"});
	EXPECT_EQ(config.file, root_ / "merged.toml");
	std::stringstream merged;
	merged << std::ifstream(config.file).rdbuf();
	EXPECT_NE(merged.str().find("seed = 7"), std::string::npos) << merged.str();
	EXPECT_NE(merged.str().find((root_ / "path.csv").string()), std::string::npos) << "a relative path keeps its meaning: " << merged.str();
}

TEST_F(ConfigFile, WrongOverridesAreNamed)
{
	EXPECT_EQ(problem("", {"clock.mode"}), "--set clock.mode: expected KEY.PATH=VALUE, for instance --set clock.mode=stepped");
	EXPECT_EQ(problem("", {"clock.mode=fast"}),
			  "--set clock.mode=fast: clock.mode = 'fast', expected one of \"real\", \"scaled\", \"stepped\"");
	EXPECT_TRUE(problem("", {"clock.speed=1"}).starts_with("--set clock.speed=1: unknown key clock.speed"));
}

TEST_F(ConfigFile, AMissingFileIsNamed) { EXPECT_THROW(readConfig(root_ / "none.toml", {}, root_ / "merged.toml"), InputError); }
