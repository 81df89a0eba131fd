// Recordings drive tracker and cameras in their own timing, under a stepped clock.
#include "drivers/registry.h"
#include "drivers/replay/brd_file.h"
#include "runtime/base/error.h"
#include "tests/common/shared_data.h"
#include "tests/unit/drivers/configuration.h"
#include "tests/unit/drivers/recordings.h"
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::test;

namespace
{

struct Playing {
	std::unique_ptr<Clock> clock = makeSteppedClock(77 * second);
	Clock::Hold hold{*clock};
	std::stop_source stop;
	std::unique_ptr<Driver> driver;
	XrTime start = clock->now();

	explicit Playing(const std::filesystem::path &configuration, const CameraGeometry &geometry = {},
					 const XrPosef &imuInHead = identityPose)
		: driver(makeDriver(
			  "replay",
			  {.clock = *clock, .configuration = documentOf(configuration), .geometry = {geometry, geometry}, .imuInHead = imuInHead}))
	{
	}
	Outcome read(Camera &camera, CameraFrame &frame) { return camera.read(frame, clock->now() + second, stop.get_token()); }
	Outcome read(ImuTracker &tracker, ImuReport &report) { return tracker.read(report, clock->now() + second, stop.get_token()); }
};

std::vector<Record> nodding(int count)
{
	std::vector<Record> records;
	for (int i = 0; i < count; i++) {
		const float t = float(i) / 200;
		records.push_back(
			{t, {0.1f, 0.2f, 0.3f}, {0, 0, 9.81f}, {std::cos(t / 2), 0, 0, std::sin(t / 2)}, {1 + t, 2, 3}}); // turns left, goes east
	}
	return records;
}

} // namespace

TEST(Replay, PlaysImagesInTheirTimingAndBeginsAgain)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	Playing playing(replayConfiguration(folder, folder.path()));
	for (const uint32_t eye : {0u, 1u}) {
		const auto camera = playing.driver->openCamera(eye, makeHostFrameBuffer);
		ASSERT_TRUE(camera);
		EXPECT_EQ(camera->info().format, PixelFormat::grey8);
		EXPECT_NEAR(camera->info().frameRate, 20, 1e-9);
		for (int i = 0; i < 12; i++) {
			CameraFrame frame;
			ASSERT_EQ(playing.read(*camera, frame), Outcome::ready);
			EXPECT_EQ(frame.midExposure, playing.start + XrDuration(frame.sequence) * 50 * millisecond);
			EXPECT_EQ(playing.clock->now(), frame.arrival);
			EXPECT_EQ(std::to_integer<unsigned>(frame.buffer->bytes()[47]), 10 * (frame.sequence % 5 + 1) + eye);
		}
	}
	EXPECT_EQ(playing.driver->openCamera(2, makeHostFrameBuffer), nullptr);
}

TEST(Replay, PlaysTheImuOverTheSpanOfTheImages)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	Playing playing(replayConfiguration(folder, folder.path()));
	const auto tracker = playing.driver->openTracker();
	EXPECT_NEAR(tracker->info().sampleRate, 200, 1e-6);
	EXPECT_NEAR(tracker->info().tickPeriod, 0.005, 1e-9);
	int64_t tick = 0;
	for (int i = 1; i < 120; i++) { // the span holds 50 samples; the first is at the start itself
		ImuReport report;
		ASSERT_EQ(playing.read(*tracker, report), Outcome::ready);
		EXPECT_EQ(report.arrival, playing.start + i * 5 * millisecond);
		EXPECT_NEAR(report.samples[0].angularVelocity.x, (100 + i % 50) * 0.001, 1e-6);
		EXPECT_NEAR(report.samples[0].acceleration.z, 0.5, 1e-6);
		EXPECT_EQ(report.restarted, i == 1 || i % 50 == 0) << i;
		EXPECT_EQ(report.lostTicks, 0u);
		if (i > 1) { EXPECT_EQ(report.samples[0].tick, tick + 1); }
		tick = report.samples[0].tick;
	}
}

TEST(Replay, EndsWhereItIsNotToLoop)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	Playing playing(replayConfiguration(folder, folder.path(), "loop = false\n"));
	const auto tracker = playing.driver->openTracker();
	const auto camera = playing.driver->openCamera(0, makeHostFrameBuffer);
	ImuReport report;
	int samples = 0;
	while (playing.read(*tracker, report) == Outcome::ready) samples++;
	EXPECT_EQ(samples, 49);
	EXPECT_EQ(playing.read(*tracker, report), Outcome::lost);
	CameraFrame frame;
	ASSERT_EQ(playing.read(*camera, frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 4u);
	EXPECT_EQ(playing.read(*camera, frame), Outcome::lost);
	EXPECT_EQ(playing.driver->openTracker(), nullptr) << "opened again, it would be lost again";
	EXPECT_EQ(playing.driver->openCamera(0, makeHostFrameBuffer), nullptr);
}

