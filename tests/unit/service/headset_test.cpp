// Which Rig a configuration asks for, and what is said where there is none.
#include "runtime/base/error.h"
#include "runtime/service/headset.h"
#include "tests/common/temporary_folder.h"
#include <fstream>
#include <gtest/gtest.h>

using namespace arift;
namespace fs = std::filesystem;

namespace
{

class RigOfConfig : public testing::Test
{
protected:
	void write(const fs::path &name, const std::string &text)
	{
		fs::create_directories((root_ / name).parent_path());
		std::ofstream(root_ / name) << text;
	}
	Rig rig(const std::string &config, const std::vector<std::string> &overrides = {})
	{
		write("config.toml", config);
		return rigFor(readConfig(root_ / "config.toml", overrides));
	}
	std::string problem(const std::string &config, const std::vector<std::string> &overrides = {})
	{
		try {
			rig(config, overrides);
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

TEST_F(RigOfConfig, IsTheShippedOneByDefault) { EXPECT_EQ(rigFor({}).cameras.size(), 2u); }

TEST_F(RigOfConfig, APathBeginsBesideTheConfiguration)
{
	write("rigs/mine.toml", "version = 1\nname = \"mine\"\n");
	EXPECT_EQ(rig("[headset]\nrig = 'rigs/mine.toml'").name, "mine");
	EXPECT_EQ(rig("[headset]\nrig = 'rigs/mine.toml'", {"clock.mode=stepped"}).name, "mine");
	EXPECT_EQ(rig("", {"headset.rig=" + (root_ / "rigs/mine.toml").string()}).name, "mine");
}

TEST_F(RigOfConfig, ComplaintsNamePlaceAndValue)
{
	const std::string here = root_.string() + "/";
	EXPECT_EQ(problem("[headset]\n\nrig = 'no.toml'"),
			  "config.toml:3: headset.rig = 'no.toml', expected a rig, and " + here + "no.toml is no file");
	EXPECT_EQ(problem("", {"headset.rig=no.toml"}), "--set headset.rig=no.toml: headset.rig = 'no.toml', expected a rig, and " +
														(fs::current_path() / "no.toml").string() + " is no file");
	EXPECT_TRUE(problem("[headset]\nrig = 'nobody'").starts_with("config.toml:2: headset.rig = 'nobody', expected the name of a rig in /"));
	EXPECT_TRUE(problem("[headset]\nrig = 'recording'")
					.starts_with("config.toml:2: headset.rig = 'recording', expected headset.driver = \"replay\" and a replay.recording"));
}
