#include "runtime/optics/rig_cameras.h"
#include "runtime/optics/models.h"
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace arift
{

namespace
{

std::array<double, 2> pair(TomlTable &table, const char *key)
{
	const std::vector<double> values = table.numbers(key, 2);
	return {values[0], values[1]};
}

std::array<double, 4> distortion(TomlTable &table)
{
	if (!table.has("distortion")) return {};
	const std::vector<double> values = table.numbers("distortion", 4);
	return {values[0], values[1], values[2], values[3]};
}

OCam readOCam(TomlTable &table)
{
	OCam camera;
	if (table.has("direct")) camera.direct = table.numbers("direct", 0);
	if (table.has("inverse")) camera.inverse = table.numbers("inverse", 0);
	if (camera.direct.empty() && camera.inverse.empty())
		table.complain("direct", "the polynomial z(rho), or `inverse`, rho(theta), or `file`");
	const auto [row, column] = pair(table, "centre");
	camera.centreRow = row;
	camera.centreColumn = column;
	if (table.has("affine")) {
		const std::vector<double> affine = table.numbers("affine", 3);
		camera.c = affine[0];
		camera.d = affine[1];
		camera.e = affine[2];
	}
	return camera;
}

CameraParameters readParameters(TomlTable &table, size_t model)
{
	if (model == 0) return readOCam(table);
	const auto [fx, fy] = pair(table, "focal");
	const auto [cx, cy] = pair(table, "centre");
	switch (model) {
	case 1: return KannalaBrandt{fx, fy, cx, cy, distortion(table)};
	case 2: return Mei{table.number("xi", 0, 100), fx, fy, cx, cy, distortion(table)};
	case 3: return RadTan{fx, fy, cx, cy, distortion(table)};
	default: return DoubleSphere{table.number("xi", -1, 10), table.number("alpha", 0, 1), fx, fy, cx, cy};
	}
}

CameraModel readModel(TomlTable &table, const std::filesystem::path &file)
{
	const size_t model = table.choice("model", {"ocam", "kannala_brandt", "mei", "radtan", "double_sphere"}, 99);
	if (model == 99) table.complain("model", R"("ocam", "kannala_brandt", "mei", "radtan" or "double_sphere")");
	if (model == 0 && table.has("file")) {
		const std::filesystem::path calibration = table.path("file");
		if (!std::filesystem::is_regular_file(calibration))
			table.complain("file", fmt::format("an OCamCalib calibration, and {} is no file", calibration.string()));
		return readOCamFile(calibration.string());
	}
	const std::vector<double> size = table.numbers("size", 2);
	for (const double pixels : size)
		if (pixels != std::floor(pixels) || pixels < 1 || pixels > 16384)
			table.complain("size", "width and height, whole numbers from 1 to 16384");
	CameraParameters parameters = readParameters(table, model);
	const double maxAngle = table.number("max_angle_degrees", 0, 177, 0) * std::numbers::pi / 180;
	try {
		const CameraModel camera{uint32_t(size[0]), uint32_t(size[1]), std::move(parameters), maxAngle};
		models::warnAboutInverse(fmt::format("{}: camera \"{}\"", file.string(), table.text("name", "")), camera);
		return camera;
	} catch (const InputError &error) {
		table.complain("model", fmt::format("the numbers of a camera ({})", error.what()));
	}
}

} // namespace

XrQuaternionf readOrientation(TomlTable &table, const char *key)
{
	if (!table.has(key)) return identityOrientation;
	const std::vector<double> v = table.numbers(key, 4);
	const glm::dquat q(v[3], v[0], v[1], v[2]);
	if (std::abs(glm::length(q) - 1) > 0.01) table.complain(key, "a unit quaternion [x, y, z, w]");
	return toXr(glm::normalize(q));
}

XrVector3f readPosition(TomlTable &table, const char *key, double limit)
{
	const std::vector<double> v = table.numbers(key, 3);
	for (const double coordinate : v)
		if (std::abs(coordinate) > limit) table.complain(key, fmt::format("x, y, z in metres, each within {}", limit));
	return {float(v[0]), float(v[1]), float(v[2])};
}

RigCamera readRigCamera(TomlTable &table, const std::filesystem::path &file)
{
	RigCamera camera{.model = readModel(table, file)};
	table.text("name", "");
	camera.cameraInHead = {readOrientation(table, "orientation"), readPosition(table, "position", 1)};
	camera.timeOffset = fromSeconds(table.number("time_offset_ms", -1000, 1000, 0) * 1e-3);
	// PixelFormat's Bayer orders follow its two grey formats.
	const size_t bayer = table.choice("bayer", {"rggb", "grbg", "gbrg", "bggr"}, 99);
	if (bayer != 99) camera.bayer = int32_t(2 + bayer);
	table.finish();
	return camera;
}

} // namespace arift
