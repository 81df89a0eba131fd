// What people can get wrong: every case ends with one message that names the file and what was expected.
#include "drivers/registry.h"
#include "drivers/replay/brd_file.h"
#include "drivers/synthetic/settings.h"
#include "drivers/trajectory.h"
#include "runtime/base/error.h"
#include "tests/unit/drivers/configuration.h"
#include "tests/unit/drivers/recordings.h"
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::test;

namespace
{

/// The message of the InputError that `action` throws; empty when it throws none.
template <typename Action> std::string complaint(Action action)
{
	try {
		action();
	} catch (const InputError &error) {
		return error.what();
	}
	return {};
}

void expectComplaint(const std::string &message, std::initializer_list<const char *> parts)
{
	for (const char *part : parts) EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}

std::vector<Record> rest(size_t count)
{
	std::vector<Record> records;
	for (size_t i = 0; i < count; i++) records.push_back({float(i) / 200, {}, {0, 0, 9.81f}, {1, 0, 0, 0}, {}});
	return records;
}

std::string patched(std::string bytes, size_t at, const auto &value)
{
	std::memcpy(bytes.data() + at, &value, sizeof value);
	return bytes;
}

std::string replayComplaint(const TemporaryFolder &folder)
{
	const auto clock = makeSteppedClock(0);
	return complaint(
		[&] { makeDriver("replay", {.clock = *clock, .configuration = documentOf(replayConfiguration(folder, folder.path()))}); });
}

} // namespace

TEST(DamagedInput, BrdFiles)
{
	const std::string good = brdFile(rest(10));
	struct {
		std::string bytes;
		const char *expected;
	} cases[] = {{"", "expected a header of 64"},
				 {good.substr(0, 40), "expected a header of 64"},
				 {"BRC1" + good.substr(4), "BRD1"},
				 {patched(good, 4, 63u), "header size 63"},
				 {patched(good, 4, 0xffffffffu), "header size"},
				 {patched(good, 8, 28u), "record size 28, expected 72"},
				 {patched(good, 12, 0u), "0 records"},
				 {patched(good, 12, 0xffffffffu), "for 4294967295 records"},
				 {patched(good, 16, -3.0), "rate -3"},
				 {patched(good, 16, double(NAN)), "rate nan"},
				 {good.substr(0, good.size() - 1), "783 bytes, expected 784 for 10 records"},
				 {good + "x", "785 bytes, expected 784"},
				 {patched(good, 64 + 3 * 72 + 4, NAN), "record 3: field 1 is nan"},
				 {patched(good, 64 + 5 * 72 + 16, 1e9f), "record 5: field 4"},
				 {patched(good, 64 + 4 * 72, 0.001f), "record 4: time 0.001"}};
	const TemporaryFolder folder;
	for (const auto &c : cases) {
		const auto file = folder.write("bad.brd", c.bytes);
		expectComplaint(complaint([&] { replay::readBrd(file); }), {"bad.brd", c.expected});
	}
	EXPECT_EQ(complaint([&] { replay::readBrd(folder.write("good.brd", good)); }), "");
	expectComplaint(complaint([&] { replay::readBrd(folder.path() / "none.brd"); }), {"none.brd", "no such file"});
	expectComplaint(complaint([&] { replay::readBrd(folder.path()); }), {"cannot be read"});
	auto unseen = rest(10);
	for (Record &record : unseen) record.orientation[0] = NAN;
	const auto recording = replay::readBrd(folder.write("unseen.brd", brdFile(unseen)));
	expectComplaint(complaint([&] { replay::headTrajectory(recording, {1, 0, 0, 0}); }), {"unseen.brd", "0 reference poses"});
}

