// Recordings in the place of sensors, through the whole system: their images and their motion are on the panel.
#include "runtime/ipc/shared_memory.h"
#include "runtime/motion/pose_history.h"
#include "tests/common/shared_data.h"
#include "tests/e2e/common/private_service.h"
#include "tests/e2e/replay/stereo_recording.h"
#include "tests/unit/drivers/recordings.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arift::e2e
{
namespace
{

PrivateService replaying(const std::filesystem::path &recording, const std::string &rig)
{
	return PrivateService("[headset]\ndriver = \"replay\"\nrig = \"" + rig + "\"\n[clock]\nmode = \"stepped\"\n" +
						  "[compositor]\ntarget = \"offscreen\"\n[replay]\nrecording = \"" + recording.string() + "\"\n");
}

/// The newest sample of head motion, read as an application reads it.
MotionSample newestMotion(const PrivateService &service)
{
	ipc::Requests application(connectTo(service.tree()).value());
	auto welcome = application.ask<ipc::Welcome>(ipc::Hello{}, 75 * second);
	if (!welcome || welcome.fdCount < 3) throw std::runtime_error("Hello: " + ipc::textOf(welcome.failure.text));
	const ipc::SharedPageView<PoseRing> ring(std::move(welcome.fds[1]));
	MotionSample newest;
	if (!PoseHistory(*ring).newest(newest)) throw std::runtime_error("no pose was written");
	return newest;
}

struct Rates {
	double camera, tracker; ///< per second
};

void expectSteadyFrames(PrivateService &service, const Rates &rates)
{
	constexpr int enough = 90;
	service.status(true);
	ASSERT_TRUE(eventually(service, [](const auto &status) { return status["frames"]["shown"].template get<int>() >= enough; }));
	const nlohmann::json status = service.status();
	const nlohmann::json &frames = status["frames"], &tracker = status["tracker"];
	EXPECT_EQ(status["headset"]["driver"], "replay");
	EXPECT_NEAR(frames["perSecond"].get<double>(), 59.91, 0.2);
	EXPECT_EQ(frames["missed"], 0) << "composing takes no simulated time";
	// A sample is as old as the panel's 25 ms, a frame's work and its own period make it; an image is 15 ms older when it arrives.
	EXPECT_GT(frames["poseAgeMs"]["median"].get<double>(), 25);
	EXPECT_LT(frames["poseAgeMs"]["p99"].get<double>(), 35 + 1e3 / rates.tracker);
	EXPECT_GT(frames["cameraAgeMs"]["median"].get<double>(), 40);
	EXPECT_LT(frames["cameraAgeMs"]["p99"].get<double>(), 80 + 1e3 / rates.camera);
	ASSERT_EQ(status["cameras"].size(), 2u);
	for (const nlohmann::json &camera : status["cameras"]) {
		EXPECT_EQ(camera["open"], true);
		EXPECT_NEAR(camera["frameRate"].get<double>(), rates.camera, 0.02 * rates.camera);
		EXPECT_GE(camera["received"].get<double>(), enough / 59.91 * rates.camera - 2);
		EXPECT_EQ(camera["malformed"], 0);
	}
	EXPECT_EQ(tracker["open"], true);
	EXPECT_NEAR(tracker["rate"].get<double>(), rates.tracker, 0.02 * rates.tracker);
	EXPECT_EQ(tracker["malformed"], 0);
}

void expectAWorld(const PanelPicture &panel)
{
	for (const Statistics &eye : statisticsOfEyes(panel)) {
		EXPECT_GT(eye.lit, 0.9) << "the middle of an eye is not black";
		EXPECT_GT(eye.mean, 15);
		EXPECT_LT(eye.mean, 235);
		EXPECT_GT(eye.deviation, 8) << "there are things in it";
	}
}

/// Mean difference between two pictures, of 255.
double difference(const PanelPicture &a, const PanelPicture &b)
{
	double sum = 0;
	for (size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
	return sum / double(a.rgba.size()) * 4 / 3; // alpha is the same
}

/// The panel, and the panel half a second later.
std::array<PanelPicture, 2> halfASecondApart(PrivateService &service)
{
	PanelPicture first = service.screenshot();
	const int shown = service.status()["frames"]["shown"];
	EXPECT_TRUE(eventually(service, [&](const auto &status) { return status["frames"]["shown"].template get<int>() >= shown + 30; }));
	return {std::move(first), service.screenshot()};
}

void expectLevelTurn(const MotionSample &motion, double yawRate)
{
	EXPECT_NEAR(motion.angularVelocity.x, 0, 0.02);
	EXPECT_NEAR(motion.angularVelocity.y, yawRate, 0.02) << "to the left is about +y";
	EXPECT_NEAR(motion.angularVelocity.z, 0, 0.02);
	EXPECT_GT(rotate(motion.headInOrigin, {0, 1, 0}).y, 0.999f) << "the head is level";
}

TEST(Replay, AStereoRecordingIsShownThroughItsOwnCalibration)
{
	const test::TemporaryFolder folder;
	writeStereoRecording(folder.path(), 0.3);
	PrivateService service = replaying(folder.path(), "recording");
	expectSteadyFrames(service, {.camera = 20, .tracker = 200});
	const PanelPicture panel = service.screenshot();
	expectAWorld(panel);
	const auto [left, right] = statisticsOfEyes(panel);
	EXPECT_GT(left.deviation, 25) << "chequers, not their mean";
	EXPECT_GT(right.mean, left.mean + 30) << "each eye has its own camera";
	expectLevelTurn(newestMotion(service), 0.3);
}

TEST(Replay, ABrdRecordingMovesTheHeadAndTheSimulatedCameras)
{
	constexpr float yawRate = 0.5f;
	std::vector<test::Record> records;
	for (int i = 0; i < 1200; ++i) { // six seconds; recorded up is +z
		const float time = float(i) / 200, half = yawRate * time / 2;
		records.push_back({time, {0, 0, yawRate}, {0, 0, 9.81f}, {std::cos(half), 0, 0, std::sin(half)}, {0, 0, 0}});
	}
	const test::TemporaryFolder folder;
	PrivateService service = replaying(folder.write("turn.brd", test::brdFile(records)), "arift");
	expectSteadyFrames(service, {.camera = 43, .tracker = 200});
	expectLevelTurn(newestMotion(service), yawRate);
	const auto pictures = halfASecondApart(service);
	expectAWorld(pictures[0]);
	expectAWorld(pictures[1]);
	EXPECT_GT(difference(pictures[0], pictures[1]), 5) << "a quarter of a radian farther on the room looks otherwise";
}

TEST(Replay, ARecordingThatIsNotThereIsNamed)
{
	try {
		replaying("/no/such/recording", "recording");
		ADD_FAILURE() << "replays nothing";
	} catch (const std::runtime_error &problem) {
		EXPECT_NE(std::string(problem.what()).find("/no/such/recording"), std::string::npos) << problem.what();
	}
}

TEST(Replay, RealStereoImages)
{
	const auto recording = test::sharedData("micro_euroc");
	if (!recording) GTEST_SKIP() << test::noSharedData;
	PrivateService service = replaying(*recording, "recording");
	expectSteadyFrames(service, {.camera = 20, .tracker = 200});
	expectAWorld(service.screenshot());
	EXPECT_GT(rotate(newestMotion(service).headInOrigin, {0, 1, 0}).y, 0.8f) << "upright, though the body frame is not";
}

TEST(Replay, RealMotionMovesTheHeadAndTheSimulatedCameras)
{
	const auto recording = test::sharedData("vi/tumvi_room1.brd");
	if (!recording) GTEST_SKIP() << test::noSharedData;
	PrivateService service = replaying(*recording, "arift");
	expectSteadyFrames(service, {.camera = 43, .tracker = 200});
	const auto pictures = halfASecondApart(service);
	expectAWorld(pictures[0]);
	EXPECT_GT(difference(pictures[0], pictures[1]), 1) << "nobody holds a camera so still";
}

} // namespace
} // namespace arift::e2e
