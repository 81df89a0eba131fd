// What `cmake --install` puts where, and that it works from there with nothing of the build tree on any path.
#include "tests/e2e/common/command.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

namespace fs = std::filesystem;

class Installation : public testing::Test
{
protected:
	void SetUp() override
	{
		const Ran installed =
			runCommand(tree, {CMAKE_PROGRAM, "--install", BUILD_DIRECTORY, "--prefix", prefix.string()}, tree.environment());
		ASSERT_EQ(installed.status, 0) << installed.output;
	}
	/// Not a trace of the build tree: the runtime is what is registered, or what `manifest` says.
	std::map<std::string, std::string> environment() const
	{
		auto environment = tree.environment();
		for (const char *name : {"XR_RUNTIME_JSON", "ARIFT_SERVICE"}) environment.erase(name);
		return environment;
	}
	Ran run(std::vector<std::string> command, const std::map<std::string, std::string> &environment) const
	{
		command[0] = (prefix / "bin" / command[0]).string();
		return runCommand(tree, command, environment, std::chrono::seconds(120));
	}

	const PrivateTree tree;
	const fs::path prefix = tree.root() / "prefix", manifest = prefix / "share/openxr/1/openxr_arift.json";
};

TEST_F(Installation, HasEverythingWhereTheSystemLooksForIt)
{
	for (const char *file : {"bin/arift", "bin/arift-service", "bin/hologram_cube", "share/openxr/1/openxr_arift.json",
							 "share/arift/config.toml", "share/arift/rigs/arift.toml", "lib/udev/rules.d/70-arift.rules",
							 "lib/systemd/user/arift.socket", "lib/systemd/user/arift.service"})
		EXPECT_TRUE(fs::is_regular_file(prefix / file)) << file;
	const fs::path library = nlohmann::json::parse(contentOf(manifest))["runtime"]["library_path"].get<std::string>();
	EXPECT_TRUE(library.is_absolute()) << library;
	EXPECT_TRUE(fs::is_regular_file(library)) << library;
	EXPECT_EQ(library.native().rfind(prefix.native(), 0), 0u) << library << " is not of this installation";
	const std::string unit = contentOf(prefix / "lib/systemd/user/arift.service");
	EXPECT_NE(unit.find("\nExecStart=" + (prefix / "bin/arift-service").string() + " "), std::string::npos) << unit;
	EXPECT_NE(contentOf(prefix / "lib/udev/rules.d/70-arift.rules").find("2833"), std::string::npos) << "Oculus' USB vendor";
}

TEST_F(Installation, RegistersItselfAndIsFoundByApplications)
{
	const Ran registered = run({"arift", "register"}, environment());
	ASSERT_EQ(registered.status, 0) << registered.output;
	const fs::path active = tree.root() / "config/openxr/1/active_runtime.json";
	ASSERT_TRUE(fs::exists(active)) << registered.output;
	EXPECT_EQ(fs::canonical(active), fs::canonical(manifest));

	const ServiceEnd end(tree);
	const Ran cube = run({"hologram_cube", "--seconds", "1"}, environment());
	EXPECT_EQ(cube.status, 0) << cube.output;
	const Ran answer = run({"arift", "status", "--json"}, environment());
	ASSERT_EQ(answer.status, 0) << answer.output << contentOf(tree.root() / "state/arift/service.log");
	const int pid = nlohmann::json::parse(answer.output)["service"]["pid"];
	EXPECT_EQ(fs::read_symlink("/proc/" + std::to_string(pid) + "/exe"), fs::canonical(prefix / "bin/arift-service"));
	EXPECT_EQ(run({"arift", "stop"}, environment()).status, 0);
	EXPECT_EQ(run({"arift", "unregister"}, environment()).status, 0);
	EXPECT_FALSE(fs::exists(fs::symlink_status(active)));
}

TEST_F(Installation, ItsManifestIsEnoughForAnApplication)
{
	auto named = environment();
	named["XR_RUNTIME_JSON"] = manifest.string();
	const ServiceEnd end(tree);
	const Ran cube = run({"hologram_cube", "--seconds", "1"}, named);
	EXPECT_EQ(cube.status, 0) << cube.output;
	EXPECT_NE(cube.output.find("hologram_cube: "), std::string::npos) << cube.output;
	EXPECT_EQ(run({"arift", "status"}, named).status, 0) << "the service it started";
}

} // namespace
} // namespace arift::e2e
