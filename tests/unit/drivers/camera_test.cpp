// When images are exposed, made and handed out, under a stepped clock; and what becomes of their buffers.
#include "drivers/played_camera.h"
#include "drivers/registry.h"
#include "runtime/base/error.h"
#include "tests/unit/drivers/configuration.h"
#include "tests/unit/drivers/support.h"
#include <gtest/gtest.h>
#include <thread>

using namespace arift;

namespace
{

/// A 4 x 2 image every 10 ms that holds its number; available 15 ms after its exposure.
class Numbers final : public ImageSource
{
public:
	explicit Numbers(XrTime start) : start_(start) {}
	CameraInfo info() const override { return {.name = "numbers", .width = 4, .height = 2, .frameRate = 100}; }
	std::optional<Timing> timing(uint64_t sequence) const override
	{
		if (sequence >= 1000) return std::nullopt;
		const XrTime time = start_ + XrDuration(sequence) * 10 * millisecond;
		return Timing{time, millisecond, time + 15 * millisecond};
	}
	bool make(uint64_t sequence, std::span<std::byte> pixels) override
	{
		std::fill(pixels.begin(), pixels.end(), std::byte(sequence & 255));
		return pixels.size() == 8 && sequence != 7; // the seventh is damaged
	}

private:
	const XrTime start_;
};

struct Simulation {
	std::unique_ptr<Clock> clock = makeSteppedClock(50 * second);
	Clock::Hold hold{*clock};
	std::stop_source stop;
	XrTime start = clock->now();
	uint32_t allocated = 0;
	PlayedCamera camera{*clock, std::make_unique<Numbers>(start), [this](size_t bytes) {
							allocated++;
							return makeHostFrameBuffer(bytes);
						}};

	Outcome read(CameraFrame &frame, XrDuration within = second) { return camera.read(frame, clock->now() + within, stop.get_token()); }
	void sleep(XrDuration duration) { clock->sleepUntil(clock->now() + duration, stop.get_token()); }
};

std::shared_ptr<const TomlDocument> settingsFile(const test::TemporaryFolder &folder, const std::string &settings)
{
	return test::documentOf(folder.write("config.toml", "[synthetic]\n" + settings));
}

} // namespace

TEST(PlayedCamera, DeliversEachImageWhenItArrives)
{
	Simulation setup;
	for (uint64_t k = 0; k < 5; k++) {
		CameraFrame frame;
		ASSERT_EQ(setup.read(frame), Outcome::ready);
		EXPECT_EQ(frame.sequence, k);
		EXPECT_EQ(frame.midExposure, setup.start + XrDuration(k) * 10 * millisecond);
		EXPECT_EQ(frame.arrival, frame.midExposure + 15 * millisecond);
		EXPECT_EQ(setup.clock->now(), frame.arrival);
		EXPECT_EQ(frame.stride, 4u);
		EXPECT_EQ(frame.buffer->bytes()[3], std::byte(k));
	}
	EXPECT_EQ(setup.camera.info().dropped, 0u);
}

TEST(PlayedCamera, SkipsToTheNewestAndCountsTheRest)
{
	Simulation setup;
	CameraFrame frame;
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	setup.sleep(35 * millisecond);
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 3u);
	EXPECT_EQ(frame.arrival, setup.start + 45 * millisecond) << "that was a while ago";
	EXPECT_EQ(setup.clock->now(), setup.start + 50 * millisecond);
	EXPECT_EQ(setup.camera.info().dropped, 2u);
}

TEST(PlayedCamera, TimesOutAtTheDeadlineAndKeepsItsImage)
{
	Simulation setup;
	CameraFrame frame;
	EXPECT_EQ(setup.read(frame, 5 * millisecond), Outcome::timeout);
	EXPECT_EQ(setup.clock->now(), setup.start + 5 * millisecond);
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 0u);
	setup.stop.request_stop();
	EXPECT_EQ(setup.read(frame), Outcome::timeout);
}

TEST(PlayedCamera, DropsDamagedImagesAndEnds)
{
	Simulation setup;
	CameraFrame frame;
	setup.sleep(6 * 10 * millisecond + 15 * millisecond);
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 6u);
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 8u);
	EXPECT_EQ(setup.camera.info().malformed, 1u);
	setup.sleep(20 * second);
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.sequence, 999u);
	EXPECT_EQ(setup.read(frame), Outcome::lost);
}

TEST(PlayedCamera, ABufferIsFilledAgainOnlyWhenItsFrameIsGone)
{
	Simulation setup;
	std::vector<CameraFrame> held;
	CameraFrame frame;
	while (setup.read(frame, 15 * millisecond) == Outcome::ready) held.push_back(frame);
	ASSERT_EQ(held.size(), 6u) << "as many as there are buffers";
	frame = {};
	for (size_t i = 0; i < held.size(); i++) EXPECT_EQ(held[i].buffer->bytes()[0], std::byte(i)) << "nobody wrote into what is held";
	EXPECT_EQ(setup.allocated, 6u);
	EXPECT_GT(setup.camera.info().dropped, 0u);
	const FrameBuffer *released = held[2].buffer.get();
	held[2] = {};
	ASSERT_EQ(setup.read(frame), Outcome::ready);
	EXPECT_EQ(frame.buffer.get(), released);
	EXPECT_EQ(setup.allocated, 6u);
}

