#include "runtime/compositor/panel_optics.h"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace arift
{

namespace
{

double angleBetween(const CameraModel &model, glm::dvec2 a, glm::dvec2 b)
{
	const auto first = model.unproject(a), second = model.unproject(b);
	return first && second ? std::atan2(glm::length(glm::cross(*first, *second)), glm::dot(*first, *second)) : 0;
}

PanelCamera describe(const CameraModel &model)
{
	// The middle of the image's longer edge stands for its border; a lens that does not reach it fades by its angle anyway.
	const double x = model.width() - 1.0, y = (model.height() - 1.0) / 2, step = 8;
	const double atEdge = angleBetween(model, {x, y}, {x - step, y});
	const double atCentre = angleBetween(model, {x / 2, y}, {x / 2 + step, y});
	const double angle = atEdge > 0 ? atEdge : atCentre;
	return {fitForShader(model), model.width(), model.height(), model.maxAngle(), angle > 0 ? step / angle : double(model.width())};
}

/// One camera without a polynomial makes tables of all: there is one shader for both.
void useTables(std::vector<PanelCamera> &cameras, uint32_t size)
{
	for (PanelCamera &camera : cameras) {
		if (camera.form.coefficients == 0 && camera.form.table.size() == size) continue;
		std::vector<float> table(size);
		for (uint32_t i = 0; i < size; ++i) table[i] = float(gainAt(camera, std::cos(camera.maxAngle * i / (size - 1))));
		camera.form.table = std::move(table);
		camera.form.coefficients = 0;
	}
}

} // namespace

double gainAt(const PanelCamera &camera, double cosine)
{
	const ShaderCamera &form = camera.form;
	if (form.coefficients == 0) {
		const double at = std::acos(std::min(cosine, 1.0)) / camera.maxAngle * double(form.table.size() - 1);
		const size_t index = std::min(size_t(at), form.table.size() - 2);
		return glm::mix(double(form.table[index]), double(form.table[index + 1]), at - double(index));
	}
	const double x = (cosine - double(form.cosineCentre)) * double(form.cosineScale);
	double g = 0;
	for (uint32_t i = form.coefficients; i-- > 0;) g = g * x + double(form.g[i]);
	return g;
}

PanelOptics::PanelOptics(const Rig &rig)
	: lens(rig.lens), shaderLens(fitForShader(rig.lens)), interpupillaryDistance(rig.interpupillaryDistance)
{
	const auto blue = lens.chromatic(Channel::blue);
	redItself = blue[1] != 0 || std::abs(blue[0] - 1) < 1e-6;
	for (size_t i = 0; i < std::min<size_t>(rig.cameras.size(), 2); ++i) cameras.push_back(describe(rig.cameras[i].model));
	bool table = false;
	for (const PanelCamera &camera : cameras) {
		table |= camera.form.coefficients == 0;
		cameraCoefficients = std::max(cameraCoefficients, camera.form.coefficients);
		tableSize = std::max(tableSize, uint32_t(camera.form.table.size()));
		tangential |= camera.form.tangential[0] != 0 || camera.form.tangential[1] != 0;
	}
	if (table) {
		cameraCoefficients = 0;
		useTables(cameras, tableSize);
	}
	if (cameras.empty()) cameraCoefficients = 1;
}

namespace
{

/// The camera image fades over this angle towards its edge.
constexpr double fadeAngle = 4 * M_PI / 180;

void describeLens(PanelNumbers &numbers, const PanelOptics &optics, const ViewGeometry &geometry)
{
	const LensModel &lens = optics.lens;
	const double perPixel = geometry.eyes[0].perPixel.x;
	if (!geometry.throughLens) {
		const auto fov = lens.fov(Eye::left, optics.interpupillaryDistance);
		numbers.fillScale = float(1 / (fov.up * fov.up + fov.left * fov.right));
		return;
	}
	const double rim = std::sqrt(lens.maxR2()) + rimPixels * perPixel;
	numbers.distortion = optics.shaderLens.d;
	numbers.largestR2 = float(lens.maxR2());
	numbers.rimScale = float(1 / (rim * rim - lens.maxR2()));
	numbers.fillScale = float(1 / lens.maxR2());
	const auto red = lens.chromatic(Channel::red), blue = lens.chromatic(Channel::blue);
	numbers.red = {float(red[0]), float(red[1])};
	numbers.blue = {float(blue[0]), float(blue[1])};
	if (!optics.redItself) numbers.redFromBlue = {float((red[0] - 1) / (blue[0] - 1)), float(red[1] / (blue[0] - 1))};
}

void describeCamera(PanelNumbers &numbers, const PanelCamera &camera)
{
	const ShaderCamera &form = camera.form;
	numbers.gain = form.g;
	numbers.centre = {form.centre.x, form.centre.y};
	numbers.cosineCentre = form.cosineCentre;
	numbers.cosineScale = form.cosineScale;
	numbers.affine = {form.affine[0][0], form.affine[0][1], form.affine[1][0], form.affine[1][1]};
	numbers.tangential = {form.tangential[0], form.tangential[1], form.xi};
	numbers.tableScale = float(1 / camera.maxAngle);
	const double fadeFrom = std::cos(std::max(camera.maxAngle - fadeAngle, 0.0));
	numbers.leastCosine = form.cosineLimit;
	numbers.cosineFade = float(1 / std::max(fadeFrom - double(form.cosineLimit), 1e-6));
	numbers.texelFade = float(1 / (camera.texelsPerRadian * fadeAngle));
	numbers.image = {float(camera.width), float(camera.height)};
}

} // namespace

PanelNumbers numbersFor(const PanelOptics &optics, const ViewGeometry &geometry, size_t camera)
{
	PanelNumbers numbers;
	describeLens(numbers, optics, geometry);
	if (camera < optics.cameras.size()) describeCamera(numbers, optics.cameras[camera]);
	return numbers;
}

ViewGeometry panelGeometry(const PanelOptics &optics)
{
	const PanelGeometry &panel = optics.lens.panel();
	const double perPixel = 1 / optics.lens.pixelsPerTangent();
	const int half = int(panel.width) / 2, height = int(panel.height);
	ViewGeometry geometry{.throughLens = true, .width = panel.width, .height = panel.height};
	for (int e = 0; e < 2; ++e)
		geometry.eyes[size_t(e)] = {.area = {e * half, 0, (e + 1) * half, height},
									.axis = optics.lens.centre(Eye(e)),
									.perPixel = {perPixel, -perPixel},
									.radius = std::sqrt(optics.lens.maxR2()) / perPixel + rimPixels};
	return geometry;
}

ViewGeometry eyesGeometry(const PanelOptics &optics)
{
	const uint32_t width = optics.lens.panel().width / 2;
	ViewGeometry geometry{.throughLens = false, .width = 2 * width};
	for (int e = 0; e < 2; ++e) {
		const auto fov = optics.lens.fov(Eye(e), optics.interpupillaryDistance);
		const double perPixel = (fov.left + fov.right) / width;
		geometry.height = uint32_t(std::lround((fov.up + fov.down) / perPixel));
		geometry.eyes[size_t(e)] = {.area = {e * int(width), 0, (e + 1) * int(width), int(geometry.height)},
									.axis = {e * double(width) + fov.left / perPixel, fov.up / perPixel},
									.perPixel = {perPixel, -perPixel}};
	}
	return geometry;
}

TileGrid makeGrid(const PanelOptics &optics, const ViewGeometry &geometry, size_t eye)
{
	const ViewGeometry::Eye view = geometry.eyes[eye];
	return TileGrid(view.area, view.axis, view.radius, [&](glm::dvec2 pixel) {
		const glm::dvec2 v = (pixel - view.axis) * view.perPixel;
		return geometry.throughLens ? v * optics.lens.scale(std::min(glm::dot(v, v), optics.lens.maxR2())) : v;
	});
}

} // namespace arift
