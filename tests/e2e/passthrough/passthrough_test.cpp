// Applications that know only opaque pictures, in the world: by themselves, and switched from outside while they run.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/marked_world.h"
#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

/// Waits for further images, so that a picture shows what was asked for.
void awaitFrames(PrivateService &service)
{
	service.status(true);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"] > 3; }));
}

struct Passthrough : testing::Test {
	PrivateService service{markedWorld(0.3)};

	ChildProcess start(const std::vector<std::string> &arguments)
	{
		ChildProcess application = service.start("passthrough_application", arguments);
		const auto isShown = [](const auto &status) { return !status["clients"].empty() && status["clients"][0]["shown"] > 3; };
		EXPECT_TRUE(eventually(service, isShown)) << application.output();
		return application;
	}
	Ran passthrough(std::vector<std::string> arguments)
	{
		arguments.insert(arguments.begin(), "passthrough");
		return runArift(service.tree(), arguments);
	}
	/// Whether both cameras' red discs are seen.
	bool seesTheWorld()
	{
		awaitFrames(service);
		const std::array<int, 2> red = redIn(service.screenshot());
		return red[0] > 300 && red[1] > 300;
	}
	/// Whether the world is seen, or not, within twenty pictures.
	bool becomes(bool seen)
	{
		for (int picture = 0; picture < 20; ++picture)
			if (seen ? seesTheWorld() : seesNoWorld()) return true;
		return false;
	}
	bool seesNoWorld()
	{
		awaitFrames(service);
		const std::array<int, 2> red = redIn(service.screenshot());
		return red[0] < 30 && red[1] < 30; // where no picture of the application reaches, at the rim
	}
};

TEST_F(Passthrough, IsBelowAnApplicationThatAsksForALayerOfIt)
{
	const ChildProcess application = start({"0", "0", "0", "0", "layer"});
	EXPECT_TRUE(seesTheWorld());
	ASSERT_EQ(::kill(application.pid(), SIGUSR1), 0);
	EXPECT_TRUE(becomes(false)) << "it has paused it";
	ASSERT_EQ(::kill(application.pid(), SIGUSR1), 0);
	EXPECT_TRUE(becomes(true)) << "and started it again";
}

TEST_F(Passthrough, IsSwitchedByTheCommandWhileTheApplicationRuns)
{
	const ChildProcess application = start({"0", "0", "0", "0"});
	EXPECT_TRUE(seesNoWorld()) << "it says OPAQUE";
	EXPECT_EQ(passthrough({"passthrough_application", "alpha"}).status, 0);
	EXPECT_TRUE(seesTheWorld()) << "its pictures' alpha is 0";
	EXPECT_EQ(passthrough({"passthrough_application", "off"}).status, 0);
	EXPECT_TRUE(seesNoWorld());
	EXPECT_EQ(passthrough({"passthrough_application", "underlay"}).status, 0);
	EXPECT_TRUE(seesNoWorld()) << "its pictures are everywhere, and opaque";
	EXPECT_EQ(passthrough({"passthrough_application", "underlay", "--opacity", "0"}).status, 0);
	EXPECT_TRUE(seesTheWorld());
	EXPECT_EQ(passthrough({"passthrough_application", "chroma", "--color", "000000", "--tolerance", "0.02", "--opacity", "1"}).status, 0);
	EXPECT_TRUE(seesTheWorld()) << "its pictures are black";
	EXPECT_EQ(passthrough({"passthrough_application", "chroma", "--color", "ff00ff"}).status, 0);
	EXPECT_TRUE(seesNoWorld());

	const auto settings = service.status()["applications"];
	ASSERT_EQ(settings.size(), 1u);
	EXPECT_EQ(settings[0]["name"], "passthrough_application");
	EXPECT_EQ(settings[0]["passthrough"], "chroma");
	EXPECT_EQ(settings[0]["color"], "FF00FF");
	EXPECT_EQ(settings[0]["tolerance"], 0.02) << "what is not given stays";
	const std::string kept = contentOf(service.tree().root() / "config/arift/overrides.toml");
	EXPECT_NE(kept.find("color = \"FF00FF\""), std::string::npos) << kept;
	const Ran list = passthrough({});
	EXPECT_EQ(list.output, "passthrough_application: chroma, color FF00FF, tolerance 0.02, softness 0.1, opacity 1\n");
}

TEST_F(Passthrough, IsKeptForAnApplicationThatComesLater)
{
	const Ran early = passthrough({"passthrough_application", "alpha"});
	EXPECT_EQ(early.status, 0);
	EXPECT_NE(early.output.find("kept for when it comes"), std::string::npos) << early.output;
	EXPECT_NE(passthrough({}).output.find("passthrough_application: alpha, opacity 1 (not connected)"), std::string::npos);
	const ChildProcess application = start({"0", "0", "0", "0"});
	EXPECT_TRUE(seesTheWorld());
}

TEST_F(Passthrough, WhatIsWrongIsExplainedAndChangesNothing)
{
	const auto complaint = [&](const std::vector<std::string> &arguments) {
		const Ran ran = passthrough(arguments);
		EXPECT_NE(ran.status, 0) << ran.output;
		return ran.output;
	};
	EXPECT_EQ(complaint({"game", "green"}), "arift: green: expected off, alpha, chroma, underlay\n");
	EXPECT_EQ(complaint({"game", "chroma", "--color", "green"}),
			  "arift: --color green: expected six hexadecimal digits RRGGBB, for instance 00FF00\n");
	EXPECT_EQ(complaint({"game", "chroma", "--tolerance", "3"}), "arift: --tolerance 3: expected a number from 0 to 1\n");
	EXPECT_EQ(complaint({"game", "alpha", "--opacity", "-1"}), "arift: --opacity -1: expected a number from 0 to 1\n");
	EXPECT_NE(complaint({std::string(200, 'x'), "alpha"}).find("expected the name of an application, up to 127 characters"),
			  std::string::npos);
	EXPECT_NE(complaint({"game"}).find("expected an application and its kind of passthrough; or raw or holograms alone"),
			  std::string::npos);
	EXPECT_TRUE(service.status()["applications"].empty());
	EXPECT_EQ(passthrough({}).output, "no application is connected, and none has settings\n");
}

} // namespace
} // namespace arift::e2e
