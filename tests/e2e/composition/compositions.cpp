#include "tests/e2e/composition/compositions.h"
#include <cmath>

namespace arift::e2e
{

namespace
{

constexpr double degree = M_PI / 180;
constexpr std::array<double, 3> red{0.9, 0.05, 0.02}, green{0.04, 0.8, 0.06}, blue{0.03, 0.05, 0.9}, grey{0.3, 0.3, 0.3};

uint8_t encoded(double light)
{
	const double value = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
	return uint8_t(std::lround(255 * value));
}

Image plain(const std::array<double, 3> &light) { return {.light = light}; }
Pose at(double x, double y, double z) { return {.position = {x, y, z}}; }
Pose turned(double degrees, std::array<double, 3> position, std::array<double, 3> axis = {0, 1, 0})
{
	return {axis, degrees * degree, position};
}
Layer quad(size_t image, const Pose &pose) { return {.part = {.image = image}, .poseInSpace = pose}; }
Layer views(const Part &left, const Part &right) { return {.shape = Shape::projection, .part = left, .rightPart = right}; }

/// Painter's algorithm: two quads that cut each other, the later one over the earlier, and one that is turned away.
Composition quadOcclusion()
{
	return {"QuadOcclusion",
			{plain(blue), plain(green), plain(red)},
			{quad(0, turned(-45, {0, 0, -2})), quad(1, turned(45, {0, 0, -2})), quad(2, turned(180, {0, 0, -1}))}};
}

/// The same place by its space's pose and by its own, in either order.
Composition quadPoses()
{
	Composition all{"QuadPoses", {plain(blue), plain(green), {.paint = Paint::oriented}}, {}};
	const Pose turn = turned(30, {-0.4, 0.3, -1.5}), move = at(0.2, -0.2, 0);
	Layer first = quad(0, move), second = quad(1, turn), third = quad(2, turned(25, {0.5, 0.3, -1.2}, {1, 0, 0}));
	first.spaceInView = turn;
	second.spaceInView = move;
	third.spaceInView = turned(-20, {0, 0, 0}, {0, 0, 1});
	for (Layer *layer : {&first, &second, &third}) layer->width = layer->height = 0.4;
	all.layers = {first, second, third};
	return all;
}

/// Fading pictures, multiplied by their alpha and not, over grey; and one whose alpha does not count.
Composition sourceAlphaBlending()
{
	Composition all{"SourceAlphaBlending", {plain(grey)}, {quad(0, at(0, 0, -1.5))}};
	all.layers[0].width = 1.6;
	for (const bool isMultiplied : {true, false}) {
		all.images.push_back({.paint = Paint::fading, .light = green, .isMultiplied = isMultiplied});
		Layer layer = quad(all.images.size() - 1, at(isMultiplied ? -0.5 : 0, 0, -1.4));
		layer.width = layer.height = 0.4;
		layer.hasAlpha = true;
		layer.isMultiplied = isMultiplied;
		all.layers.push_back(layer);
	}
	Layer opaque = quad(1, at(0.5, 0, -1.4));
	opaque.width = opaque.height = 0.4;
	all.layers.push_back(opaque);
	return all;
}

Composition eyeVisibility()
{
	Composition all{"EyeVisibility", {plain(green), plain(blue)}, {quad(0, at(-0.3, 0, -2)), quad(1, at(0.3, 0, -2))}};
	all.layers[0].eyes = {true, false};
	all.layers[1].eyes = {false, true};
	return all;
}

/// Every cell of two array layers on a quad of its own.
Composition subimage()
{
	Composition all{"Subimage", {{.paint = Paint::cells, .width = 256, .height = 128, .arrayLayers = 2}}, {}};
	for (int i = 0; i < 16; ++i) {
		const int column = i % 4, row = i / 4 % 2, arrayLayer = i / 8;
		Layer layer = quad(0, at(0.3 * (column - 1.5), 0.3 * (1.5 - row - 2 * arrayLayer), -1.5));
		layer.part = {0, arrayLayer, 64 * column, 64 * row, 64, 64};
		layer.width = layer.height = 0.25;
		all.layers.push_back(layer);
	}
	return all;
}

/// Both eyes' views in array layers, side by side in one image, and in images of their own.
Composition projectionArray()
{
	return {"ProjectionArraySwapchain",
			{{.paint = Paint::oriented, .width = 400, .height = 500, .arrayLayers = 2}},
			{views({.arrayLayer = 0}, {.arrayLayer = 1})}};
}
Composition projectionWide()
{
	return {"ProjectionWideSwapchain",
			{{.paint = Paint::cells, .width = 800, .height = 500}},
			{views({.column = 0, .width = 400, .height = 500}, {.column = 400, .width = 400, .height = 500})}};
}
Composition projectionSeparate()
{
	return {"ProjectionSeparateSwapchains",
			{{.paint = Paint::oriented, .width = 300, .height = 400}, {.paint = Paint::cells, .width = 320, .height = 360}},
			{views({.image = 0}, {.image = 1})}};
}

Composition projectionMutable(const char *name, bool isUpsideDown, bool isMirrored, double angleScale)
{
	Composition all{std::string("ProjectionMutableFieldOfView, ") + name,
					{{.paint = Paint::oriented, .width = 400, .height = 500, .arrayLayers = 2}},
					{views({.arrayLayer = 0}, {.arrayLayer = 1})}};
	all.layers[0].isUpsideDown = isUpsideDown;
	all.layers[0].isMirrored = isMirrored;
	all.layers[0].angleScale = angleScale;
	return all;
}

Composition cylinder()
{
	Composition all{"XR_KHR_composition_layer_cylinder", {{.paint = Paint::cells, .width = 256, .height = 128}}, {}};
	all.layers = {{.shape = Shape::cylinder, .poseInSpace = turned(15, {0.1, 0, -0.2}), .radius = 1.2, .across = 1.6, .aspect = 1.5},
				  {.shape = Shape::cylinder,
				   .part = {.column = 64, .row = 64, .width = 64, .height = 64},
				   .poseInSpace = turned(-20, {0, 0.5, 0}, {1, 0, 0}),
				   .radius = 1,
				   .across = 0.5,
				   .aspect = 1}};
	return all;
}

Composition equirect(const char *name, double radius)
{
	Composition all{name, {{.paint = Paint::cells, .width = 512, .height = 256}}, {}};
	all.layers = {{.shape = Shape::equirect,
				   .poseInSpace = turned(10, {0.1, 0.1, 0.2}),
				   .radius = radius,
				   .across = 150 * degree,
				   .upper = 40 * degree,
				   .lower = -50 * degree}};
	return all;
}

Composition cube()
{
	Composition all{"XR_KHR_composition_layer_cube", {{.paint = Paint::oriented, .width = 512, .height = 512, .isCube = true}}, {}};
	all.layers = {{.shape = Shape::cube, .poseInSpace = turned(35, {0, 0, 0}, {0.3, 1, 0.2})}};
	return all;
}

Composition colorScaleBias()
{
	Composition all{"XR_KHR_composition_layer_color_scale_bias",
					{plain(grey), {.paint = Paint::oriented}, {.paint = Paint::fading, .light = green, .isMultiplied = true}},
					{quad(0, at(0, 0, -1.6)), quad(1, at(-0.3, 0, -1.5)), quad(2, at(0.3, 0, -1.5))}};
	all.layers[0].width = 1.6;
	for (const size_t i : {size_t(1), size_t(2)}) {
		all.layers[i].width = all.layers[i].height = 0.4;
		all.layers[i].scale = {0.5, 1, 0.25, 0.9};
		all.layers[i].bias = {0.1, -0.1, 0.2, 0.05};
	}
	all.layers[2].hasAlpha = true;
	return all;
}

} // namespace

std::array<uint8_t, 4> texelOf(const Image &image, int column, int row, int arrayLayer)
{
	const double right = (column + 0.5) / image.width, down = (row + 0.5) / image.height;
	const int cell = 4 * (row * 2 / image.height) + column * 4 / image.width;
	std::array<double, 3> light = image.light;
	double alpha = 1;
	switch (image.paint) {
	case Paint::plain: break;
	case Paint::oriented: light = {right, down, 0.15 * (arrayLayer + 1)}; break;
	case Paint::cells: light = {0.1 * (cell + 1), cell % 2 ? 0.7 : 0.1, arrayLayer ? 0.8 : 0.05}; break;
	case Paint::fading: alpha = down; break;
	}
	const double shown = image.isMultiplied ? alpha : 1;
	return {encoded(light[0] * shown), encoded(light[1] * shown), encoded(light[2] * shown), uint8_t(std::lround(255 * alpha))};
}

const std::vector<Composition> &compositions()
{
	static const std::vector<Composition> all{quadOcclusion(),
											  quadPoses(),
											  sourceAlphaBlending(),
											  eyeVisibility(),
											  subimage(),
											  projectionArray(),
											  projectionWide(),
											  projectionSeparate(),
											  projectionMutable("upside down", true, false, 1),
											  projectionMutable("mirrored", false, true, 1),
											  projectionMutable("narrow, both", true, true, 0.6),
											  cylinder(),
											  equirect("XR_KHR_composition_layer_equirect2", 2),
											  equirect("XR_KHR_composition_layer_equirect2, infinitely far", 0),
											  cube(),
											  colorScaleBias()};
	return all;
}

} // namespace arift::e2e
