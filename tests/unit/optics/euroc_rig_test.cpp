// A Rig out of a recording's own calibration, upright whatever the recording's body frame was.
#include "runtime/base/error.h"
#include "runtime/optics/euroc_rig.h"
#include "tests/common/shared_data.h"
#include "tests/unit/optics/scratch.h"
#include <glm/geometric.hpp>

namespace arift
{
namespace
{

/// A body frame with x up, y left and z forward; cameras at y = +/- 0.05. Camera axes: x right = -body y, y down = -body x, z = body z.
std::string camera(double y, const char *model = "radial-tangential")
{
	return "%YAML:1.0\n# made for a test\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
		   "  data: [0.0, -1.0, 0.0, 0.01,\n         -1.0, 0.0, 0.0, " +
		   std::to_string(y) +
		   ",\n         0.0, 0.0, -1.0, 0.02,\n         0.0, 0.0, 0.0, 1.0]\n"
		   "rate_hz: 20\nresolution: [752, 480]\ncamera_model: pinhole\n"
		   "intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv\ndistortion_model: " +
		   model + "\ndistortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n";
}

// x up and y left leave z = x cross y = backwards; so forward is -z and the rows above are right-handed.
std::string imu()
{
	return "%YAML:1.0\nsensor_type: imu\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, 0.0,\n         0.0, 1.0, 0.0, 0.0,\n"
		   "         0.0, 0.0, 1.0, 0.0,\n         0.0, 0.0, 0.0, 1.0]\nrate_hz: 200\n";
}

void writeRecording(const tests::TemporaryFolder &scratch)
{
	scratch.write("mav0/cam0/sensor.yaml", camera(0.05));
	scratch.write("mav0/cam1/sensor.yaml", camera(-0.05));
	scratch.write("mav0/imu0/sensor.yaml", imu());
}

void expectNear(const XrVector3f &found, const XrVector3f &expected)
{
	EXPECT_NEAR(found.x, expected.x, 1e-6);
	EXPECT_NEAR(found.y, expected.y, 1e-6);
	EXPECT_NEAR(found.z, expected.z, 1e-6);
}

TEST(EurocRig, PutsTheHeadMidwayBetweenTheCameras)
{
	const tests::TemporaryFolder scratch;
	writeRecording(scratch);
	for (const std::filesystem::path &folder : {scratch.path(), scratch.path() / "mav0"}) {
		const Rig rig = rigFromEuroc(folder);
		ASSERT_EQ(rig.cameras.size(), 2u);
		expectNear(rig.cameras[0].cameraInHead.position, {-0.05f, 0, 0});
		expectNear(rig.cameras[1].cameraInHead.position, {0.05f, 0, 0});
		EXPECT_NEAR(angleBetween(rig.cameras[0].cameraInHead.orientation, identityOrientation), 0, 1e-3);
		// gravity's opposite along the body's x is up in the head; the body's y is left, its z backwards
		expectNear(rotate(rig.imu.imuInHead, {1, 0, 0}), {0, 1, 0});
		expectNear(rotate(rig.imu.imuInHead, {0, 1, 0}), {-1, 0, 0});
		expectNear(rotate(rig.imu.imuInHead, {0, 0, 1}), {0, 0, 1});
		const RadTan &lens = std::get<RadTan>(rig.cameras[0].model.parameters());
		EXPECT_EQ(lens.fx, 458.654);
		EXPECT_EQ(lens.cy, 248.375);
		EXPECT_EQ(lens.k[3], 1.76187114e-05);
		EXPECT_NE(rig.name.find(scratch.path().filename().string()), std::string::npos);
	}
}

TEST(EurocRig, IsFoundWhereverTheRecordingIsPlayedFrom)
{
	const tests::TemporaryFolder scratch;
	writeRecording(scratch);
	const std::string name = scratch.path().filename().string();
	for (const char *end : {"", "/", "/mav0", "/mav0/"})
		EXPECT_EQ(rigFromEuroc(scratch.path().string() + end).name, "EuRoC recording " + name);
	std::filesystem::rename(scratch.path() / "mav0", scratch.path() / "MH_01");
	for (const char *end : {"/MH_01", "/MH_01/"}) EXPECT_EQ(rigFromEuroc(scratch.path().string() + end).name, "EuRoC recording MH_01");
}

TEST(EurocRig, AMonocularRecordingHasOneCameraForBothEyes)
{
	const tests::TemporaryFolder scratch;
	writeRecording(scratch);
	std::filesystem::remove_all(scratch.path() / "mav0/cam1");
	const Rig rig = rigFromEuroc(scratch.path());
	ASSERT_EQ(rig.cameras.size(), 1u);
	expectNear(rig.cameras[0].cameraInHead.position, {0, 0, 0});
	EXPECT_NEAR(angleBetween(rig.cameras[0].cameraInHead.orientation, identityOrientation), 0, 1e-3);
	expectNear(rotate(rig.imu.imuInHead, {1, 0, 0}), {0, 1, 0});
	EXPECT_EQ(rig.cameraFor(0), &rig.cameras[0]);
	EXPECT_EQ(rig.cameraFor(1), &rig.cameras[0]);
	EXPECT_EQ(Rig().cameraFor(1), nullptr);
}

TEST(EurocRig, EquidistantLensesAreKannalaBrandt)
{
	const tests::TemporaryFolder scratch;
	writeRecording(scratch);
	scratch.write("mav0/cam1/sensor.yaml", camera(-0.05, "equidistant"));
	EXPECT_STREQ(rigFromEuroc(scratch.path()).cameras[1].model.name(), "kannala_brandt");
}

TEST(EurocRig, DamagedFilesAreRefusedWithFileAndLine)
{
	const struct {
		const char *file, *from, *to, *expected;
	} table[] = {
		{"cam0", "T_BS:", "T_SB:", "T_BS is missing"},
		{"cam0", "data: [0.0, -1.0, 0.0, 0.01,", "data: [0.0, -1.0, 0.0,", "data has 15 entries, expected 16 numbers"},
		{"cam0", "data: [0.0, -1.0", "data: [0.5, -1.0", "no rotation"},
		{"cam1", "data: [0.0, -1.0, 0.0, 0.01", "data: [0.0, -1.0, 0.0, x.01", "data = x.01, expected a number"},
		{"cam1", "data: [0.0, -1.0, 0.0, 0.01", "data: [0.0, -1.0, 0.0, .nan", "expected a finite number"},
		{"cam1", "resolution: [752, 480]", "resolution: [752]", "resolution has 1 entries, expected 2"},
		{"cam1", "resolution: [752, 480]", "resolution: [752, -480]", "resolution [752, -480]"},
		{"cam0", "resolution: [752, 480]", "resolution: 752", "resolution is no list"},
		{"cam0", "camera_model: pinhole", "camera_model: orange", "camera_model = orange, expected pinhole"},
		{"cam0", "[458.654,", "[-458.654,", "focal lengths -458.654"},
		{"cam0", "367.215,", "1367.215,", "centre at column 1367.215"},
		{"cam1", "distortion_model: radial", "distortion_model: square",
		 "distortion_model = square-tangential, expected radial-tangential"},
		{"cam1", "1.76187114e-05]", "]", "distortion_coefficients"},
		{"cam1", "T_BS:", "T_BS: ]", "expected YAML"},
		{"imu0", "data: [1.0", "data: [2.0", "no rotation"},
		{"imu0", "  data", "  date", "data is missing"},
	};
	for (const auto &row : table) {
		const tests::TemporaryFolder scratch;
		writeRecording(scratch);
		const std::filesystem::path file = std::filesystem::path("mav0") / row.file / "sensor.yaml";
		const tests::Damaged damaged = tests::damage(tests::readAll(scratch.path() / file), row.from, row.to);
		const std::string path = scratch.write(file, damaged.text).string();
		try {
			rigFromEuroc(scratch.path());
			ADD_FAILURE() << "accepted " << row.to;
		} catch (const InputError &error) {
			const std::string message = error.what();
			EXPECT_NE(message.find(row.expected), std::string::npos) << message << " | expected: " << row.expected;
			ASSERT_EQ(message.rfind(path + ":", 0), 0u) << message;
			const int line = std::atoi(message.c_str() + path.size() + 1);
			const bool atTheMap = message.find("missing") != std::string::npos;
			EXPECT_NEAR(line, damaged.line, atTheMap ? 100 : 1) << message;
		}
	}
}

TEST(EurocRig, MissingFilesAreNamed)
{
	for (const char *sensor : {"cam0", "cam1", "imu0"}) {
		const tests::TemporaryFolder scratch;
		writeRecording(scratch);
		const std::filesystem::path file = scratch.path() / "mav0" / sensor / "sensor.yaml";
		std::filesystem::remove(file);
		try {
			rigFromEuroc(scratch.path());
			ADD_FAILURE() << sensor;
		} catch (const InputError &error) {
			EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": no such file", 0), 0u) << error.what();
		}
	}
	EXPECT_THROW(rigFromEuroc("/nowhere"), InputError);
}

TEST(EurocRig, RealRecording)
{
	const auto folder = test::sharedData("micro_euroc");
	if (!folder) GTEST_SKIP() << test::noSharedData;
	const Rig rig = rigFromEuroc(*folder);
	const XrPosef left = rig.cameras[0].cameraInHead, right = rig.cameras[1].cameraInHead;
	EXPECT_NEAR(length(right.position - left.position), 0.110, 0.001);
	expectNear(left.position + right.position, {0, 0, 0});
	EXPECT_GT(right.position.x, 0.054f);
	EXPECT_LT(angleBetween(left.orientation, identityOrientation), 0.01);
	// The body's x axis points up in these recordings: at rest its accelerometer shows +9.8 there.
	EXPECT_GT(rotate(rig.imu.imuInHead, {1, 0, 0}).y, 0.95f);
}

} // namespace
} // namespace arift
