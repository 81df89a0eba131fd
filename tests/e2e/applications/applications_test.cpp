// Programs that know nothing of this project run on it, under every validation layer: what they show is on the panel, and the layers say
// nothing.
#include "tests/e2e/applications/layer_messages.h"
#include "tests/e2e/common/command.h"
#include "tests/e2e/common/private_service.h"
#include "tests/e2e/common/x_server.h"
#include <algorithm>
#include <cmath>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace arift::e2e
{
namespace
{

using namespace std::chrono_literals;

/// Nothing moves and nothing is noisy: what changes between two pictures is what the application draws.
constexpr const char *quietWorld = R"(
[headset]
driver = "synthetic"
[compositor]
target = "offscreen"
[synthetic]
motion = "rest"
tracker_noise = false
tracker_quantisation = false
gyro_bias = [0.0, 0.0, 0.0]
camera_noise = false
)";

constexpr uint64_t enoughFrames = 20;

struct Pixel {
	int red, green, blue;
};
Pixel pixel(const PanelPicture &picture, uint32_t x, uint32_t y)
{
	const uint8_t *at = picture.rgba.data() + 4 * (size_t(y) * picture.width + x);
	return {at[0], at[1], at[2]};
}
int difference(const Pixel &a, const Pixel &b)
{
	return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

/// A program under all layers, in an environment that finds the service, with a keyboard: a pipe that nobody types on until it is to quit.
class Application
{
public:
	Application(const PrivateService &service, std::string name, const std::string &commandLine, const std::string &display = {})
		: name_(std::move(name)),
		  coreValidation_(service.tree().root() / (name_ + "-core-validation.txt")),
		  keyboard_(service.tree().root() / (name_ + "-keyboard"))
	{
		if (::mkfifo(keyboard_.c_str(), 0600) != 0) throw std::runtime_error("no pipe can be made: " + keyboard_.string());
		keys_ = ::open(keyboard_.c_str(), O_RDWR | O_CLOEXEC);
		auto environment = service.tree().environment();
		if (!display.empty()) environment["DISPLAY"] = display;
		environment["XR_ENABLE_API_LAYERS"] = "XR_APILAYER_LUNARG_core_validation";
		environment["XR_CORE_VALIDATION_FILE_NAME"] = coreValidation_.string();
		environment["VK_INSTANCE_LAYERS"] = "VK_LAYER_KHRONOS_validation";
		environment["VK_LAYER_ENABLES"] = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT";
		process_.emplace(std::vector<std::string>{"/bin/sh", "-c", "exec " + commandLine + " < " + keyboard_.string()}, environment,
						 service.tree().root() / (name_ + ".log"));
	}
	~Application() { ::close(keys_); }
	Application(const Application &) = delete;

	ChildProcess &process() { return *process_; }
	void pressKey() const { EXPECT_EQ(::write(keys_, "\n", 1), 1); }
	/// Everything it and the layers printed.
	std::string output() const { return process_->output() + contentOf(coreValidation_); }
	/// What the layer says of itself when an instance is created.
	bool hasCoreValidation() const { return process_->output().find("Core Validation output type:") != std::string::npos; }

private:
	std::string name_;
	std::filesystem::path coreValidation_, keyboard_;
	int keys_ = -1;
	std::optional<ChildProcess> process_;
};

class Applications : public testing::Test
{
protected:
	static void SetUpTestSuite() { ::setenv("ARIFT_VULKAN_VALIDATION", "1", 1); }

	void SetUp() override
	{
		service_.emplace(quietWorld);
		awaitOpenHeadset();
		before_ = pictureOfTheWorld();
	}

	/// Opening takes long on a busy machine, above all under the validation layer.
	void awaitOpenHeadset()
	{
		const auto deadline = std::chrono::steady_clock::now() + 180s;
		for (;;) {
			try {
				service_->status();
				return;
			} catch (const std::runtime_error &) { // it says that the headset is not open yet
				if (std::chrono::steady_clock::now() > deadline || !service_->process().running()) throw;
			}
		}
	}

	/// Two pictures alike, behind the first second: the camera images have come and faded in.
	PanelPicture pictureOfTheWorld()
	{
		const auto deadline = std::chrono::steady_clock::now() + 60s;
		PanelPicture last = service_->screenshot();
		while (std::chrono::steady_clock::now() < deadline) {
			std::this_thread::sleep_for(100ms);
			PanelPicture next = service_->screenshot();
			if (!firstPicture_) firstPicture_ = next.displayTime;
			if (next.displayTime - *firstPicture_ > 2 * second && alike(last, next)) return next;
			last = std::move(next);
		}
		ADD_FAILURE() << "the panel does not come to rest though nothing moves";
		return last;
	}

	static bool alike(const PanelPicture &a, const PanelPicture &b)
	{
		if (a.rgba.size() != b.rgba.size()) return false;
		size_t different = 0;
		for (size_t i = 0; i < a.rgba.size(); ++i) different += std::abs(a.rgba[i] - b.rgba[i]) > 3 ? 1 : 0;
		return different < a.rgba.size() / 1000;
	}

	/// Waits until the panel has shown that many frames of the application called `name`.
	void awaitFrames(Application &application, const std::string &name)
	{
		const auto deadline = std::chrono::steady_clock::now() + 150s;
		uint64_t shown = 0;
		while (shown < enoughFrames && std::chrono::steady_clock::now() < deadline) {
			ASSERT_TRUE(application.process().running()) << application.output();
			const nlohmann::json status = service_->status();
			for (const nlohmann::json &client : status["clients"])
				if (client["name"] == name) shown = client["shown"];
			std::this_thread::sleep_for(50ms);
		}
		ASSERT_GE(shown, enoughFrames) << service_->status().dump(1) << application.output();
	}

	void expectSilence(const Application &application)
	{
		const auto expected = expectedMessages(EXPECTED_MESSAGES);
		EXPECT_TRUE(application.hasCoreValidation()) << "the core validation layer was not there";
		EXPECT_EQ(unexpectedMessages(application.output(), expected), std::vector<std::string>{});
		EXPECT_EQ(unexpectedMessages(service_->process().output(), expected), std::vector<std::string>{});
		EXPECT_EQ(service_->process().output().find("arift error"), std::string::npos) << service_->process().output();
		EXPECT_TRUE(service_->process().running());
	}

	/// Fraction of the panel's pixels for which `holds(before, now)`.
	template <typename Predicate> double fraction(const PanelPicture &now, Predicate holds) const
	{
		EXPECT_EQ(now.rgba.size(), before_.rgba.size());
		size_t count = 0;
		for (uint32_t y = 0; y < now.height; ++y)
			for (uint32_t x = 0; x < now.width; ++x) count += holds(pixel(before_, x, y), pixel(now, x, y)) ? 1 : 0;
		return double(count) / (double(now.width) * now.height);
	}

	void runHelloXr(const std::string &graphics, const std::string &blendMode, const std::string &display = {})
	{
#ifdef ARIFT_SANITIZED
		GTEST_SKIP() << "a program of somebody else cannot load a library built with sanitizers";
#endif
		if (::access("/usr/bin/hello_xr", X_OK) != 0) GTEST_SKIP() << "hello_xr is not installed (package libopenxr-utils)";
		Application hello(*service_, "hello_xr", "/usr/bin/hello_xr -g " + graphics + " -bm " + blendMode, display);
		awaitFrames(hello, "HelloXR");
		if (HasFatalFailure()) return;
		const PanelPicture now = service_->screenshot();
		// It clears to an opaque dark slate grey (red below green and blue, which are equal) that fills both views.
		const double grey = fraction(now, [](const Pixel &, const Pixel &p) {
			return std::abs(p.green - p.blue) <= 6 && p.green - p.red >= 15 && p.green - p.red <= 60 && p.green >= 60 && p.green <= 190;
		});
		EXPECT_GT(grey, 0.4) << "of the panel is in hello_xr's clear colour";
		hello.pressKey();
		const auto status = hello.process().wait(60s);
		ASSERT_TRUE(status.has_value()) << "hello_xr does not end";
		EXPECT_EQ(*status, 0) << hello.output();
		expectSilence(hello);
	}

	/// It opens a window through GLX, with an extension that Xvfb has not.
	void runHelloXrOpenGl(const std::string &blendMode)
	{
		if (!XServer::isThere(XServer::Kind::dummyDriver))
			GTEST_SKIP() << "no Xorg may be started (package xserver-xorg-video-dummy, root)";
		const XServer server(service_->tree(), XServer::Kind::dummyDriver);
		runHelloXr("OpenGL", blendMode, server.display());
	}

	std::optional<PrivateService> service_;
	PanelPicture before_;
	std::optional<XrTime> firstPicture_;
};

TEST_F(Applications, HelloXrVulkanOpaque) { runHelloXr("Vulkan", "Opaque"); }
TEST_F(Applications, HelloXrVulkanAlphaBlend) { runHelloXr("Vulkan", "AlphaBlend"); }
TEST_F(Applications, HelloXrVulkan2Opaque) { runHelloXr("Vulkan2", "Opaque"); }
TEST_F(Applications, HelloXrVulkan2AlphaBlend) { runHelloXr("Vulkan2", "AlphaBlend"); }
TEST_F(Applications, HelloXrOpenGLOpaque) { runHelloXrOpenGl("Opaque"); }
TEST_F(Applications, HelloXrOpenGLAlphaBlend) { runHelloXrOpenGl("AlphaBlend"); }

TEST_F(Applications, HologramCubeStandsInTheWorld)
{
	Application cube(*service_, "hologram_cube", (programDirectory() / "hologram_cube").string());
	awaitFrames(cube, "hologram_cube");
	if (HasFatalFailure()) return;
	const PanelPicture now = service_->screenshot();
	const auto isPaint = [](const Pixel &p) {
		return (p.red > p.green + 30 && p.green > p.blue + 30) || (p.blue > p.green + 20 && p.green > p.red + 30);
	};
	const double changed = fraction(now, [](const Pixel &then, const Pixel &p) { return difference(then, p) > 24; });
	const double painted = fraction(now, [&](const Pixel &then, const Pixel &p) { return difference(then, p) > 24 && isPaint(p); });
	// 0.25 m at 1.2 m: some 12 by 14 degrees of each eye's view. Only there is the world hidden.
	EXPECT_GT(changed, 0.01);
	EXPECT_LT(changed, 0.10);
	EXPECT_GT(painted, changed / 2) << "most of what changed is in the colours of the cube";
	EXPECT_GT(fraction(now, [](const Pixel &then, const Pixel &p) { return difference(then, p) <= 3; }), 0.88) << "the world is as before";

	const auto status = cube.process().stop();
	ASSERT_TRUE(status.has_value()) << "hologram_cube does not end on SIGTERM";
	EXPECT_EQ(*status, 0) << cube.output();
	expectSilence(cube);
	EXPECT_TRUE(alike(pictureOfTheWorld(), before_)) << "when the application has gone, the world is as before";
}

TEST_F(Applications, HologramCubeEndsByItselfWhenTheTimeIsUp)
{
	Application cube(*service_, "hologram_cube", (programDirectory() / "hologram_cube").string() + " --seconds 1");
	const auto status = cube.process().wait(120s);
	ASSERT_TRUE(status.has_value());
	EXPECT_EQ(*status, 0) << cube.output();
	expectSilence(cube);
}

} // namespace
} // namespace arift::e2e
