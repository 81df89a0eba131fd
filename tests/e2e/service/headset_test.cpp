// Which headset: a simulated one only as long as no DK1 is plugged in.
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace arift::e2e;
namespace fs = std::filesystem;

namespace
{

constexpr const char *anyHeadset = "[compositor]\ntarget = \"offscreen\"\n";

/// What the kernel lists, for the service of one tree.
class UsbPort
{
public:
	explicit UsbPort(const PrivateTree &tree) : tree_(tree) {}
	void plugIn() const
	{
		tree_.write("sys/bus/usb/devices/1-2.4/idVendor", "2833\n");
		tree_.write("sys/bus/usb/devices/1-2.4/idProduct", "0001\n");
	}
	void unplug() const { fs::remove_all(tree_.root() / "sys/bus/usb/devices/1-2.4"); }

private:
	const PrivateTree &tree_;
};

bool isNamed(const nlohmann::json &status, const char *name) { return status["headset"]["name"] == name; }

Ran runCube(const PrivateService &service)
{
	return runCommand(service.tree(), {(programDirectory() / "hologram_cube").string(), "--seconds", "0.2"}, service.tree().environment(),
					  std::chrono::seconds(60));
}

} // namespace

TEST(WhichHeadset, APluggedInDk1EndsSimulatedSessionsAndItsRemovalBringsThemBack)
{
	PrivateService service(anyHeadset);
	const UsbPort port(service.tree());
	ASSERT_TRUE(eventually(service, [](const auto &status) { return isNamed(status, "synthetic headset"); }));
	ChildProcess cube = service.start("hologram_cube", {});
	ASSERT_TRUE(
		eventually(service, [](const auto &status) { return !status["clients"].empty() && status["clients"][0].value("shown", 0) > 2; }));
	port.plugIn();
	EXPECT_TRUE(cube.wait(std::chrono::seconds(30)).has_value()) << "its session was not lost: " << cube.output();
	ASSERT_TRUE(eventually(service, [](const auto &status) { return isNamed(status, "none"); }));
	const std::string problem = service.status()["headset"]["problem"];
	EXPECT_NE(problem.find("DK1 is plugged into USB port 1-2.4"), std::string::npos) << problem;
	EXPECT_NE(runArift(service.tree(), {"status"}).output.find(problem), std::string::npos);
	const Ran refused = runCube(service);
	EXPECT_NE(refused.status, 0);
	EXPECT_NE(refused.output.find("XR_ERROR_FORM_FACTOR_UNAVAILABLE"), std::string::npos) << refused.output;
	EXPECT_NE(refused.output.find(problem), std::string::npos) << refused.output;

	port.unplug();
	ASSERT_TRUE(eventually(service, [](const auto &status) { return isNamed(status, "synthetic headset"); }));
	EXPECT_EQ(runCube(service).status, 0);
	EXPECT_TRUE(service.process().running());
}

TEST(WhichHeadset, OneThatIsNamedIsUsedWhateverIsPluggedIn)
{
	PrivateService service("[headset]\ndriver = \"synthetic\"\n[compositor]\ntarget = \"offscreen\"\n");
	UsbPort(service.tree()).plugIn();
	EXPECT_EQ(runCube(service).status, 0);
	EXPECT_TRUE(isNamed(service.status(), "synthetic headset"));
}