TEST(PlayedCamera, FramesOutliveTheirCameraAndAreReleasedOnAnyThread)
{
	CameraFrame kept;
	{
		Simulation setup;
		for (int i = 0; i < 20; i++) {
			CameraFrame frame;
			setup.read(frame);
			std::thread([taken = std::move(frame)]() mutable { taken.buffer.reset(); }).join();
		}
		EXPECT_EQ(setup.camera.info().dropped, 0u);
		setup.read(kept);
	}
	EXPECT_EQ(kept.buffer->bytes()[0], std::byte(kept.sequence));
}

TEST(SyntheticCamera, ExposesAndArrivesAsSet)
{
	const test::TemporaryFolder folder;
	const auto clock = makeSteppedClock(10 * second);
	const Clock::Hold hold(*clock);
	const auto geometry = test::PlainLens{.width = 64, .height = 48, .focalLength = 40}.geometry();
	const auto driver =
		makeDriver("synthetic", {.clock = *clock,
								 .configuration = settingsFile(folder, "motion = \"rest\"\ncamera_rate = 50\nexposure_ms = 4\n"
																	   "transfer_delay_ms = 30\ncamera_phase = 0.25\n"),
								 .geometry = {geometry, geometry}});
	const XrTime start = clock->now();
	std::stop_source stop;
	for (const uint32_t eye : {0u, 1u}) {
		const auto camera = driver->openCamera(eye, makeHostFrameBuffer);
		ASSERT_TRUE(camera);
		EXPECT_EQ(camera->info().format, PixelFormat::bayerGrbg8);
		for (int i = 0; i < 3; i++) {
			CameraFrame frame;
			ASSERT_EQ(camera->read(frame, clock->now() + second, stop.get_token()), Outcome::ready);
			const double periods = inSeconds(frame.midExposure - start) * 50;
			EXPECT_NEAR(periods - std::floor(periods), eye == 0 ? 0 : 0.25, 1e-6);
			EXPECT_EQ(frame.exposure, 4 * millisecond);
			EXPECT_EQ(frame.arrival, frame.midExposure + 32 * millisecond);
			EXPECT_EQ(clock->now(), frame.arrival);
		}
	}
	EXPECT_EQ(driver->openCamera(2, makeHostFrameBuffer), nullptr);
}

TEST(SyntheticCamera, JitterChangesTheReportedTimeAlone)
{
	const test::TemporaryFolder folder;
	const auto clock = makeSteppedClock(10 * second);
	const Clock::Hold hold(*clock);
	const auto geometry = test::PlainLens{.width = 16, .height = 16, .focalLength = 40}.geometry();
	const auto driver = makeDriver(
		"synthetic",
		{.clock = *clock, .configuration = settingsFile(folder, "camera_rate = 50\ncamera_jitter_ms = 2\n"), .geometry = {geometry, {}}});
	const auto camera = driver->openCamera(0, makeHostFrameBuffer);
	EXPECT_EQ(driver->openCamera(1, makeHostFrameBuffer), nullptr) << "no rays, no camera";
	std::stop_source stop;
	double square = 0;
	XrTime last = 0;
	constexpr int count = 400;
	for (int i = 0; i < count; i++) {
		CameraFrame frame;
		ASSERT_EQ(camera->read(frame, clock->now() + second, stop.get_token()), Outcome::ready);
		if (last) { EXPECT_EQ(frame.arrival - last, 20 * millisecond); }
		last = frame.arrival;
		const double error = inSeconds(frame.midExposure - (frame.arrival - frame.exposure / 2 - 21'300 * microsecond));
		square += error * error / count;
	}
	EXPECT_NEAR(std::sqrt(square), 0.002, 0.0003);
}

TEST(Registry, MakesDriversByName)
{
	const auto clock = makeSteppedClock(0);
	const DriverContext context{.clock = *clock};
	EXPECT_EQ(driverNames(), (std::vector<std::string>{"synthetic", "replay"}));
	EXPECT_EQ(makeDriver("synthetic", context)->name(), "synthetic headset");
	EXPECT_EQ(makeDriver("auto", context)->name(), "synthetic headset");
	EXPECT_THROW(makeDriver("rift", context), InputError);
	EXPECT_THROW(makeDriver("replay", context), InputError) << "no recording named";
	EXPECT_EQ(makeDriver("synthetic", context)->openCamera(0, makeHostFrameBuffer), nullptr);
	EXPECT_NE(makeDriver("synthetic", context)->openTracker(), nullptr);
}

TEST(Registry, ChecksEveryDriversTable)
{
	const test::TemporaryFolder folder;
	const auto check = [&](const std::string &text) -> std::string {
		try {
			checkDriverSettings(test::documentOf(folder.write("config.toml", text)));
		} catch (const InputError &error) {
			return error.what();
		}
		return "";
	};
	EXPECT_EQ(check(""), "");
	EXPECT_EQ(check("[replay]\nloop = false\n[synthetic]\nmotion = 'file'\nmotion_file = 'nowhere.csv'\n"), "") << "opens nothing";
	EXPECT_NE(check("[replay]\nlop = false\n").find(":2: unknown key replay.lop"), std::string::npos);
	EXPECT_NE(check("[synthetic]\nsample_rate = 300\n").find(":2: synthetic.sample_rate = 300"), std::string::npos);
}
