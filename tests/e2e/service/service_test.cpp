// arift-service as a process: what clients of every kind see of it, from the outside.
#include "runtime/ipc/shared_memory.h"
#include "runtime/motion/pose_history.h"
#include "tests/e2e/common/private_service.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

using namespace arift;
using namespace arift::e2e;

namespace
{

constexpr XrDuration plenty = 75 * second; // real time: a busy machine takes long to open the headset

constexpr const char *stepped = R"(
[headset]
driver = "synthetic"
[clock]
mode = "stepped"
[compositor]
target = "offscreen"
[synthetic]
motion = "natural"
)";

/// An application reduced to its messages.
class Application
{
public:
	explicit Application(const PrivateService &service, const std::string &name = "played application")
		: requests_(connectTo(service.tree()).value())
	{
		ipc::Hello hello;
		ipc::copyText(hello.applicationName, name);
		welcome = requests_.ask<ipc::Welcome>(hello, plenty);
	}
	void begin()
	{
		ipc::CreateSession create;
		create.headless = 1;
		auto created = requests_.ask<ipc::SessionCreated>(create, plenty);
		ASSERT_TRUE(created) << ipc::textOf(created.failure.text);
		ASSERT_EQ(created.fdCount, 1u);
		session = created.reply.session;
		frames.emplace(std::move(created.fds[0]));
		ipc::SessionRunning running;
		running.session = session;
		running.running = 1;
		ASSERT_TRUE(requests_.command(running, plenty));
	}
	std::optional<ipc::FrameReady> frame(uint64_t number)
	{
		ipc::WaitFrame wait;
		wait.header.sequence = uint32_t(number - 1);
		if (frames->send(wait, realTime() + plenty) != ipc::Transfer::done) return std::nullopt;
		ipc::Received received;
		if (frames->receive(received, realTime() + plenty) != ipc::Transfer::done) return std::nullopt;
		const auto ready = received.as<ipc::FrameReady>();
		ipc::Submission submission;
		submission.frame = number;
		submission.displayTime = ready ? ready->predictedDisplayTime : 0;
		submission.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
		if (frames->send(submission, realTime() + plenty) != ipc::Transfer::done) return std::nullopt;
		return ready;
	}
	ipc::Requests &requests() { return requests_; }

	ipc::Answer<ipc::Welcome> welcome;
	uint32_t session = 0;
	std::optional<ipc::Socket> frames;

private:
	ipc::Requests requests_;
};

nlohmann::json clientNamed(const nlohmann::json &status, const std::string &name)
{
	for (const auto &client : status["clients"])
		if (client["name"] == name) return client;
	return nullptr;
}

/// One service for all tests that leave it as they found it.
class Running : public testing::Test
{
protected:
	static void SetUpTestSuite() { service_ = new PrivateService(stepped); }
	static void TearDownTestSuite() { delete service_; }
	PrivateService &service() { return *service_; }

private:
	static inline PrivateService *service_ = nullptr;
};

} // namespace

TEST_F(Running, ShowsFramesWithoutAnyApplication)
{
	service().status(true);
	ASSERT_TRUE(eventually(service(), [](const auto &status) { return status["frames"]["shown"].template get<int>() >= 90; }));
	const auto status = service().status();
	const auto &frames = status["frames"];
	EXPECT_NEAR(frames["perSecond"].get<double>(), 59.91, 0.2);
	EXPECT_EQ(frames["missed"], 0) << "composing takes no simulated time";
	// The image shown is at least exposure, readout and transfer old when it is taken, and the panel adds its own 25 ms.
	EXPECT_GT(frames["cameraAgeMs"]["median"].get<double>(), 40);
	EXPECT_LT(frames["cameraAgeMs"]["p99"].get<double>(), 100);
	EXPECT_GT(frames["poseAgeMs"]["median"].get<double>(), 25);
	EXPECT_LT(frames["poseAgeMs"]["p99"].get<double>(), 35);
	ASSERT_EQ(status["cameras"].size(), 2u);
	EXPECT_NEAR(status["cameras"][0]["frameRate"].get<double>(), 43, 0.5);
	EXPECT_NEAR(status["tracker"]["rate"].get<double>(), 1000, 20);
	EXPECT_EQ(status["tracker"]["malformed"], 0);
	EXPECT_EQ(status["headset"]["name"], "synthetic headset");
	EXPECT_EQ(status["clock"]["mode"], "stepped");
}