TEST(Replay, EachDeviceIsGoneWithItsOwnEnd)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	Playing playing(replayConfiguration(folder, folder.path(), "loop = false\n"));
	const auto camera = playing.driver->openCamera(0, makeHostFrameBuffer);
	CameraFrame frame;
	while (playing.read(*camera, frame) == Outcome::ready)
		EXPECT_NE(playing.driver->openCamera(0, makeHostFrameBuffer) == nullptr, frame.sequence < 4) << frame.sequence;
	EXPECT_EQ(playing.driver->openCamera(1, makeHostFrameBuffer), nullptr);
	EXPECT_NE(playing.driver->openTracker(), nullptr) << "it has samples after the last image";
}

TEST(Replay, ABrdFilesTrackerIsGoneAtItsEnd)
{
	const TemporaryFolder folder;
	Playing playing(replayConfiguration(folder, folder.write("walk.brd", brdFile(nodding(20))), "loop = false\n"));
	const auto tracker = playing.driver->openTracker();
	ImuReport report;
	int samples = 0;
	while (playing.read(*tracker, report) == Outcome::ready) samples++;
	EXPECT_EQ(samples, 19);
	EXPECT_EQ(playing.driver->openTracker(), nullptr);
}

TEST(Replay, TheSensorsMayLieInTheRecordingsFolderItself)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	std::filesystem::rename(folder.path() / "mav0", folder.path() / "walk");
	for (const char *path : {"walk", "walk/"}) {
		Playing playing(replayConfiguration(folder, path));
		EXPECT_EQ(playing.driver->name(), "recording walk");
		EXPECT_NE(playing.driver->openCamera(1, makeHostFrameBuffer), nullptr);
	}
	writeEuroc(folder.path() / "hike");
	for (const char *path : {"hike", "hike/mav0", "hike/mav0/"})
		EXPECT_EQ(Playing(replayConfiguration(folder, path)).driver->name(), "recording hike");
}

TEST(Replay, AMonocularRecordingHasNoRightCamera)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	std::filesystem::remove_all(folder.path() / "mav0/cam1");
	Playing playing(replayConfiguration(folder, folder.path()));
	EXPECT_NE(playing.driver->openCamera(0, makeHostFrameBuffer), nullptr);
	EXPECT_EQ(playing.driver->openCamera(1, makeHostFrameBuffer), nullptr);
}

TEST(Replay, ABrdFilesSamplesAreTurnedIntoTheTrackersAxes)
{
	const TemporaryFolder folder;
	const auto file = folder.write("walk.brd", brdFile(nodding(400)));
	const XrPosef imuInHead{rotationAbout({0, 0, 1}, M_PI / 2), {0, 0, 0}};
	Playing playing(replayConfiguration(folder, file), {}, imuInHead);
	const auto tracker = playing.driver->openTracker();
	ImuReport report;
	ASSERT_EQ(playing.read(*tracker, report), Outcome::ready);
	// recorded up is +z; in head axes +y; in those of a tracker rolled by 90 degrees +x
	EXPECT_NEAR(report.samples[0].acceleration.x, 9.81, 1e-4);
	EXPECT_NEAR(report.samples[0].acceleration.y, 0, 1e-4);
	EXPECT_NEAR(report.samples[0].angularVelocity.x, 0.3, 1e-5);
	EXPECT_NEAR(report.samples[0].angularVelocity.y, 0.1, 1e-5);
	EXPECT_NEAR(report.samples[0].angularVelocity.z, 0.2, 1e-5);
}

TEST(Replay, ReferencePosesBeginAtTheOriginAndBridgeGaps)
{
	auto records = nodding(400);
	for (size_t i = 100; i < 200; i++) records[i].orientation[2] = NAN;
	const TemporaryFolder folder;
	const auto recording = replay::readBrd(folder.write("walk.brd", brdFile(records)));
	EXPECT_EQ(recording.name, "made by a test");
	const Trajectory trajectory = replay::headTrajectory(recording, replay::imuInHead(recording));
	EXPECT_EQ(trajectory.size(), 300u);
	EXPECT_NEAR(glm::length(trajectory[0].position), 0, 1e-9);
	EXPECT_NEAR(angleBetween(toXr(trajectory[0].orientation), identityOrientation), 0, 1e-6);
	const TimedPose middle = interpolate(trajectory, 0.75); // in the gap
	EXPECT_NEAR(angleBetween(toXr(middle.orientation), rotationAbout({0, 1, 0}, 0.75)), 0, 1e-5) << "left is about +y";
	EXPECT_NEAR(glm::length(middle.position), 0.75, 1e-5);
	EXPECT_NEAR(middle.position.y, 0, 1e-9);
}

