#include "tests/gpu/reference/reference_camera.h"
#include <cmath>
#include <stdexcept>
#include <toml++/toml.h>

namespace arift::reference
{
namespace
{

double horner(const std::vector<double> &coefficients, double x)
{
	double sum = 0;
	for (size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
	return sum;
}

/// Where `f`, negative at `low` and rising through zero before `high`, is zero.
template <typename Function> double crossing(double low, double high, Function f)
{
	for (int i = 0; i < 55; ++i) {
		const double middle = (low + high) / 2;
		(f(middle) < 0 ? low : high) = middle;
	}
	return (low + high) / 2;
}

constexpr double widest = 89 * M_PI / 180;

std::vector<double> list(const toml::table &table, const char *key)
{
	std::vector<double> numbers;
	if (const toml::array *array = table[key].as_array())
		for (const toml::node &node : *array) numbers.push_back(node.value<double>().value());
	return numbers;
}

Camera readCamera(const toml::table &table)
{
	Camera camera;
	const auto size = list(table, "size"), centre = list(table, "centre"), affine = list(table, "affine");
	if (size.size() != 2 || centre.size() != 2 || affine.size() != 3 || table["model"].value_or(std::string()) != "ocam")
		throw std::runtime_error("the reference knows OCam cameras with size, centre and affine only");
	camera.width = int(size[0]);
	camera.height = int(size[1]);
	camera.centreRow = centre[0];
	camera.centreColumn = centre[1];
	camera.c = affine[0];
	camera.d = affine[1];
	camera.e = affine[2];
	camera.direct = list(table, "direct");
	camera.inverse = list(table, "inverse");
	return camera;
}

} // namespace

std::optional<double> Camera::radius(double angle) const
{
	if (direct.empty()) return horner(inverse, angle - M_PI / 2);
	// The smallest radius whose ray is as far off the axis as this one: outwards in steps, then halving.
	const auto before = [&](double r) { return std::atan2(r, -horner(direct, r)) - angle; };
	const double limit = 2.0 * std::hypot(width, height), step = limit / 64;
	double high = step;
	while (before(high) < 0)
		if ((high += step) > limit) return std::nullopt;
	return crossing(high - step, high, before);
}

double Camera::angle(double radius) const
{
	if (!direct.empty()) return std::atan2(radius, -horner(direct, radius));
	return crossing(0, widest, [&](double angle) { return horner(inverse, angle - M_PI / 2) - radius; });
}

std::optional<Eigen::Vector2d> Camera::see(const Eigen::Vector3d &direction) const
{
	// OCamCalib: x down the rows, y along the columns, z towards the viewer's back: OpenXR's (-y, x, z).
	const double x = -direction.y(), y = direction.x(), n = std::hypot(x, y), off = std::atan2(n, -direction.z());
	if (off > widest) return std::nullopt;
	if (n == 0) return Eigen::Vector2d(centreColumn, centreRow);
	const auto rho = radius(off);
	if (!rho) return std::nullopt;
	const double u = x / n * *rho, v = y / n * *rho;
	return Eigen::Vector2d(e * u + v + centreColumn, c * u + d * v + centreRow);
}

Eigen::Vector3d Camera::look(const Eigen::Vector2d &texel) const
{
	const double column = texel.x() - centreColumn, row = texel.y() - centreRow;
	const double determinant = c - d * e;
	const double u = (row - d * column) / determinant, v = (c * column - e * row) / determinant;
	const double rho = std::hypot(u, v);
	if (rho == 0) return {0, 0, -1};
	const double off = angle(rho);
	return {std::sin(off) * v / rho, std::sin(off) * -u / rho, -std::cos(off)};
}

RigNumbers readRigNumbers(const std::filesystem::path &file)
{
	const toml::table rig = toml::parse_file(file.string());
	RigNumbers numbers;
	numbers.spline = rig["lens"]["model"].value_or(std::string()) == "spline";
	numbers.eyeRelief = rig["lens"]["eye_relief"].value_or(0.010);
	const toml::array *cameras = rig["cameras"].as_array();
	if (!cameras || cameras->size() != 2) throw std::runtime_error("the reference wants a rig with two cameras");
	for (size_t i = 0; i < 2; ++i) numbers.cameras[i] = readCamera(*cameras->get(i)->as_table());
	return numbers;
}

} // namespace arift::reference