TEST(DamagedInput, EurocFolders)
{
	struct {
		const char *file, *content; ///< null: removed
		std::initializer_list<const char *> expected;
	} cases[] = {
		{"mav0/cam0/data.csv", nullptr, {"cam0/data.csv", "no such file"}},
		{"mav0/cam0/data.csv", "#only a header\n", {"cam0/data.csv", "no images"}},
		{"mav0/cam1/data.csv", "#h\n12a,x.png\n", {"cam1/data.csv:2", "\"12a\"", "whole number"}},
		{"mav0/cam1/data.csv",
		 "#h\n5,1403715273262142976.png\n5,1403715273262142976.png\n",
		 {"cam1/data.csv:3", "after that of the row before"}},
		{"mav0/cam1/data.csv", "#h\n-5,x.png\n", {"cam1/data.csv:2", "\"-5\""}},
		{"mav0/cam1/data.csv", "#h\n5\n", {"cam1/data.csv:2", "expected a text in column 2"}},
		{"mav0/cam1/data.csv", "#h\n\n5,../../nowhere.png\n", {"data/nowhere.png", "no such file", "cam1/data.csv:3"}},
		{"mav0/cam0/data/1403715273262142976.png", "no picture", {"1403715273262142976.png", "expected a PNG image", "data.csv:2"}},
		{"mav0/cam0/data/1403715273312142976.png", nullptr, {"1403715273312142976.png", "no such file", "data.csv:3"}},
		{"mav0/imu0/data.csv", nullptr, {"imu0/data.csv", "no such file"}},
		{"mav0/imu0/data.csv", "#h\n1403715273262142976,0,0,0,0,9.8\n", {"imu0/data.csv:2", "6 columns"}},
		{"mav0/imu0/data.csv", "#h\n1403715273262142976,0,x,0,0,9.8,0\n", {"imu0/data.csv:2", "\"x\" in column 3", "a number"}},
		{"mav0/imu0/data.csv", "#h\n1403715273262142976,0,nan,0,0,9.8,0\n", {"imu0/data.csv:2", "column 3"}},
		{"mav0/imu0/data.csv", "#h\n1403715273262142976,0,0,5000,0,9.8,0\n", {"imu0/data.csv:2", "5000", "rad/s"}},
		{"mav0/imu0/data.csv", "#h\n100,0,0,0,0,9.8,0\n", {"imu0/data.csv", "no sample while the images last"}}};
	for (const auto &c : cases) {
		const TemporaryFolder folder;
		writeEuroc(folder.path());
		EXPECT_EQ(replayComplaint(folder), "");
		std::filesystem::remove(folder.path() / c.file);
		if (c.content) folder.write(c.file, c.content);
		expectComplaint(replayComplaint(folder), c.expected);
	}
	const TemporaryFolder empty;
	expectComplaint(replayComplaint(empty), {"no folder cam0", "EuRoC"});
}

TEST(DamagedInput, ImagesOfAnotherSizeOrFormat)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	const auto image = folder.path() / "mav0/cam0/data/1403715273312142976.png";
	writeGreyPng(image, 9, 6, 1);
	expectComplaint(replayComplaint(folder), {"1403715273312142976.png", "9 x 6, expected 8 x 6"});
}

TEST(DamagedInput, AnImageThatBreaksOffIsCountedAndDropped)
{
	const TemporaryFolder folder;
	writeEuroc(folder.path());
	const auto clock = makeSteppedClock(0);
	const Clock::Hold hold(*clock);
	const auto image = folder.path() / "mav0/cam0/data/1403715273312142976.png";
	std::filesystem::resize_file(image, std::filesystem::file_size(image) - 18); // within the pixels
	const auto driver = makeDriver("replay", {.clock = *clock, .configuration = documentOf(replayConfiguration(folder, folder.path()))});
	const auto camera = driver->openCamera(0, makeHostFrameBuffer);
	std::stop_source stop;
	CameraFrame frame;
	ASSERT_EQ(camera->read(frame, second, stop.get_token()), Outcome::ready);
	EXPECT_EQ(frame.sequence, 0u);
	ASSERT_EQ(camera->read(frame, second, stop.get_token()), Outcome::ready);
	EXPECT_EQ(frame.sequence, 2u);
	EXPECT_EQ(camera->info().malformed, 1u);
}

TEST(DamagedInput, TrajectoryTables)
{
	const std::string header = "time_ns,px,py,pz,qw,qx,qy,qz\n";
	struct {
		std::string content;
		const char *expected;
	} cases[] = {{"", "0 poses"},
				 {header + "0,0,0,0,1,0,0,0\n", "1 poses"},
				 {header + "0,0,0,0,1,0,0\n", "bad.csv:2: 7 columns"},
				 {header + "0,0,0,0,1,0,0,0\n0,0,0,0,1,0,0,0\n", "bad.csv:3"},
				 {header + "0,0,0,0,2,0,0,0\n", "unit quaternion"},
				 {header + "0,0,1e9,0,1,0,0,0\n", "a position in metres"},
				 {header + "0.5,0,0,0,1,0,0,0\n", "\"0.5\" in column 1"},
				 {header + "0,0,,0,1,0,0,0\n", "\"\" in column 3"},
				 {header + "0,0,inf,0,1,0,0,0\n", "column 3"}};
	const TemporaryFolder folder;
	for (const auto &c : cases) {
		const auto file = folder.write("bad.csv", c.content);
		expectComplaint(complaint([&] { readTrajectoryCsv(file); }), {"bad.csv", c.expected});
	}
}