TEST_F(Running, ThePanelShowsTheRoom)
{
	// Behind the first second the camera images have come and faded in.
	ASSERT_TRUE(eventually(service(), [](const auto &status) { return status["frames"]["shown"].template get<int>() >= 60; }));
	const PanelPicture panel = service().screenshot();
	ASSERT_EQ(panel.width, 1280u);
	ASSERT_EQ(panel.height, 800u);
	for (const Statistics &eye : statisticsOfEyes(panel)) {
		EXPECT_GT(eye.lit, 0.9) << "the middle of an eye is not black";
		EXPECT_GT(eye.mean, 30);
		EXPECT_LT(eye.mean, 230);
		EXPECT_GT(eye.deviation, 8) << "a room has things in it";
	}
	const PanelPicture eyes = service().screenshot(ipc::PictureKind::eyes);
	EXPECT_GT(eyes.width, eyes.height);
	EXPECT_GT(statisticsOf(eyes, eyes.width / 8, eyes.width * 3 / 8).lit, 0.9);
}

TEST_F(Running, TellsApplicationsWhatTheyNeed)
{
	Application application(service());
	ASSERT_TRUE(application.welcome) << ipc::textOf(application.welcome.failure.text);
	const ipc::Welcome &welcome = application.welcome.reply;
	EXPECT_EQ(ipc::textOf(welcome.systemName), "ARift (synthetic headset)");
	EXPECT_EQ(welcome.steppedClock, 1u);
	EXPECT_GT(welcome.recommendedWidth, 800u);
	EXPECT_LT(welcome.recommendedWidth, 2000u);
	EXPECT_GT(welcome.recommendedHeight, welcome.recommendedWidth);
	ASSERT_EQ(application.welcome.fdCount, 3u);
	const ipc::SharedPageView<ipc::SystemPage> system(std::move(application.welcome.fds[0]));
	const ipc::SharedPageView<PoseRing> ring(std::move(application.welcome.fds[1]));
	EXPECT_EQ(system->protocol, ipc::protocol);
	EXPECT_LT(realTime() - system->heartbeat.load(), second);
	const auto views = system->views.read();
	ASSERT_TRUE(views);
	EXPECT_EQ(views->viewOffset, 1);
	EXPECT_LT(views->fov[0].angleLeft, -0.5f);
	EXPECT_GT(views->fov[0].angleUp, 0.5f);
	EXPECT_LT(views->cameraInHead[0].position.x, views->cameraInHead[1].position.x);
	ASSERT_TRUE(eventually(service(), [&](const auto &) { return system->timing.read()->cameras[0].period > 0; }));
	EXPECT_NEAR(double(system->timing.read()->cameras[1].period), 1e9 / 43, 1e5);
	MotionSample newest;
	ASSERT_TRUE(PoseHistory(*ring).newest(newest));
	EXPECT_NEAR(double(newest.time), double(system->clock.read()->xrAnchor), double(100 * millisecond));
}

TEST_F(Running, AnApplicationDrawsFrameAfterFrame)
{
	Application application(service(), "frame after frame");
	application.begin();
	XrTime last = 0;
	for (uint64_t i = 1; i <= 30; ++i) {
		const auto ready = application.frame(i);
		ASSERT_TRUE(ready);
		if (last) { EXPECT_NEAR(double(ready->predictedDisplayTime - last), double(ready->predictedDisplayPeriod), 1e5) << "frame " << i; }
		last = ready->predictedDisplayTime;
		EXPECT_EQ(ready->shouldRender, 1u);
	}
	EXPECT_EQ(clientNamed(service().status(), "frame after frame")["state"], "running");
}

TEST_F(Running, ASecondSessionIsRefusedAndTheFirstGoesOn)
{
	Application application(service());
	application.begin();
	ipc::CreateSession another;
	another.headless = 1;
	const auto answer = application.requests().ask<ipc::SessionCreated>(another, plenty);
	EXPECT_EQ(answer.failure.result, XR_ERROR_LIMIT_REACHED);
	EXPECT_TRUE(application.frame(1));
}

TEST_F(Running, AnotherGpusImagesAreToBeCopied)
{
	Application application(service());
	ipc::CreateSession create;
	create.deviceUuid.fill(0xee);
	const auto answer = application.requests().ask<ipc::SessionCreated>(create, plenty);
	ASSERT_TRUE(answer) << ipc::textOf(answer.failure.text);
	EXPECT_EQ(answer.reply.sharing, ipc::Sharing::copies);
	EXPECT_EQ(answer.reply.formats[0], VK_FORMAT_R8G8B8A8_SRGB);
	EXPECT_EQ(answer.fdCount, 1u) << "no memory of the service's GPU";
}

