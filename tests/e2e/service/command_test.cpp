// The arift command, and the service it and applications start.
#include "tests/e2e/common/private_service.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace arift::e2e;
namespace fs = std::filesystem;

namespace
{

struct Ran {
	int status = -1;
	std::string output;
};

Ran run(const PrivateTree &tree, std::vector<std::string> arguments)
{
	arguments.insert(arguments.begin(), (programDirectory() / "arift").string());
	ChildProcess command(arguments, tree.environment(), tree.root() / "command.log");
	const auto status = command.wait(std::chrono::seconds(90));
	return {status.value_or(-1), command.output()};
}

std::string contentOf(const fs::path &file)
{
	std::stringstream text;
	text << std::ifstream(file).rdbuf();
	return text.str();
}

} // namespace

TEST(Command, WithoutAServiceSaysSo)
{
	const PrivateTree tree;
	for (const char *command : {"status", "recenter", "stop"}) {
		const Ran ran = run(tree, {command});
		EXPECT_EQ(ran.status, 1) << command;
		EXPECT_NE(ran.output.find("no arift-service listens on"), std::string::npos) << ran.output;
	}
}

TEST(Command, WrongUseIsExplained)
{
	const PrivateTree tree;
	for (const auto &arguments :
		 std::vector<std::vector<std::string>>{{}, {"fly"}, {"screenshot"}, {"set", "brightness", "1"}, {"set", "view_offset", "eye"}})
		EXPECT_GT(run(tree, arguments).status, 1);
}

TEST(Command, ShowsStatusTakesPicturesAndStops)
{
	PrivateService service("[headset]\ndriver = \"synthetic\"\n[clock]\nmode = \"stepped\"\n[compositor]\ntarget = \"offscreen\"\n");
	const PrivateTree &tree = service.tree();
	const Ran json = run(tree, {"status", "--json"});
	EXPECT_EQ(json.status, 0) << json.output;
	EXPECT_EQ(nlohmann::json::parse(json.output)["headset"]["driver"], "synthetic");
	EXPECT_NE(run(tree, {"status"}).output.find("synthetic headset"), std::string::npos);

	const fs::path picture = tree.root() / "panel.png";
	const Ran shot = run(tree, {"screenshot", picture.string()});
	EXPECT_EQ(shot.status, 0) << shot.output;
	EXPECT_EQ(contentOf(picture).substr(0, 8), "\x89PNG\r\n\x1a\n");
	EXPECT_GT(fs::file_size(picture), 50'000u);
	const Ran nowhere = run(tree, {"screenshot", (tree.root() / "no/such/folder.png").string()});
	EXPECT_EQ(nowhere.status, 1);
	EXPECT_NE(nowhere.output.find("no/such/folder.png"), std::string::npos) << nowhere.output;

	EXPECT_EQ(run(tree, {"set", "view_offset", "0.5"}).status, 0);
	const Ran wrong = run(tree, {"set", "view_offset", "7"});
	EXPECT_EQ(wrong.status, 1);
	EXPECT_NE(wrong.output.find("expected a number from 0 (eye) to 1 (camera)"), std::string::npos) << wrong.output;
	EXPECT_EQ(run(tree, {"recenter"}).status, 0);
	EXPECT_EQ(run(tree, {"stop"}).status, 0);
	EXPECT_EQ(service.process().wait(std::chrono::seconds(60)), 0);
}

TEST(Command, RegistersAndPutsBackWhatWasThere)
{
	const PrivateTree tree;
	const fs::path manifest = programDirectory().parent_path() / "openxr_arift.json";
	if (!fs::exists(manifest)) GTEST_SKIP() << manifest << " is not built";
	const fs::path active = tree.write("config/openxr/1/active_runtime.json", "{\"theirs\": true}");
	const fs::path native = active.parent_path() / "active_runtime.x86_64.json";
	EXPECT_EQ(run(tree, {"register"}).status, 0);
	EXPECT_EQ(fs::canonical(active), fs::canonical(manifest));
	EXPECT_EQ(fs::canonical(native), fs::canonical(manifest));
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "{\"theirs\": true}");
	EXPECT_EQ(run(tree, {"register", "--user"}).status, 0) << "twice does no harm";
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "{\"theirs\": true}");
	EXPECT_EQ(run(tree, {"unregister"}).status, 0);
	EXPECT_EQ(contentOf(active), "{\"theirs\": true}");
	EXPECT_FALSE(fs::exists(native));
	EXPECT_EQ(run(tree, {"unregister"}).status, 0);
	EXPECT_EQ(contentOf(active), "{\"theirs\": true}") << "not ours: left alone";
}

TEST(Command, DoesNotLoseASecondBackup)
{
	const PrivateTree tree;
	const fs::path active = tree.write("config/openxr/1/active_runtime.json", "second");
	tree.write("config/openxr/1/active_runtime.json.arift-backup", "first");
	EXPECT_EQ(run(tree, {"register"}).status, 1);
	EXPECT_EQ(contentOf(active), "second") << "a command that fails has changed nothing";
	EXPECT_EQ(contentOf(active.string() + ".arift-backup"), "first");
}
