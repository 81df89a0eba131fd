// OCamCalib's calib_results.txt: read as it is written, and refused with file and line where it is damaged.
#include "runtime/base/error.h"
#include "runtime/optics/camera_model.h"
#include "tests/common/shared_data.h"
#include "tests/unit/optics/scratch.h"
#include <glm/geometric.hpp>

namespace arift
{
namespace
{

const std::string good = R"(#polynomial coefficients for the DIRECT mapping function (ocam_model.ss in MATLAB).These are used by cam2world

5 -2.065170e+02 0.000000e+00 2.207161e-03 -4.879622e-06 1.865656e-08 


#polynomial coefficients for the inverse mapping function (ocam_model.invpol in MATLAB). These are used by world2cam

12 294.182260 152.289570 -12.191217 27.959546 8.241525 -1.970397 10.689256 1.871609 -6.437684 0.430037 3.215544 0.921484 


#center: "row" and "column", starting from 0 (C convention)

241.800066 394.552874

#affine parameters "c", "d", "e"

1.000330 0.000219 0.000257

#image size: "height" and "width"

480 752

)";

TEST(OCamFile, IsReadInItsOwnOrder)
{
	const tests::TemporaryFolder scratch;
	const CameraModel camera = readOCamFile(scratch.write("calib_results.txt", good).string());
	EXPECT_EQ(camera.width(), 752u);
	EXPECT_EQ(camera.height(), 480u);
	const OCam &ocam = std::get<OCam>(camera.parameters());
	EXPECT_EQ(ocam.direct, (std::vector<double>{-206.5170, 0, 2.207161e-3, -4.879622e-6, 1.865656e-8}));
	EXPECT_EQ(ocam.inverse.size(), 12u);
	EXPECT_EQ(ocam.inverse[11], 0.921484);
	EXPECT_EQ(ocam.centreRow, 241.800066);
	EXPECT_EQ(ocam.centreColumn, 394.552874);
	EXPECT_EQ(ocam.c, 1.000330);
	EXPECT_EQ(ocam.d, 0.000219);
	EXPECT_EQ(ocam.e, 0.000257);
}

TEST(OCamFile, LineEndsAndCommentsDoNotMatter)
{
	const tests::TemporaryFolder scratch;
	std::string text = "# another program's header\n\n";
	for (const char letter : good) text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
	const CameraModel camera = readOCamFile(scratch.write("dos.txt", text).string());
	EXPECT_EQ(std::get<OCam>(camera.parameters()).e, 0.000257);
}

TEST(OCamFile, WarnsAboutAnInverseThatDisagreesAndUsesTheDirectPolynomial)
{
	if (log::threshold() > log::Level::warning) GTEST_SKIP() << "ARIFT_LOG silences warnings";
	const tests::TemporaryFolder scratch;
	const tests::Damaged off = tests::damage(good, "294.182260", "295.182260");
	testing::internal::CaptureStderr();
	const CameraModel bad = readOCamFile(scratch.write("off.txt", off.text).string());
	const std::string warning = testing::internal::GetCapturedStderr();
	EXPECT_NE(warning.find("off.txt:" + std::to_string(off.line)), std::string::npos) << warning;
	EXPECT_NE(warning.find("expected at most 0.5"), std::string::npos) << warning;
	testing::internal::CaptureStderr();
	const CameraModel right = readOCamFile(scratch.write("right.txt", good).string());
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
	const glm::dvec3 direction(0.7, -0.4, 0.5);
	EXPECT_EQ(bad.project(direction).value(), right.project(direction).value());
}

TEST(OCamFile, DamagedFilesAreRefusedWithFileAndLine)
{
	const struct {
		const char *from, *to, *expected;
	} table[] = {
		{"5 -2.06", "4 -2.06", "direct polynomial has 5 coefficients, expected 4"},
		{"5 -2.06", "6 -2.06", "direct polynomial has 5 coefficients, expected 6"},
		{"5 -2.06", "0 -2.06", "expected its number of coefficients"},
		{"5 -2.06", "2.5 -2.06", "expected its number of coefficients"},
		{"5 -2.06", "-3 -2.06", "expected its number of coefficients"},
		{"-2.065170e+02", "2.065170e+02", "a0 = 206.517, expected a negative number"},
		{"-2.065170e+02", "-2.065170e+02x", "\"-2.065170e+02x\", expected numbers only"},
		{"-2.065170e+02", "nan", "\"nan\", expected numbers only"},
		{"2.207161e-03", "-2.207161e-01", "direct polynomial: the projection is one-to-one only up to"},
		{"-12.191217", "-12,191217", "inverse polynomial contains \"-12,191217\""},
		{"12 294", "13 294", "inverse polynomial has 12 coefficients, expected 13"},
		{"241.800066 394.552874", "241.800066", "centre has 1 numbers, expected 2"},
		{"241.800066 394.552874", "541.800066 394.552874", "centre row = 541.800066, expected inside the image of 480 rows"},
		{"241.800066 394.552874", "241.800066 -394.552874", "centre column = -394.552874, expected inside"},
		{"1.000330", "1.300330", "affine c = 1.30033, expected nearly 1"},
		{"0.000219", "0.219", "affine d = 0.219, expected nearly 0"},
		{"0.000257", "-0.257", "affine e = -0.257, expected nearly 0"},
		{" 0.000257", "", "affine parameters has 2 numbers, expected 3"},
		{"480 752", "480 752.5", "image width = 752.5, expected a whole number"},
		{"480 752", "0 752", "image height = 0, expected a whole number"},
		{"480 752", "480", "image size has 1 numbers, expected 2"},
		{"480 752", "480 752\n7 8 9", ":22: \"7\", expected nothing after the image size"},
		{"480 752", "", "the file ends, expected the image size"},
	};
	const tests::TemporaryFolder scratch;
	for (const auto &row : table) {
		const tests::Damaged damaged = tests::damage(good, row.from, row.to);
		const std::string file = scratch.write("calib_results.txt", damaged.text).string();
		try {
			readOCamFile(file);
			ADD_FAILURE() << "accepted " << row.to << ", expected: " << row.expected;
		} catch (const InputError &error) {
			const std::string message = error.what();
			EXPECT_NE(message.find(row.expected), std::string::npos) << message << " | expected: " << row.expected;
			const bool elsewhere = std::string(row.expected).starts_with(':') || std::string(row.expected).starts_with("the file ends");
			const std::string place = file + ":" + (elsewhere ? "" : std::to_string(damaged.line) + ":");
			EXPECT_EQ(message.rfind(place, 0), 0u) << message << " | expected to start with: " << place;
		}
	}
}

TEST(OCamFile, MissingFileIsNamed)
{
	try {
		readOCamFile("/nowhere/calib_results.txt");
		FAIL();
	} catch (const InputError &error) {
		EXPECT_NE(std::string(error.what()).find("/nowhere/calib_results.txt: no such file"), std::string::npos) << error.what();
	}
}

TEST(OCamFile, EveryRealFileIsReadAndGoesThereAndBack)
{
	const auto folder = test::sharedData("ocam");
	if (!folder) GTEST_SKIP() << test::noSharedData;
	int files = 0;
	for (const auto &entry : std::filesystem::directory_iterator(*folder)) {
		if (entry.path().extension() != ".txt") continue;
		const CameraModel camera = readOCamFile(entry.path().string());
		double worst = 0;
		for (uint32_t row = 0; row < camera.height(); row += 5)
			for (uint32_t column = 0; column < camera.width(); column += 5)
				if (const auto ray = camera.unproject({column, row}))
					worst = std::max(worst, glm::length(camera.project(*ray).value() - glm::dvec2(column, row)));
		EXPECT_LT(worst, 1e-7) << entry.path();
		++files;
	}
	EXPECT_GT(files, 0);
}

} // namespace
} // namespace arift
