#include "runtime/optics/euroc_rig.h"
#include "runtime/base/error.h"
#include "runtime/base/euroc_folder.h"
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <sstream>
#include <yaml-cpp/yaml.h>

namespace arift
{

namespace
{

/// One sensor.yaml.
class SensorFile
{
public:
	explicit SensorFile(std::filesystem::path file) : file_(std::move(file)), root_(parse(file_)) {}

	std::string text(const char *key) const { return scalar<std::string>(at(root_, key), key, "a text"); }

	std::vector<double> numbers(const char *key, size_t size) const { return numbers(root_, key, size); }

	/// T_BS: the sensor in the body frame.
	glm::dmat4 sensorInBody() const
	{
		const YAML::Node pose = at(root_, "T_BS");
		const std::vector<double> rows = numbers(pose, "data", 16);
		glm::dmat4 matrix;
		for (int row = 0; row < 4; ++row)
			for (int column = 0; column < 4; ++column) matrix[column][row] = rows[size_t(4 * row + column)];
		const glm::dmat3 rotation(matrix), product = glm::transpose(rotation) * rotation;
		double error = std::abs(glm::determinant(rotation) - 1);
		for (int i = 0; i < 9; ++i) error = std::max(error, std::abs(product[i / 3][i % 3] - (i / 3 == i % 3)));
		if (!(error < 1e-3)) complain(pose["data"], "T_BS.data is no rotation and translation", "an orthonormal rotation within 0.001");
		return matrix;
	}

	[[noreturn]] void complain(const YAML::Node &node, std::string_view found, std::string_view expected) const
	{
		throw InputError("{}:{}: {}, expected {}", file_.string(), node.IsDefined() ? node.Mark().line + 1 : 1, found, expected);
	}
	YAML::Node at(const char *key) const { return at(root_, key); }

private:
	static YAML::Node parse(const std::filesystem::path &file)
	{
		if (!std::filesystem::is_regular_file(file))
			throw InputError("{}: no such file, expected the calibration of a EuRoC recording", file.string());
		std::ifstream stream(file);
		std::ostringstream text;
		text << stream.rdbuf();
		std::string content = std::move(text).str();
		// OpenCV's way of writing the directive is not YAML's; a comment in its place keeps the lines' numbers.
		if (content.starts_with("%YAML")) content[0] = '#';
		try {
			YAML::Node root = YAML::Load(content);
			if (!root.IsMap()) throw InputError("{}:1: expected keys and values", file.string());
			return root;
		} catch (const YAML::ParserException &error) {
			throw InputError("{}:{}: {}, expected YAML", file.string(), error.mark.line + 1, error.msg);
		}
	}

	YAML::Node at(const YAML::Node &map, const char *key) const
	{
		if (!map.IsMap()) complain(map, "a plain value", fmt::format("a map with {}", key));
		YAML::Node node = map[key];
		if (!node.IsDefined()) complain(map, fmt::format("{} is missing", key), "it");
		return node;
	}

	template <typename T> T scalar(const YAML::Node &node, const char *key, const char *expected) const
	{
		try {
			return node.as<T>();
		} catch (const YAML::Exception &) {
			complain(node, fmt::format("{} = {}", key, node.IsScalar() ? node.Scalar() : "(a list or map)"), expected);
		}
	}

	std::vector<double> numbers(const YAML::Node &map, const char *key, size_t size) const
	{
		const YAML::Node node = at(map, key);
		const std::string expected = fmt::format("{} numbers", size);
		if (!node.IsSequence()) complain(node, fmt::format("{} is no list", key), expected);
		if (node.size() != size) complain(node, fmt::format("{} has {} entries", key, node.size()), expected);
		std::vector<double> values;
		for (const YAML::Node &element : node) {
			values.push_back(scalar<double>(element, key, "a number"));
			if (!std::isfinite(values.back())) complain(element, fmt::format("{} = {}", key, values.back()), "a finite number");
		}
		return values;
	}

	std::filesystem::path file_;
	YAML::Node root_;
};

CameraParameters parametersOf(const SensorFile &file)
{
	const std::vector<double> f = file.numbers("intrinsics", 4), k = file.numbers("distortion_coefficients", 4);
	const std::string model = file.text("distortion_model");
	const std::array<double, 4> distortion{k[0], k[1], k[2], k[3]};
	if (model == "radial-tangential" || model == "radtan") return RadTan{f[0], f[1], f[2], f[3], distortion};
	if (model == "equidistant") return KannalaBrandt{f[0], f[1], f[2], f[3], distortion};
	file.complain(file.at("distortion_model"), fmt::format("distortion_model = {}", model), "radial-tangential or equidistant");
}

CameraModel modelOf(const SensorFile &file)
{
	if (const std::string model = file.text("camera_model"); model != "pinhole")
		file.complain(file.at("camera_model"), fmt::format("camera_model = {}", model), "pinhole");
	const std::vector<double> size = file.numbers("resolution", 2);
	for (const double pixels : size)
		if (pixels != std::floor(pixels) || pixels < 1 || pixels > 16384)
			file.complain(file.at("resolution"), fmt::format("resolution [{}, {}]", size[0], size[1]), "width and height in pixels");
	try {
		return CameraModel(uint32_t(size[0]), uint32_t(size[1]), parametersOf(file));
	} catch (const InputError &error) {
		// what the parameters' own reading says already has its place
		if (std::string_view(error.what()).find("sensor.yaml:") != std::string_view::npos) throw;
		file.complain(file.at("intrinsics"), error.what(), "the numbers of a camera");
	}
}

struct Placed {
	glm::dquat orientation;
	glm::dvec3 position;
};

/// From CV camera axes to OpenXR's: half a turn about x.
Placed cameraInBody(const SensorFile &file)
{
	const glm::dmat4 pose = file.sensorInBody();
	return {glm::normalize(glm::quat_cast(glm::dmat3(pose)) * glm::dquat(0, 1, 0, 0)), glm::dvec3(pose[3])};
}

XrPosef relative(const Placed &head, const Placed &thing)
{
	const glm::dquat bodyInHead = glm::conjugate(head.orientation);
	return {toXr(glm::normalize(bodyInHead * thing.orientation)), toXr(bodyInHead * (thing.position - head.position))};
}

} // namespace

Rig rigFromEuroc(const std::filesystem::path &recording)
{
	const EurocFolder folder = findEuroc(recording);
	std::vector<SensorFile> files{SensorFile(folder.sensors / "cam0" / "sensor.yaml")};
	if (folder.isStereo) files.emplace_back(folder.sensors / "cam1" / "sensor.yaml");
	const SensorFile imu(folder.sensors / "imu0" / "sensor.yaml");
	const Placed left = cameraInBody(files.front()), right = cameraInBody(files.back());
	const Placed head{glm::normalize(glm::slerp(left.orientation, right.orientation, 0.5)), (left.position + right.position) / 2.0};
	Rig rig;
	rig.name = fmt::format("EuRoC recording {}", folder.name);
	const float half = float(rig.interpupillaryDistance / 2);
	rig.eyeInHead = {XrPosef{identityOrientation, {-half, 0, 0}}, XrPosef{identityOrientation, {half, 0, 0}}};
	for (const SensorFile &file : files)
		rig.cameras.push_back({.model = modelOf(file), .cameraInHead = relative(head, cameraInBody(file))});
	const glm::dmat4 imuPose = imu.sensorInBody();
	rig.imu.imuInHead = toXr(glm::normalize(glm::conjugate(head.orientation) * glm::quat_cast(glm::dmat3(imuPose))));
	return rig;
}

} // namespace arift
