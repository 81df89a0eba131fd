// Reads a Rig file. calib/rigs/arift.toml explains every key.
#include "runtime/optics/lens_tables.h"
#include "runtime/optics/rig_cameras.h"

namespace arift
{

namespace
{

void readVersion(TomlTable &root)
{
	if (root.integer("version", 0, 1'000'000) != Rig::fileVersion)
		root.complain("version", fmt::format("{}, the version that this program reads", Rig::fileVersion));
}

PanelGeometry readPanel(TomlTable &table)
{
	PanelGeometry panel;
	panel.width = uint32_t(table.integer("width", 16, 16384, panel.width));
	panel.height = uint32_t(table.integer("height", 16, 16384, panel.height));
	panel.widthMetres = table.number("width_metres", 0.02, 1, panel.widthMetres);
	panel.heightMetres = table.number("height_metres", 0.02, 1, panel.heightMetres);
	panel.lensSeparation = table.number("lens_separation", 0.01, panel.widthMetres, panel.lensSeparation);
	return panel;
}

PanelTiming readTiming(TomlTable &table)
{
	PanelTiming timing;
	timing.refreshRate = table.number("refresh_rate", 10, 1000, timing.refreshRate);
	const auto microseconds = [&](const char *key, XrDuration otherwise) {
		return fromSeconds(table.number(key, 0, 100'000, double(otherwise) * 1e-3) * 1e-6);
	};
	timing.vblankToFirstLine = microseconds("vblank_to_first_line_us", timing.vblankToFirstLine);
	timing.lineTime = microseconds("line_time_us", timing.lineTime);
	timing.settling = microseconds("settling_us", timing.settling);
	return timing;
}

LensModel readLens(TomlTable table, const PanelGeometry &panel)
{
	const size_t model = table.choice("model", {"spline", "polynomial"}, 0);
	if (model == 0) {
		// Beyond its tables the distortion is unknown, and holding the nearest would not fit the field of view.
		const double nearest = dk1::splineTables.front().eyeRelief, furthest = dk1::splineTables.back().eyeRelief;
		const SplineLens lens{table.number("eye_relief", nearest, furthest, SplineLens{}.eyeRelief)};
		table.finish();
		return LensModel(lens, panel);
	}
	PolynomialLens lens;
	if (table.has("k")) {
		const std::vector<double> k = table.numbers("k", 4);
		std::copy(k.begin(), k.end(), lens.k.begin());
	}
	table.finish();
	try {
		return LensModel(lens, panel);
	} catch (const InputError &error) {
		table.complain(table.has("k") ? "k" : "model", fmt::format("a lens ({})", error.what()));
	}
}

SensorCalibration readSensor(TomlTable table)
{
	SensorCalibration sensor;
	if (table.has("bias")) {
		const std::vector<double> bias = table.numbers("bias", 3);
		sensor.bias = {bias[0], bias[1], bias[2]};
	}
	if (table.has("matrix")) {
		const std::vector<double> rows = table.numbers("matrix", 9);
		for (int row = 0; row < 3; ++row)
			for (int column = 0; column < 3; ++column) sensor.matrix[column][row] = rows[size_t(3 * row + column)];
		if (!(std::abs(glm::determinant(sensor.matrix)) > 0.1))
			table.complain("matrix", "nine numbers, row by row, of a matrix that can be inverted");
	}
	table.finish();
	return sensor;
}

ImuCalibration readImu(TomlTable table)
{
	ImuCalibration imu;
	imu.imuInHead = readOrientation(table, "orientation");
	imu.gyroscope = readSensor(table.table("gyroscope"));
	imu.accelerometer = readSensor(table.table("accelerometer"));
	table.finish();
	return imu;
}

std::vector<RigCamera> readCameras(TomlTable &root, const std::filesystem::path &file)
{
	std::vector<TomlTable> tables = root.tables("cameras");
	if (!tables.empty() && tables.size() != 2) root.complain("cameras", "two [[cameras]], left and right, or none");
	std::vector<RigCamera> cameras;
	for (TomlTable &table : tables) cameras.push_back(readRigCamera(table, file));
	return cameras;
}

} // namespace

Rig readRig(const std::filesystem::path &file)
{
	const toml::table parsed = parseTomlFile(file);
	TomlTable root(parsed, file.string(), "");
	readVersion(root);
	Rig rig;
	rig.name = root.text("name");
	TomlTable panel = root.table("panel");
	const PanelGeometry geometry = readPanel(panel);
	rig.timing = readTiming(panel);
	panel.finish();
	rig.lens = readLens(root.table("lens"), geometry);
	rig.interpupillaryDistance = root.number("interpupillary_distance", 0.04, 0.09, rig.interpupillaryDistance);
	const float half = float(rig.interpupillaryDistance / 2);
	rig.eyeInHead = {XrPosef{identityOrientation, {-half, 0, 0}}, XrPosef{identityOrientation, {half, 0, 0}}};
	if (root.has("pivot")) rig.pivotInHead = readPosition(root, "pivot", 0.5);
	rig.imu = readImu(root.table("imu"));
	rig.cameras = readCameras(root, file);
	root.finish();
	return rig;
}

} // namespace arift
