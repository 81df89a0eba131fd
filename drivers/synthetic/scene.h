// The room the simulated cameras see: a box with furniture in it, every face with a picture whose light is baked in.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace arift::synthetic
{

/// A saturated red disc (green and blue are black) on a black one of twice its radius, facing the world's origin; seen through whatever
/// stands before it.
struct Marker {
	glm::dvec3 position{0}; ///< metres, world
	double radius = 0;      ///< of the red disc, metres
};

struct Box {
	glm::vec3 low{0}, high{0}; ///< metres, world
};

/// One face of a box. Its texel (i, j) lies at atlas index `base + j * stride + i`.
struct Surface {
	uint32_t axis = 0; ///< the face is perpendicular to it; (first, second) of its picture: 0 (z, y), 1 (x, z), 2 (x, y)
	float texelsPerMetre = 0;
	glm::vec2 low{0}; ///< metres along first and second, of the picture's corner
	uint32_t width = 0, height = 0;
	uint32_t base = 0, stride = 0;
};

struct Scene {
	Box room;                      ///< seen from inside
	std::vector<Box> boxes;        ///< seen from outside
	std::vector<Surface> surfaces; ///< six of the room (-x, +x, -y, +y, -z, +z), then six of each box
	/// Red, green, blue as the sensor sees them, linear, in three planes of the same layout.
	std::array<std::vector<uint8_t>, 3> atlas;
};

/// 5.8 x 2.6 x 7.2 m around somebody at the origin whose eyes are 1.6 m above the floor; things from 0.4 to 5 m away.
Scene makeRoom();

} // namespace arift::synthetic
