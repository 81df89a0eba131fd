// The GPU is lost or has no memory left, as a driver would tell it.
#include "tests/common/temporary_folder.h"
#include "tests/e2e/common/private_service.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

using namespace arift;
using namespace arift::e2e;

namespace
{

constexpr const char *configuration = "[headset]\ndriver = \"synthetic\"\n[compositor]\ntarget = \"offscreen\"\n";

uint64_t submitted(const nlohmann::json &status)
{
	uint64_t sum = 0;
	for (const auto &client : status["clients"]) sum += client["submitted"].get<uint64_t>();
	return sum;
}

class GpuFaults : public testing::Test
{
protected:
	GpuFaults() : startedAt_(realTime()), service_(withLayer())
	{
		eventually(service_, [](const auto &status) { return status["frames"]["shown"] > 0; });
		startUp_ = realTime() - startedAt_;
		// The cameras' textures and the vertices have their memory with the first images that need it.
		eventually(service_, [](const auto &status) { return status["frames"]["shown"] > 15; });
	}
	/// The service alone has the layer: applications have a GPU that works.
	PrivateService withLayer() const
	{
		const std::map<std::string, std::string> variables{
			{"VK_INSTANCE_LAYERS", "VK_LAYER_ARIFT_faults"}, {"VK_LAYER_PATH", FAULT_LAYERS}, {"ARIFT_FAULTS", faults_.path().string()}};
		for (const auto &[name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
		PrivateService service(configuration);
		for (const auto &[name, value] : variables) ::unsetenv(name.c_str());
		return service;
	}
	void fail(const char *fault) const { std::ofstream(faults_.path() / fault) << "please"; }
	void work(const char *fault) const { std::filesystem::remove(faults_.path() / fault); }
	bool says(const std::string &text) { return service_.process().output().find(text) != std::string::npos; }
	/// The record begins anew with the compositor.
	bool isMadeAnew(uint64_t shownBefore)
	{
		return eventually(service_, [&](const auto &status) {
			const uint64_t shown = status["frames"]["shown"];
			return shown > 0 && shown < shownBefore;
		});
	}
	uint64_t shown() { return service_.status()["frames"]["shown"]; }

	const test::TemporaryFolder faults_;
	const XrTime startedAt_;
	PrivateService service_;
	XrDuration startUp_ = 0; ///< until the first image was shown: the measure for how long this machine may take for another
};

} // namespace

TEST_F(GpuFaults, ALostGpuIsOpenedAnewAndSessionsLearnOfIt)
{
	ChildProcess application = service_.start("stopping_application", {"never", "0"});
	ASSERT_TRUE(eventually(service_, [](const auto &status) { return submitted(status) > 3 && status["frames"]["shown"] > 30; }));
	const uint64_t before = shown();
	const int samples = int(service_.status()["tracker"]["lost"]);
	const XrTime lostAt = realTime();
	fail("device_lost");
	ASSERT_TRUE(isMadeAnew(before)) << service_.process().output();
	const XrDuration passed = realTime() - lostAt;
	std::fprintf(stderr, "[ FIGURE   ] images %.2f s after the GPU was lost; %.2f s after the service's start\n", inSeconds(passed),
				 inSeconds(startUp_));
	// With an application that draws until it hears of it; most of this is the software renderer's compiler.
	EXPECT_LT(passed, std::max(second, 2 * startUp_));
	EXPECT_TRUE(says("no images can be made: ")) << service_.process().output();
	EXPECT_TRUE(says("images are made again"));
	EXPECT_FALSE(says("tracker: lost")) << "the devices have gone on";
	EXPECT_EQ(service_.status()["tracker"]["lost"], samples);
	ASSERT_TRUE(eventually(service_, [](const auto &status) { return status["frames"]["shown"] > 20; }));
	EXPECT_EQ(service_.status()["frames"]["withoutCamera"], 0) << "the cameras' memory is that of the lost device, and still read";
	for (const Statistics &eye : statisticsOfEyes(service_.screenshot())) EXPECT_GT(eye.deviation, 8);

	const auto status = application.wait(std::chrono::seconds(20));
	ASSERT_TRUE(status) << "it must not hang";
	EXPECT_TRUE(status == 0 || application.output().find("XrResult -17") != std::string::npos) << application.output(); // SESSION_LOST
	ChildProcess next = service_.start("stopping_application", {"never", "0"});
	EXPECT_TRUE(eventually(service_, [](const auto &now) { return submitted(now) > 3; })) << next.output();
	EXPECT_EQ(service_.process().stop(), 0) << service_.process().output();
}

TEST_F(GpuFaults, WithoutMemoryAClientIsRefusedAndTheWorldGoesOn)
{
	fail("no_memory");
	service_.status(true);
	ChildProcess application = service_.start("stopping_application", {"never", "0"});
	EXPECT_EQ(application.wait(std::chrono::seconds(60)), 1);
	EXPECT_NE(application.output().find("xrCreateSwapchain failed"), std::string::npos) << application.output();
	EXPECT_TRUE(eventually(service_, [](const auto &status) { return status["frames"]["shown"] > 5; }));
	EXPECT_FALSE(says("no images can be made")) << "one client's images are no reason to end the others'";
	work("no_memory");
	ChildProcess next = service_.start("stopping_application", {"never", "0"});
	EXPECT_TRUE(eventually(service_, [](const auto &status) { return submitted(status) > 3; })) << next.output();
}

TEST_F(GpuFaults, AGpuThatCannotBeOpenedIsTriedAgain)
{
	const uint64_t before = [&] {
		eventually(service_, [](const auto &status) { return status["frames"]["shown"] > 60; });
		return shown();
	}();
	fail("no_memory");
	fail("device_lost");
	for (const XrTime end = realTime() + 60 * second; !says("OutOfDeviceMemory") && realTime() < end;)
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	EXPECT_TRUE(says("OutOfDeviceMemory")) << service_.process().output();
	EXPECT_TRUE(service_.process().running());
	work("no_memory");
	EXPECT_TRUE(isMadeAnew(before)) << service_.process().output();
}
