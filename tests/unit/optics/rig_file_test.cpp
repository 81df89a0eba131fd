// The shipped rig says what the original ARift was, and damaged rig files are refused with file and line.
#include "runtime/base/error.h"
#include "runtime/device/camera.h"
#include "runtime/optics/rig.h"
#include "tests/unit/optics/scratch.h"
#include <glm/geometric.hpp>

namespace arift
{
namespace
{

const std::filesystem::path shipped = std::filesystem::path(ARIFT_SOURCE_DIR) / "calib/rigs/arift.toml";

class Environment
{
public:
	Environment(const char *name, const std::string &value) : name_(name)
	{
		if (const char *old = std::getenv(name)) old_ = old;
		setenv(name, value.c_str(), 1);
	}
	Environment(const Environment &) = delete;
	Environment &operator=(const Environment &) = delete;
	~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }

private:
	const char *name_;
	std::optional<std::string> old_;
};

TEST(ShippedRig, IsTheOriginalHeadset)
{
	const Rig rig = readRig(shipped);
	EXPECT_EQ(rig.cameras.size(), 2u);
	for (const RigCamera &camera : rig.cameras) {
		EXPECT_EQ(camera.model.width(), 752u);
		EXPECT_EQ(camera.model.height(), 480u);
		EXPECT_EQ(camera.timeOffset, 0);
		EXPECT_EQ(camera.bayer, -1);
		EXPECT_TRUE(isValidPose(camera.cameraInHead));
	}
	EXPECT_NEAR(length(rig.cameras[1].cameraInHead.position - rig.cameras[0].cameraInHead.position), 0.065, 1e-6);
	EXPECT_LT(rig.cameras[0].cameraInHead.position.x, 0);
	EXPECT_LT(rig.cameras[0].cameraInHead.position.z, 0);
	EXPECT_FLOAT_EQ(rig.eyeInHead[0].position.x, -0.032f);
	EXPECT_FLOAT_EQ(rig.eyeInHead[1].position.x, 0.032f);
	EXPECT_FLOAT_EQ(rig.pivotInHead.y, -0.075f);
	EXPECT_FLOAT_EQ(rig.pivotInHead.z, 0.0805f);
	EXPECT_NEAR(rig.lens.fov(Eye::left).up, 2.13826, 1e-5);
	EXPECT_EQ(rig.timing.vblankToFirstLine, 182'260);
	EXPECT_EQ(rig.timing.lineTime, 20'250);
	EXPECT_EQ(rig.timing.settling, 16'800'000);
	EXPECT_EQ(rig.timing.lineDelay(400), 182'260 + 8'100'000 + 16'800'000);
	EXPECT_NEAR(angleBetween(rig.imu.imuInHead, identityOrientation), 0, 1e-6);
}

/// The right camera hangs upside down. Its published calibration speaks of the image turned by the original program, which shifted it by a
/// pixel; the rig's speaks of the camera's own image and has the half turn in the pose. Published direction -> column, row.
TEST(ShippedRig, RightCameraIsUpsideDown)
{
	const RigCamera right = readRig(shipped).cameras[1];
	const struct {
		glm::dvec3 direction;
		double column, row;
	} published[] = {
		{{0.1, 0, 1}, 436.0269, 236.6486},
		{{0, 0.1, 1}, 394.1344, 278.5395},
		{{-0.5, 0.25, 1}, 202.4578, 332.4770},
		{{1, 0.3, 1}, 720.6696, 334.6319},
	};
	for (const auto &[direction, column, row] : published) {
		const XrVector3f inHead = xrFromCv(toXr(direction));
		const XrVector3f inCamera = cvFromXr(rotate(inverse(right.cameraInHead.orientation), inHead));
		const glm::dvec2 raw = right.model.project(toGlm(inCamera)).value();
		EXPECT_NEAR(raw.x, 751 - (column - 1), 1e-3);
		EXPECT_NEAR(raw.y, 479 - row, 1e-3);
	}
}

TEST(ShippedRig, LeftCameraIsUpright)
{
	const RigCamera left = readRig(shipped).cameras[0];
	EXPECT_NEAR(angleBetween(left.cameraInHead.orientation, identityOrientation), 0, 1e-6);
	const glm::dvec2 pixel = left.model.project({-0.5, 0.25, 1}).value();
	EXPECT_NEAR(pixel.x, 162.0234, 1e-3);
	EXPECT_NEAR(pixel.y, 308.2888, 1e-3);
}

TEST(RigFile, EveryCameraModelAndOptionalKey)
{
	const tests::TemporaryFolder scratch;
	scratch.write("left.txt",
				  "5 -206.517 0 2.207161e-3 -4.879622e-6 1.865656e-8\n"
				  "12 294.18226 152.28957 -12.191217 27.959546 8.241525 -1.970397 10.689256 1.871609 -6.437684 0.430037 3.215544 0.921484\n"
				  "241.8 394.5\n1 0 0\n480 752\n");
	const std::string head = "version = 1\nname = \"test\"\n";
	const auto camera = [](const std::string &keys) { return "[[cameras]]\nposition = [0.1, 0.2, -0.3]\n" + keys + "\n"; };
	const std::string pinhole = "size = [640, 480]\nfocal = [400, 401]\ncentre = [320, 240]\n";
	const Rig first = readRig(scratch.write(
		"first.toml", head + camera("model = \"ocam\"\nfile = \"left.txt\"\ntime_offset_ms = -2.5\nbayer = \"grbg\"") +
						  camera("model = \"kannala_brandt\"\n" + pinhole + "distortion = [0.01, 0, 0, 0]\nmax_angle_degrees = 30")));
	EXPECT_STREQ(first.cameras[0].model.name(), "ocam");
	EXPECT_EQ(first.cameras[0].timeOffset, -2'500'000);
	EXPECT_EQ(first.cameras[0].bayer, int32_t(PixelFormat::bayerGrbg8));
	EXPECT_FLOAT_EQ(first.cameras[0].cameraInHead.position.z, -0.3f);
	EXPECT_STREQ(first.cameras[1].model.name(), "kannala_brandt");
	EXPECT_NEAR(first.cameras[1].model.maxAngle(), 0.5236, 1e-4);
	const Rig second = readRig(scratch.write(
		"second.toml", head + "[lens]\nmodel = \"polynomial\"\nk = [1.0, 0.18, 0.115, 0.0]\n[imu.gyroscope]\nbias = [0.1, 0.2, 0.3]\n" +
						   "matrix = [1, 0.5, 0, 0, 1, 0, 0, 0, 2]\n" + camera("model = \"mei\"\nxi = 1\n" + pinhole) +
						   camera("model = \"double_sphere\"\nxi = -0.2\nalpha = 0.6\n" + pinhole)));
	EXPECT_STREQ(second.cameras[0].model.name(), "mei");
	EXPECT_STREQ(second.cameras[1].model.name(), "double_sphere");
	EXPECT_EQ(second.imu.gyroscope.matrix * glm::dvec3(0, 1, 0), glm::dvec3(0.5, 1, 0));
	EXPECT_EQ(second.imu.gyroscope.bias.z, 0.3);
	const double r2 = std::pow(1 * 0.041 / 0.03744, 2);
	EXPECT_NEAR(second.lens.scale(1), 1 + 0.18 * r2 + 0.115 * r2 * r2, 1e-12);
	const Rig third = readRig(scratch.write("third.toml", head));
	EXPECT_TRUE(third.cameras.empty());
}

TEST(RigFile, DamagedFilesAreRefusedWithFileAndLine)
{
	const struct {
		const char *from, *to, *expected;
	} table[] = {
		{"version = 1", "version = 2", "version = 2, expected 1"},
		{"version = 1", "version = \"1\"", "expected a whole number"},
		{"name = \"ARift", "name = 5 # \"ARift", "name = 5, expected a text"},
		{"interpupillary_distance = 0.064", "interpupillary_distance = 64", "interpupillary_distance = 64, expected a number from 0.04"},
		{"interpupillary_distance", "inter_pupillary_distance", "unknown key inter_pupillary_distance"},
		{"pivot = [0.0, -0.075, 0.0805]", "pivot = [0.0, -0.075]", "expected an array of 3 numbers"},
		{"pivot = [0.0, -0.075, 0.0805]", "pivot = [0.0, -75.0, 80.5]", "each within 0.5"},
		{"width = 1280", "width = 1280.5", "panel.width = 1280.5, expected a whole number"},
		{"height = 800", "height = -800", "panel.height = -800"},
		{"width_metres = 0.14976", "width_metres = 149.76", "expected a number from 0.02 to 1"},
		{"lens_separation = 0.0635", "lens_separation = 0.2", "panel.lens_separation = 0.2"},
		{"refresh_rate = 59.91", "refresh_rate = 0", "panel.refresh_rate = 0"},
		{"line_time_us = 20.25", "line_time_us = \"fast\"", "panel.line_time_us"},
		{"settling_us = 16800.0", "settle_us = 16800.0", "unknown key panel.settle_us"},
		{"model = \"spline\"", "model = \"spleen\"", "lens.model = 'spleen', expected one of \"spline\", \"polynomial\""},
		{"eye_relief = 0.010", "eye_relief = 10", "lens.eye_relief = 10, expected a number from 0.007760465 to 0.017760465"},
		{"eye_relief = 0.010", "eye_relief = 0.006", "lens.eye_relief = 0.006"},
		{"eye_relief = 0.010", "eye_relief = 0.018", "lens.eye_relief = 0.018"},
		{"model = \"spline\"\neye_relief = 0.010", "model = \"polynomial\"\nk = [1, -1, 0, 0]", "lens polynomial does not rise"},
		{"model = \"spline\"\neye_relief = 0.010", "model = \"polynomial\"\nk = [1, 0]", "lens.k = [ 1, 0 ], expected an array of 4"},
		{"orientation = [0.0, 0.0, 0.0, 1.0]\n[imu", "orientation = [0.0, 0.0, 0.0, 2.0]\n[imu", "imu.orientation"},
		{"bias = [0.0, 0.0, 0.0]", "bias = [0.0, inf, 0.0]", "imu.gyroscope.bias"},
		{"matrix = [1.0, 0.0, 0.0, 0.0, 1.0,", "matrix = [1.0, 0.0, 0.0, 0.0, 0.0,", "matrix that can be inverted"},
		{"model = \"ocam\"", "model = \"fisheye\"", "cameras[0].model = 'fisheye', expected one of \"ocam\", \"kannala_brandt\""},
		{"size = [752, 480]", "size = [752.5, 480]", "cameras[0].size"},
		{"size = [752, 480]", "size = [480, 752, 3]", "cameras[0].size"},
		{"1329.80078899012", "1429.80078899012", "96 px on the axis, expected less than 0.1"},
		{"inverse = [1329.80078899012", "inverse = [\"a\"", "cameras[0].inverse"},
		{"centre = [211.9393300155207, 354.6241749915297]", "centre = [511.9, 354.6]", "centre at column 354.6, row 511.9"},
		{"affine = [1.000374008613590", "affine = [1.5", "affine c = 1.5"},
		{"position = [-0.0325, 0.0, -0.060]", "position = [-32.5, 0.0, -60.0]", "cameras[0].position"},
		{"orientation = [0.0, 0.0, 1.0, 0.0]", "orientation = [0.0, 0.0, 180.0, 0.0]", "cameras[1].orientation"},
		{"affine = [1.000052", "file = \"nowhere.txt\"\naffine = [1.000052",
		 "cameras[1].file = 'nowhere.txt', expected an OCamCalib calibration, and"},
		{"position = [-0.0325, 0.0, -0.060]\n", "", "cameras[0].position is missing"},
		{"affine = [1.000052", "time_offset_ms = 5000\naffine = [1.000052", "cameras[1].time_offset_ms = 5000"},
		{"affine = [1.000052", "bayer = \"rgb\"\naffine = [1.000052", "cameras[1].bayer = 'rgb', expected one of \"rggb\""},
		{"affine = [1.000052", "max_angle_degrees = 200\naffine = [1.000052", "cameras[1].max_angle_degrees = 200"},
		{"affine = [1.000052", "skew = 0\naffine = [1.000052", "unknown key cameras[1].skew"},
		{"version = 1", "version = = 1", ""},
		{"[panel]", "[.panel]", "expected bare key"},
		{"[panel]", "[panel", ""},
	};
	const tests::TemporaryFolder scratch;
	const std::string good = tests::readAll(shipped);
	for (const auto &row : table) {
		const tests::Damaged damaged = tests::damage(good, row.from, row.to);
		const std::string file = scratch.write("bad.toml", damaged.text).string();
		try {
			readRig(file);
			ADD_FAILURE() << "accepted " << row.to << ", expected: " << row.expected;
		} catch (const InputError &error) {
			const std::string message = error.what();
			EXPECT_NE(message.find(row.expected), std::string::npos) << message << " | expected: " << row.expected;
			// A camera whose numbers do not fit together is complained about at its `model`, a missing key at its table's head: a few lines
			// before.
			int line = 0;
			if (message.rfind(file + ":", 0) == 0) line = std::atoi(message.c_str() + file.size() + 1);
			EXPECT_LE(line, damaged.line + 1) << message;
			EXPECT_GE(line, damaged.line - 10) << message;
		}
	}
}

TEST(RigFile, OneCameraIsRefused)
{
	const tests::TemporaryFolder scratch;
	const std::string good = tests::readAll(shipped);
	const std::string file = scratch.write("one.toml", good.substr(0, good.rfind("[[cameras]]"))).string();
	try {
		readRig(file);
		FAIL();
	} catch (const InputError &error) {
		EXPECT_NE(std::string(error.what()).find("left and right, or none"), std::string::npos) << error.what();
	}
}

TEST(RigPlaces, TheUsersThenWhatIsShipped)
{
	const tests::TemporaryFolder scratch;
	const Environment config("XDG_CONFIG_HOME", scratch.path().string());
	const auto places = rigPlaces(defaultRig);
	EXPECT_EQ(places[0], scratch.path() / "arift/rigs/arift.toml");
	EXPECT_EQ(places[1].filename(), "arift.toml");
	EXPECT_TRUE(std::filesystem::equivalent(places[2], shipped));
	const Environment ignored("XDG_CONFIG_HOME", "relative"), home("HOME", "/somewhere");
	EXPECT_EQ(rigPlaces("mine")[0], "/somewhere/.config/arift/rigs/mine.toml");
}

TEST(RigPlaces, NamesAreNoPaths)
{
	EXPECT_FALSE(isRigPath("arift"));
	EXPECT_FALSE(isRigPath(""));
	EXPECT_TRUE(isRigPath("mine.toml"));
	EXPECT_TRUE(isRigPath("rigs/mine"));
}

} // namespace
} // namespace arift