TEST(Replay, SimulatedCamerasFollowTheReference)
{
	const TemporaryFolder folder;
	const auto file = folder.write("walk.brd", brdFile(nodding(400)));
	const PlainLens lens;
	Playing playing(replayConfiguration(folder, file,
										"[synthetic]\ncamera_noise = false\ncamera_rate = 20\ntransfer_delay_ms = 5\n"
										"markers = [{position = [0, 0, -2], radius = 0.06}]\n"),
					lens.geometry());
	const auto camera = playing.driver->openCamera(1, makeHostFrameBuffer);
	const auto trajectory = replay::headTrajectory(replay::readBrd(file), replay::imuInHead(replay::readBrd(file)));
	for (int i = 0; i < 4; i++) {
		CameraFrame frame;
		ASSERT_EQ(playing.read(*camera, frame), Outcome::ready);
		const TimedPose head = interpolate(trajectory, inSeconds(frame.midExposure - playing.start));
		const glm::dvec3 d = glm::conjugate(head.orientation) * (glm::dvec3{0, 0, -2} - head.position);
		const glm::dvec2 expected = lens.project({d.x, -d.y, -d.z});
		const auto x = uint32_t(std::lround((expected.x - 1) / 2) * 2 + 1), y = uint32_t(std::lround(expected.y / 2) * 2); // a red pixel
		EXPECT_EQ(std::to_integer<int>(frame.buffer->bytes()[size_t(y) * 752 + x]), 240);
	}
}

TEST(Replay, RealStereoImagesAndImu)
{
	const auto recorded = sharedData("micro_euroc");
	if (!recorded) GTEST_SKIP() << noSharedData;
	const TemporaryFolder folder;
	Playing playing(replayConfiguration(folder, *recorded));
	const auto tracker = playing.driver->openTracker();
	const auto camera = playing.driver->openCamera(1, makeHostFrameBuffer);
	CameraFrame frame;
	for (int i = 0; i < 30; i++) {
		ASSERT_EQ(playing.read(*camera, frame), Outcome::ready);
		EXPECT_EQ(frame.sequence, uint64_t(i));
		EXPECT_EQ(frame.width, 752u);
		EXPECT_EQ(frame.height, 480u);
		double mean = 0;
		for (const std::byte value : frame.buffer->bytes()) mean += std::to_integer<int>(value) / (752.0 * 480);
		EXPECT_GT(mean, 20);
		EXPECT_LT(mean, 220);
	}
	glm::dvec3 force{0};
	ImuReport report;
	for (int i = 0; i < 500; i++) {
		ASSERT_EQ(playing.read(*tracker, report), Outcome::ready);
		force += toGlm(report.samples[0].acceleration) / 500.0;
	}
	EXPECT_NEAR(glm::length(force), 9.81, 0.5);
	EXPECT_EQ(camera->info().malformed, 0u);
}

TEST(Replay, RealHeadMotionWithItsImu)
{
	const auto recorded = sharedData("vi/tumvi_room1.brd");
	if (!recorded) GTEST_SKIP() << noSharedData;
	const auto recording = replay::readBrd(*recorded);
	EXPECT_EQ(recording.records.size(), 28122u);
	const glm::dquat imuInHead = replay::imuInHead(recording);
	const Trajectory trajectory = replay::headTrajectory(recording, imuInHead);
	// the gyroscope in head axes agrees with the motion of the reference: axes and directions of both are right
	double agreement = 0, gyroscope = 0, reference = 0;
	for (size_t i = 2000; i + 20 < recording.records.size(); i += 50) {
		const double t = recording.records[i].seconds;
		const auto before = interpolate(trajectory, t - 0.05), after = interpolate(trajectory, t + 0.05);
		glm::dquat turn = glm::conjugate(before.orientation) * after.orientation;
		if (turn.w < 0) turn = -turn;
		glm::dvec3 mean{0};
		for (size_t k = i - 10; k <= i + 10; k++) mean += imuInHead * recording.records[k].angularVelocity / 21.0;
		const glm::dvec3 fromReference = glm::dvec3{turn.x, turn.y, turn.z} * 2.0 / 0.1;
		agreement += glm::dot(mean, fromReference);
		gyroscope += glm::dot(mean, mean);
		reference += glm::dot(fromReference, fromReference);
	}
	EXPECT_GT(agreement / std::sqrt(gyroscope * reference), 0.98);
	EXPECT_NEAR(gyroscope / reference, 1, 0.1);
	const glm::dvec3 up = imuInHead * recording.records[0].acceleration;
	EXPECT_GT(up.y / glm::length(up), 0.99) << "level at the start";
}
