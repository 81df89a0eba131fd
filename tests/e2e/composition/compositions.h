// What an application can show, as plain data: compositions of layers after those that Khronos' conformance suite shows to people. Read by
// the application that submits them and by the account of what must be seen.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace arift::e2e
{

/// Plain: of one light. Oriented: red grows to the right, green downwards, blue with the array layer. Cells: 4 x 2 of different light.
/// Fading: of one light, its alpha growing downwards.
enum class Paint { plain, oriented, cells, fading };

/// sRGB encoded, 8 bits. Texels of a cube's faces are array layers, six each.
struct Image {
	Paint paint = Paint::plain;
	std::array<double, 3> light{}; ///< linear, straight
	int width = 64, height = 64, arrayLayers = 1;
	bool isCube = false;
	bool isMultiplied = true; ///< by its alpha
};
std::array<uint8_t, 4> texelOf(const Image &image, int column, int row, int arrayLayer);

/// Turned about an axis by so many radians, then moved by so many metres. OpenXR's axes.
struct Pose {
	std::array<double, 3> axis{0, 1, 0};
	double angle = 0;
	std::array<double, 3> position{};
};

/// A rectangle of texels; width 0: the whole image.
struct Part {
	size_t image = 0;
	int arrayLayer = 0;
	int column = 0, row = 0, width = 0, height = 0;
};

enum class Shape { projection, quad, cylinder, equirect, cube };
struct Layer {
	Shape shape = Shape::quad;
	Part part;      ///< of the left eye
	Part rightPart; ///< of the right one: projections alone
	Pose spaceInView, poseInSpace;
	std::array<bool, 2> eyes{true, true};
	bool hasAlpha = false, isMultiplied = true;
	std::array<double, 4> scale{1, 1, 1, 1}, bias{}; ///< of straight colour and alpha
	double width = 1, height = 1;                    ///< quad: metres
	// Projection: its field of view's edges are exchanged, and its angles multiplied.
	bool isUpsideDown = false, isMirrored = false;
	double angleScale = 1;
	// Cylinder and equirect; the latter with radius 0 infinitely far.
	double radius = 1, across = 1, aspect = 1, upper = 0, lower = 0; ///< metres, radians, width over height, radians
};

struct Composition {
	std::string name;
	std::vector<Image> images;
	std::vector<Layer> layers; ///< bottom first
};
const std::vector<Composition> &compositions();

} // namespace arift::e2e
