// Settings that programs change: kept, above the user's own and without touching them.
#include "runtime/base/error.h"
#include "runtime/service/config.h"
#include "runtime/service/overrides.h"
#include "tests/common/temporary_folder.h"
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace arift
{
namespace
{

namespace fs = std::filesystem;

struct OverridesFile : testing::Test {
	const test::TemporaryFolder folder;
	const fs::path file = folder.path() / "arift/overrides.toml";
	Overrides overrides{file};

	static std::string contentOf(const fs::path &path)
	{
		std::ostringstream text;
		text << std::ifstream(path).rdbuf();
		return text.str();
	}
};

TEST_F(OverridesFile, StandAboveTheUsersOwnAndBelowTheCommandLine)
{
	const std::string users = "[passthrough]\nview_offset = 0.75\ndistance = 3.0\n";
	const fs::path own = folder.write("config.toml", users);
	overrides.keep({"passthrough"}, {{"view_offset", 0.3f}});
	EXPECT_EQ(readConfig(own, {}, {.programs = file}).viewOffset, 0.3) << "as it was typed";
	EXPECT_EQ(readConfig(own, {}, {.programs = file}).passthroughDistance, 3.0);
	EXPECT_EQ(readConfig({}, {}, {.programs = file}).viewOffset, 0.3);
	EXPECT_EQ(readConfig(own, {"passthrough.view_offset=0.5"}, {.programs = file}).viewOffset, 0.5);
	EXPECT_EQ(contentOf(own), users);
	EXPECT_EQ(readConfig(own, {}, {.programs = folder.path() / "none.toml"}).viewOffset, 0.75) << "no program has changed anything yet";
}

TEST_F(OverridesFile, EverySettingIsKeptWhenAnotherChanges)
{
	overrides.keep({"passthrough"}, {{"view_offset", 0.25f}});
	overrides.keep({"passthrough"}, {{"distance", 1.5f}});
	overrides.keep({"passthrough"}, {{"view_offset", 1.0f}});
	const Config config = readConfig({}, {}, {.programs = file});
	EXPECT_EQ(config.viewOffset, 1.0);
	EXPECT_EQ(config.passthroughDistance, 1.5);
	EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1) << "nothing is left beside it";
}

TEST_F(OverridesFile, WhatIsSetForAnApplicationIsKeptUnderItsName)
{
	const fs::path applications = folder.write("applications.toml", "[\"A game\"]\nopacity = 0.5\npassthrough = \"alpha\"\n");
	overrides.keep({"applications", "A game"}, {{"passthrough", "chroma"}, {"tolerance", 0.3f}, {"color", "112233"}});
	const ForcedPassthrough found = readConfig({}, {}, {applications, file}).applications.at("A game").passthrough;
	EXPECT_EQ(found.mode, ipc::Forced::chroma);
	EXPECT_EQ(found.key.tolerance, 0.3f);
	EXPECT_EQ(textOf(found.key.colour), "112233");
	EXPECT_EQ(found.opacity, 0.5f) << "the user's own";
}

TEST_F(OverridesFile, ADamagedOneIsNamedAndLeftAlone)
{
	folder.write("arift/overrides.toml", "passthrough = 3\n");
	for (const auto &attempt : {std::function<void()>([&] { readConfig({}, {}, {.programs = file}); }), std::function<void()>([&] {
									overrides.keep({"passthrough"}, {{"view_offset", 0.0f}});
								})}) {
		try {
			attempt();
			FAIL() << "not noticed";
		} catch (const InputError &error) {
			EXPECT_NE(std::string(error.what()).find("overrides.toml"), std::string::npos) << error.what();
		}
	}
	EXPECT_EQ(contentOf(file), "passthrough = 3\n");
}

TEST_F(OverridesFile, NamesMayBeAnything)
{
	const std::string greek = "\xCE\xB3\xCE\xBD\xE1\xBD\xB9\xCE\xBC\xCE\xB7", quoted = "a \"game\".\n[x]", noText = "\xff\xfe";
	for (const std::string &name : {greek, quoted, noText}) overrides.keep({"applications", name}, {{"passthrough", "alpha"}});
	const auto found = readConfig({}, {}, {.programs = file}).applications;
	EXPECT_EQ(found.size(), 3u) << "what is no UTF-8 does not make the rest unreadable";
	EXPECT_TRUE(found.contains(greek));
	EXPECT_TRUE(found.contains(quoted));
}

TEST_F(OverridesFile, WhatCannotBeWrittenIsNamed)
{
	folder.write("arift", "a file where the folder should be");
	EXPECT_THROW(overrides.keep({"passthrough"}, {{"view_offset", 0.0f}}), InputError);
}

} // namespace
} // namespace arift
