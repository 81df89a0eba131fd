// The arift command: what it says, shows and changes.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace arift::e2e;
namespace fs = std::filesystem;

TEST(Command, WithoutAServiceSaysSo)
{
	const PrivateTree tree;
	for (const char *command : {"status", "recenter", "stop"}) {
		const Ran ran = runArift(tree, {command});
		EXPECT_EQ(ran.status, 1) << command;
		EXPECT_NE(ran.output.find("no arift-service listens on"), std::string::npos) << ran.output;
	}
}

TEST(Command, WrongUseIsExplained)
{
	const PrivateTree tree;
	for (const auto &arguments :
		 std::vector<std::vector<std::string>>{{}, {"fly"}, {"screenshot"}, {"set", "brightness", "1"}, {"set", "view_offset", "eye"}})
		EXPECT_GT(runArift(tree, arguments).status, 1);
}

TEST(Command, ShowsStatusTakesPicturesAndStops)
{
	PrivateService service("[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"stepped\"\n[compositor]\ntarget = \"offscreen\"\n");
	const PrivateTree &tree = service.tree();
	const Ran json = runArift(tree, {"status", "--json"});
	EXPECT_EQ(json.status, 0) << json.output;
	EXPECT_EQ(nlohmann::json::parse(json.output)["headset"]["driver"], "synthetic");
	EXPECT_NE(runArift(tree, {"status"}).output.find("synthetic headset"), std::string::npos);

	const fs::path picture = tree.root() / "panel.png";
	const Ran shot = runArift(tree, {"screenshot", picture.string()});
	EXPECT_EQ(shot.status, 0) << shot.output;
	EXPECT_EQ(contentOf(picture).substr(0, 8), "\x89PNG\r\n\x1a\n");
	EXPECT_GT(fs::file_size(picture), 50'000u);
	const Ran nowhere = runArift(tree, {"screenshot", (tree.root() / "no/such/folder.png").string()});
	EXPECT_EQ(nowhere.status, 1);
	EXPECT_NE(nowhere.output.find("no/such/folder.png"), std::string::npos) << nowhere.output;

	EXPECT_EQ(runArift(tree, {"set", "view_offset", "0.5"}).status, 0);
	EXPECT_NE(contentOf(tree.root() / "config/arift/overrides.toml").find("view_offset = 0.5"), std::string::npos) << "for the next start";
	const Ran wrong = runArift(tree, {"set", "view_offset", "7"});
	EXPECT_EQ(wrong.status, 1);
	EXPECT_NE(wrong.output.find("expected a number from 0 (eye) to 1 (camera)"), std::string::npos) << wrong.output;
	EXPECT_EQ(runArift(tree, {"recenter"}).status, 0);
	EXPECT_EQ(runArift(tree, {"stop"}).status, 0);
	EXPECT_EQ(service.process().wait(std::chrono::seconds(60)), 0);
}

TEST(Command, RegistersAndPutsBackWhatWasThere)
{
	const PrivateTree tree;
	const fs::path manifest = programDirectory().parent_path() / "openxr_arift.json";
	if (!fs::exists(manifest)) GTEST_SKIP() << manifest << " is not built";
	const fs::path active = tree.write("config/openxr/1/active_runtime.json", "{\"theirs\": true}");
	const fs::path native = active.parent_path() / "active_runtime.x86_64.json";
	EXPECT_EQ(runArift(tree, {"register"}).status, 0);
	EXPECT_EQ(fs::canonical(active), fs::canonical(manifest));
	EXPECT_EQ(fs::canonical(native), fs::canonical(manifest));
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "{\"theirs\": true}");
	EXPECT_EQ(runArift(tree, {"register", "--user"}).status, 0) << "twice does no harm";
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "{\"theirs\": true}");
	EXPECT_EQ(runArift(tree, {"unregister"}).status, 0);
	EXPECT_EQ(contentOf(active), "{\"theirs\": true}");
	EXPECT_FALSE(fs::exists(native));
	EXPECT_EQ(runArift(tree, {"unregister"}).status, 0);
	EXPECT_EQ(contentOf(active), "{\"theirs\": true}") << "not ours: left alone";
}

TEST(Command, DoesNotLoseASecondBackup)
{
	const PrivateTree tree;
	const fs::path active = tree.write("config/openxr/1/active_runtime.json", "second");
	tree.write("config/openxr/1/active_runtime.json.arift-backup", "first");
	EXPECT_EQ(runArift(tree, {"register"}).status, 1);
	EXPECT_EQ(contentOf(active), "second") << "a command that fails has changed nothing";
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "first");
}