TEST_F(Running, SwapchainsHaveQuotas)
{
	Application application(service());
	application.begin();
	ipc::CreateSwapchain create;
	create.session = application.session;
	create.spec = {.format = VK_FORMAT_R8G8B8A8_SRGB,
				   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
				   .width = 64,
				   .height = 32};
	const auto small = application.requests().ask<ipc::SwapchainCreated>(create, plenty);
	ASSERT_TRUE(small) << ipc::textOf(small.failure.text);
	EXPECT_EQ(small.fdCount, 3u);
	EXPECT_GE(small.reply.memorySize, 64u * 32 * 4);
	create.spec.format = VK_FORMAT_R32G32B32A32_SFLOAT;
	EXPECT_EQ(application.requests().ask<ipc::SwapchainCreated>(create, plenty).failure.result, XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
	create.spec.format = VK_FORMAT_R8G8B8A8_SRGB;
	create.spec.width = create.spec.height = 8192;
	create.spec.arrayLayers = 8;
	EXPECT_EQ(application.requests().ask<ipc::SwapchainCreated>(create, plenty).how, ipc::Answered::refused) << "2 GiB an image";
	EXPECT_TRUE(application.frame(1)) << "a refusal has changed nothing";
}

TEST_F(Running, ASubmissionMayNameASwapchainThatIsJustGone)
{
	Application application(service());
	application.begin();
	ipc::CreateSwapchain create;
	create.session = application.session;
	create.spec = {.format = VK_FORMAT_R8G8B8A8_SRGB,
				   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
				   .width = 64,
				   .height = 64};
	const auto made = application.requests().ask<ipc::SwapchainCreated>(create, plenty);
	ASSERT_TRUE(made) << ipc::textOf(made.failure.text);
	ipc::DestroySwapchain destroy;
	destroy.swapchain = made.reply.swapchain;
	ASSERT_TRUE(application.requests().command(destroy, plenty));
	ipc::Submission submission; // as if it had been sent before, over the other socket
	submission.frame = 1;
	submission.blendMode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
	submission.layerCount = 1;
	submission.layers[0].type = ipc::LayerType::quad;
	submission.layers[0].width = submission.layers[0].height = 1;
	submission.layers[0].views[0].image = {.swapchain = made.reply.swapchain, .width = 64, .height = 64};
	ASSERT_EQ(application.frames->send(submission, realTime() + plenty), ipc::Transfer::done);
	for (uint64_t i = 2; i < 6; ++i) EXPECT_TRUE(application.frame(i));
	EXPECT_FALSE(application.requests().command(destroy, plenty)) << "twice is malformed";
}

TEST_F(Running, AMalformedClientIsClosedAndOthersGoOn)
{
	Application good(service(), "well-behaved"), bad(service(), "hostile");
	good.begin();
	bad.begin();
	ASSERT_TRUE(bad.frame(1));
	ipc::Submission submission;
	submission.frame = 2;
	submission.blendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
	submission.layerCount = 1; // a projection layer of a swapchain that is not there
	ASSERT_EQ(bad.frames->send(submission, realTime() + plenty), ipc::Transfer::done);
	EXPECT_TRUE(eventually(service(), [](const auto &status) { return clientNamed(status, "hostile").is_null(); }));
	EXPECT_EQ(bad.requests().ask<ipc::SessionCreated>(ipc::CreateSession{}, plenty).how, ipc::Answered::hungUp);
	for (uint64_t i = 1; i <= 5; ++i) EXPECT_TRUE(good.frame(i));
}

TEST_F(Running, RandomBytesCloseOnlyTheirConnection)
{
	for (const size_t size : {size_t(0), size_t(1), size_t(8), size_t(100), ipc::maxMessageSize + 1}) {
		ipc::Socket socket = connectTo(service().tree()).value();
		const std::vector<std::byte> bytes(size, std::byte(0xa5));
		if (size > 0) { ASSERT_GE(::send(socket.fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL), 0); }
		if (size == 0) socket.hangUp();
		ipc::Received received;
		EXPECT_EQ(socket.receive(received, realTime() + plenty), ipc::Transfer::hungUp) << size;
	}
	EXPECT_TRUE(service().status().contains("frames"));
}

TEST_F(Running, AnotherProtocolIsRefusedWithASentence)
{
	ipc::Requests requests(connectTo(service().tree()).value());
	ipc::Hello hello;
	hello.protocol = ipc::protocol + 1;
	const auto answer = requests.ask<ipc::Welcome>(hello, plenty);
	EXPECT_EQ(answer.how, ipc::Answered::refused);
	EXPECT_NE(ipc::textOf(answer.failure.text).find("restart the service"), std::string::npos) << ipc::textOf(answer.failure.text);
}

TEST_F(Running, AnApplicationThatDiesIsForgottenAndTimeGoesOn)
{
	{
		Application application(service(), "short-lived");
		application.begin();
		ASSERT_TRUE(application.frame(1));
		ASSERT_FALSE(clientNamed(service().status(), "short-lived").is_null());
	} // it holds the stepped clock as it goes
	EXPECT_TRUE(eventually(service(), [](const auto &status) { return clientNamed(status, "short-lived").is_null(); }));
	const int shown = service().status()["frames"]["shown"];
	EXPECT_TRUE(eventually(service(), [&](const auto &status) { return status["frames"]["shown"].template get<int>() > shown + 5; }));
}

TEST_F(Running, SettingsAndRecentringReachApplications)
{
	Application application(service());
	const ipc::SharedPageView<ipc::SystemPage> system(std::move(application.welcome.fds[0]));
	service().set(ipc::Setting::viewOffset, 0.25f);
	EXPECT_EQ(system->views.read()->viewOffset, 0.25f);
	service().set(ipc::Setting::viewOffset, 1);
	EXPECT_THROW(service().set(ipc::Setting::viewOffset, 2), std::runtime_error);
	const ipc::SharedPageView<ipc::ClientPage> page(std::move(application.welcome.fds[2]));
	const uint64_t events = page->eventCount.load();
	service().recenter();
	EXPECT_EQ(system->views.read()->recenterCount, 1u);
	ASSERT_EQ(page->eventCount.load(), events + 1);
	EXPECT_EQ(page->events[events % ipc::ClientPage::eventSlots].read()->type, ipc::EventType::recentered);
	EXPECT_EQ(application.requests().command(ipc::Recenter{}, plenty).how, ipc::Answered::hungUp) << "that is for monitors to ask";
	EXPECT_EQ(system->views.read()->recenterCount, 1u);
}

TEST(Starting, AWrongConfigurationEndsWithOneSentence)
{
	const PrivateTree tree;
	const auto file = tree.write("config.toml", "[clock]\nmode = \"fast\"\n");
	ChildProcess service({(programDirectory() / "arift-service").string(), "--config", file.string()}, tree.environment(),
						 tree.root() / "log");
	EXPECT_EQ(service.wait(std::chrono::seconds(60)), 1);
	EXPECT_NE(service.output().find(file.string() + ":2: clock.mode = 'fast', expected one of"), std::string::npos) << service.output();
}

TEST(Starting, AMissingRigIsToldToWhoConnects)
{
	const PrivateTree tree;
	ChildProcess service({(programDirectory() / "arift-service").string(), "--set", "headset.rig=no_such_rig"}, tree.environment(),
						 tree.root() / "log");
	std::optional<ipc::Socket> socket;
	for (const XrTime end = realTime() + plenty; !socket && !service.wait(std::chrono::milliseconds(5)) && realTime() < end;)
		socket = connectTo(tree);
	ASSERT_TRUE(socket) << "it listens before it opens anything\n" << service.output();
	ipc::Requests application(std::move(*socket));
	const auto answer = application.ask<ipc::Welcome>(ipc::Hello{}, plenty);
	EXPECT_EQ(answer.how, ipc::Answered::refused);
	EXPECT_EQ(answer.failure.result, XR_ERROR_RUNTIME_UNAVAILABLE);
	EXPECT_NE(ipc::textOf(answer.failure.text).find("no_such_rig"), std::string::npos) << ipc::textOf(answer.failure.text);
	EXPECT_EQ(service.wait(std::chrono::seconds(60)), 1);
	EXPECT_NE(service.output().find("no_such_rig"), std::string::npos) << service.output();
}

TEST(Starting, ASecondServiceSaysWhoHasTheLock)
{
	PrivateService first(stepped);
	ChildProcess another({(programDirectory() / "arift-service").string()}, first.tree().environment(), first.tree().root() / "second.log");
	EXPECT_EQ(another.wait(std::chrono::seconds(60)), 1);
	EXPECT_NE(another.output().find("another arift-service is running"), std::string::npos) << another.output();
	EXPECT_TRUE(first.status().contains("service"));
	EXPECT_EQ(first.process().stop(), 0) << "SIGTERM is an orderly end";
}