TEST(DamagedInput, SyntheticSettings)
{
	struct {
		const char *settings, *expected;
	} cases[] = {{"motion = \"dancing\"", "\"natural\""},
				 {"motion = \"constant\"", "synthetic.rate is missing"},
				 {"motion = \"constant\"\nrate = [1, 2]", "an array of 3 numbers"},
				 {"motion = \"file\"", "synthetic.motion_file is missing"},
				 {"speed = 3", "unknown key synthetic.speed"},
				 {"sample_rate = 300", "250, 500 or 1000"},
				 {"camera_rate = 0", "camera_rate"},
				 {"camera_rate = 100\nexposure_ms = 11", "a number from 0 to 10"},
				 {"tracker_noise = 1", "true or false"},
				 {"gyro_bias = 3", "an array of 3 numbers"},
				 {"markers = [{position = [0, 0, 0], radius = 0.1}]", "at least 0.05 m"},
				 {"markers = [{position = [0, 0, -1]}]", "markers[0].radius is missing"},
				 {"markers = [{position = [0, 0, -1], radius = 0.1, size = 2}]", "markers[0].size"},
				 {"markers = 3", "an array of tables"}};
	const TemporaryFolder folder;
	for (const auto &c : cases) {
		const auto file = folder.write("config.toml", std::string("[synthetic]\n") + c.settings + "\n");
		expectComplaint(complaint([&] { synthetic::readSettings(documentOf(file)); }), {"config.toml:", c.expected});
	}
	const auto good =
		folder.write("good.toml", "[other]\nx = 1\n[synthetic]\nmotion = \"constant\"\nrate = [0, 90, 0]\ngyro_bias = [1, 0, 0]\n"
								  "markers = [{position = [0, 0, -1], radius = 0.1}]\n");
	const synthetic::Settings settings = synthetic::readSettings(documentOf(good));
	EXPECT_NEAR(settings.rate.y, M_PI / 2, 1e-12);
	EXPECT_NEAR(settings.errors.angularVelocityBias.x, M_PI / 180, 1e-12);
	EXPECT_EQ(settings.markers.size(), 1u);
	const auto clock = makeSteppedClock(0);
	const auto truth = folder.write("truth.toml", "[synthetic]\ntruth = \"/nowhere/truth.csv\"\n");
	expectComplaint(complaint([&] { makeDriver("synthetic", {.clock = *clock, .configuration = documentOf(truth)})->openTracker(); }),
					{"/nowhere/truth.csv"});
	const auto motion = folder.write("motion.toml", "[synthetic]\nmotion = \"file\"\nmotion_file = \"none.csv\"\n");
	expectComplaint(complaint([&] { makeDriver("synthetic", {.clock = *clock, .configuration = documentOf(motion)}); }),
					{"motion.toml:3: synthetic.motion_file = 'none.csv'", (folder.path() / "none.csv").c_str()});
}

TEST(DamagedInput, ReplaySettings)
{
	const TemporaryFolder folder;
	const auto clock = makeSteppedClock(0);
	const auto message = [&](const char *content) {
		const auto file = folder.write("config.toml", content);
		return complaint([&] { makeDriver("replay", {.clock = *clock, .configuration = documentOf(file)}); });
	};
	expectComplaint(message("[synthetic]\n"), {"config.toml", "replay"});
	expectComplaint(message("[replay]\n"), {"config.toml:1", "replay.recording is missing"});
	expectComplaint(message("[replay]\nrecording = \"nowhere\"\n"), {"config.toml:2", "nowhere", "EuRoC"});
	expectComplaint(complaint([&] { makeDriver("replay", {.clock = *clock}); }), {"configuration: replay.recording is missing"});
	expectComplaint(message("[replay]\nrecording = \"config.toml\"\nspeed = 2\n"), {"unknown key replay.speed"});
	expectComplaint(message("[replay]\nrecording = \"config.toml\"\n"), {"config.toml", "expected"});
}
