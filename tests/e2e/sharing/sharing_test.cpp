// Images that are copied instead of shared: the same picture, with depth too, and nothing that the other side could do with the memory
// hurts the service.
#include "runtime/ipc/shared_memory.h"
#include "tests/e2e/boundary/raw_client.h"
#include "tests/e2e/common/process_usage.h"
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{
namespace
{

/// Nothing moves and nothing is noisy: two services show the same.
std::string quietWorld(const char *images)
{
	return fmt::format("[headset]\ndriver = \"synthetic\"\n[compositor]\ntarget = \"offscreen\"\n[swapchains]\nimages = \"{}\"\n"
					   "[synthetic]\nmotion = \"rest\"\ntracker_noise = false\ntracker_quantisation = false\ngyro_bias = [0.0, 0.0, 0.0]\n"
					   "camera_noise = false\n",
					   images);
}

size_t occurrences(const std::string &text, const std::string &part)
{
	size_t count = 0;
	for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
	return count;
}

constexpr const char *said = "copied through the CPU's memory";

/// What an application shows, and what was said of it, with the validation layer on both sides.
struct Shown {
	PanelPicture picture;
	nlohmann::json swapchains;
	std::string serviceLog, applicationLog;
};
Shown show(const char *images, const char *program = "format_application", ipc::PictureKind kind = ipc::PictureKind::panel)
{
	PrivateService service(quietWorld(images));
	auto environment = service.tree().environment();
	environment["VK_INSTANCE_LAYERS"] = "VK_LAYER_KHRONOS_validation";
	environment["VK_LAYER_ENABLES"] = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT";
	ChildProcess application({(programDirectory() / program).string()}, environment, service.tree().root() / "application.log");
	const bool isShown = eventually(service, [](const auto &status) {
		return status["service"]["uptime"] > 3 && !status["clients"].empty() && status["clients"][0]["shown"] > 25 &&
			   status["frames"]["leftOut"] == 0;
	});
	EXPECT_TRUE(isShown) << application.output() << service.process().output();
	Shown shown{service.screenshot(kind), service.status()["clients"].at(0)["swapchains"], {}, {}};
	EXPECT_EQ(application.stop(std::chrono::seconds(20)), 0) << application.output();
	EXPECT_EQ(service.status()["headset"]["validationMessages"], 0) << service.process().output();
	shown.serviceLog = service.process().output();
	shown.applicationLog = application.output();
	return shown;
}

/// Pixels in the colour of the quads (linear 0.5, 0.25, 0.1: encoded 188, 137, 89).
int quadPixels(const PanelPicture &picture)
{
	int count = 0;
	for (size_t i = 0; i < picture.rgba.size(); i += 4) {
		const uint8_t *p = &picture.rgba[i];
		count += std::abs(p[0] - 188) < 6 && std::abs(p[1] - 137) < 6 && std::abs(p[2] - 89) < 6;
	}
	return count;
}

class Validated : public testing::Test
{
protected:
	static void SetUpTestSuite() { ::setenv("ARIFT_VULKAN_VALIDATION", "1", 1); }
	static void TearDownTestSuite() { ::unsetenv("ARIFT_VULKAN_VALIDATION"); }
};

TEST_F(Validated, CopiesShowWhatSharedImagesShow)
{
	const Shown shared = show("auto"), copied = show("copy");
	ASSERT_EQ(shared.picture.rgba.size(), copied.picture.rgba.size());
	int worst = 0, different = 0;
	for (size_t i = 0; i < shared.picture.rgba.size(); ++i) {
		const int difference = std::abs(shared.picture.rgba[i] - copied.picture.rgba[i]);
		worst = std::max(worst, difference);
		different += difference > 1;
	}
	fmt::print(stderr, "[ FIGURE   ] copied against shared: {} of {} values differ by more than 1, at most by {}; {} pixels are quads\n",
			   different, shared.picture.rgba.size(), worst, quadPixels(copied.picture));
	EXPECT_LE(different, 20);
	EXPECT_GT(quadPixels(copied.picture), 20'000) << "seven formats in both eyes";
	EXPECT_EQ(shared.swapchains.size(), copied.swapchains.size());
	EXPECT_GE(copied.swapchains.size(), 11u);
	for (const auto &swapchain : copied.swapchains) EXPECT_EQ(swapchain["copied"], true);
	for (const auto &swapchain : shared.swapchains) EXPECT_EQ(swapchain["copied"], false);
	EXPECT_EQ(occurrences(copied.serviceLog, said), 1u) << copied.serviceLog;
	EXPECT_EQ(occurrences(copied.applicationLog, said), 1u) << copied.applicationLog;
	EXPECT_EQ(occurrences(shared.serviceLog + shared.applicationLog, said), 0u) << shared.serviceLog << shared.applicationLog;
	for (const Shown *each : {&shared, &copied})
		for (const char *message : {"Validation Error", "Validation Warning", "VUID", "SYNC-HAZARD"})
			EXPECT_EQ(occurrences(each->applicationLog, message), 0u) << each->applicationLog;
}

/// What is of one colour in an eye's half of a picture, a channel at full and the others at nothing.
struct Square {
	double middle = 0, width = 0; ///< pixels
};
Square squareOf(const PanelPicture &picture, size_t eye, size_t channel)
{
	double sum = 0, count = 0;
	uint32_t least = picture.width, most = 0;
	for (uint32_t y = 0; y < picture.height; ++y)
		for (auto x = uint32_t(eye * picture.width / 2); x < (eye + 1) * picture.width / 2; ++x) {
			const uint8_t *p = &picture.rgba[4 * (size_t(y) * picture.width + x)];
			if (p[channel] < 250 || p[(channel + 1) % 3] > 5 || p[(channel + 2) % 3] > 5) continue;
			sum += x, ++count;
			least = std::min(least, x), most = std::max(most, x);
		}
	return {sum / count, double(most) - least + 1};
}

/// Both squares were seen straight ahead from 5 cm further to the left: without a depth they are on the plane at 2 m.
TEST_F(Validated, DepthMovesWhatIsNearWhetherItsImagesAreSharedOrCopied)
{
	for (const char *images : {"auto", "copy"}) {
		const Shown shown = show(images, "depth_application", ipc::PictureKind::eyes);
		for (const size_t eye : {0, 1}) {
			const Square green = squareOf(shown.picture, eye, 1), red = squareOf(shown.picture, eye, 0);
			const double perTangent = red.width / (2 * std::tan(0.05)), apart = (red.middle - green.middle) / perTangent;
			const double expected = 0.05 / (eye == 0 ? 0.4 : 1.0) - 0.05 / 2;
			fmt::print(stderr,
					   "[ FIGURE   ] {}: what is {} m away is seen {:.4f} to the left of what is thought 2 m away, expected {:.4f}\n",
					   images, eye == 0 ? 0.4 : 1.0, apart, expected);
			EXPECT_NEAR(apart, expected, 0.004) << images;
		}
		for (const char *message : {"Validation Error", "Validation Warning", "VUID", "SYNC-HAZARD"})
			EXPECT_EQ(occurrences(shown.applicationLog, message), 0u) << shown.applicationLog;
	}
}

/// A client on a GPU that is not the service's, without one.
class OtherGpu : public testing::Test
{
protected:
	PrivateService service_{quietWorld("auto")};
	RawClient client_{service_};

	bool begin()
	{
		if (!client_.greet()) return false;
		ipc::CreateSession create;
		create.deviceUuid.fill(0xee);
		const auto created = client_.ask<ipc::SessionCreated>(create);
		if (!created || created->sharing != ipc::Sharing::copies || created->probeSize != 0) return false;
		client_.session = created->session;
		client_.frames.emplace(std::move(client_.received.fds[0]));
		return client_.ask<ipc::Done>(ipc::SessionRunning{.session = client_.session, .running = 1}).has_value();
	}
	std::optional<ipc::SwapchainCreated> makeSwapchain(ipc::Sharing sharing)
	{
		const auto created = client_.ask<ipc::SwapchainCreated>(
			ipc::CreateSwapchain{.session = client_.session, .sharing = sharing, .spec = RawClient::smallImages()});
		if (!created) return std::nullopt;
		client_.swapchain = created->swapchain;
		for (size_t i = 0; i < client_.received.fdCount; ++i) client_.images[i] = std::move(client_.received.fds[i]);
		size_ = created->memorySize;
		return created;
	}
	void paint(std::array<uint8_t, 4> colour)
	{
		const ipc::Mapping texels = ipc::mapWritable(client_.images[0].get(), size_);
		for (size_t i = 0; i < size_; ++i) static_cast<uint8_t *>(texels.address())[i] = colour[i % 4];
	}
	/// Submits the quad and looks at what is shown of it: red, green and blue ahead of the left eye, whose view reaches further to the
	/// left.
	std::array<int, 3> shownOf(uint32_t release)
	{
		ipc::Submission submission = client_.quad(++frame_);
		submission.layers[0].frame = ipc::LayerFrame::head;
		submission.layers[0].views[0].image.release = release;
		EXPECT_EQ(client_.frames->send(submission, realTime() + second), ipc::Transfer::done);
		EXPECT_TRUE(eventually(service_, [&](const auto &status) {
			return !status["clients"].empty() && status["clients"][0]["shown"] >= frame_;
		})) << service_.process().output();
		const PanelPicture picture = service_.screenshot(ipc::PictureKind::eyes);
		const uint8_t *pixel = &picture.rgba[4 * (size_t(picture.height / 2) * picture.width + picture.width * 7 / 20)];
		return {pixel[0], pixel[1], pixel[2]};
	}

	uint64_t frame_ = 0, size_ = 0;
};

TEST_F(OtherGpu, IsShownThroughMemoryThatItCannotTakeAway)
{
	ASSERT_TRUE(begin());
	EXPECT_FALSE(makeSwapchain(ipc::Sharing::memory)) << "its device could not import it";
	ASSERT_TRUE(client_.received.as<ipc::Failed>());
	EXPECT_EQ(client_.received.as<ipc::Failed>()->result, XR_ERROR_FEATURE_UNSUPPORTED);
	ASSERT_TRUE(makeSwapchain(ipc::Sharing::copies));
	EXPECT_EQ(size_, 64u * 48 * 4);

	using Colour = std::array<int, 3>;
	paint({200, 40, 10, 255});
	EXPECT_EQ(shownOf(1), (Colour{200, 40, 10}));
	paint({10, 150, 60, 255});
	EXPECT_EQ(shownOf(1), (Colour{200, 40, 10})) << "the same release is not looked at again";
	EXPECT_EQ(shownOf(2), (Colour{10, 150, 60}));
	paint({90, 80, 70, 255});
	EXPECT_EQ(shownOf(0), (Colour{90, 80, 70})) << "without a number it is looked at every time";

	EXPECT_EQ(::ftruncate(client_.images[0].get(), 0), -1);
	EXPECT_EQ(errno, EPERM);
	// A hole reads as transparent black: the quad's own alpha is not asked for, so it is black.
	ASSERT_EQ(::fallocate(client_.images[0].get(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, off_t(size_)), 0);
	EXPECT_EQ(shownOf(3), (Colour{0, 0, 0}));
	EXPECT_TRUE(service_.process().running());
	EXPECT_EQ(occurrences(service_.process().output(), said), 1u) << service_.process().output();
}

TEST(KilledWhileCopying, NothingIsLeftBehind)
{
	PrivateService service(quietWorld("copy"));
	const auto run = [&](const char *point) {
		ChildProcess application = service.start("stopping_application", {point, "4"});
		EXPECT_TRUE(application.stopsItself(std::chrono::minutes(1))) << point << ": " << application.output();
		EXPECT_EQ(service.status()["clients"].at(0)["swapchains"].at(0)["copied"], true);
		::kill(application.pid(), SIGKILL);
		application.wait(std::chrono::seconds(10));
		std::filesystem::remove(service.tree().root() / "stopping_application.log");
		EXPECT_TRUE(eventually(service, [](const auto &status) { return status["clients"].empty(); })) << point;
	};
	for (int i = 0; i < 3; ++i) run("image released"); // fills the allocator's caches
	const ProcessUsage before = settledUsage(service.process().pid());
	for (const char *point : {"image acquired", "work submitted", "image released", "inside xrEndFrame", "after xrEndFrame"}) run(point);
	const ProcessUsage after = settledUsage(service.process().pid());
	fmt::print(stderr, "[ FIGURE   ] before 5 kills {}\n[ FIGURE   ] after them {}\n", describe(before), describe(after));
	EXPECT_EQ(after.descriptors, before.descriptors);
	EXPECT_EQ(after.threads, before.threads);
	EXPECT_LE(after.mappings, before.mappings);
	EXPECT_LE(after.residentMiB, before.residentMiB + 2);
	EXPECT_TRUE(service.process().running());
}

} // namespace
} // namespace arift::e2e
