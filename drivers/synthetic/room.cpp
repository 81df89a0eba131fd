// Where things stand in the simulated room, and the light that falls on them.
#include "drivers/synthetic/paint.h"
#include "drivers/synthetic/scene.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

namespace arift::synthetic
{

namespace
{

using paint::Paint;

constexpr Box room{{-2.9f, -1.6f, -5.2f}, {2.9f, 1.0f, 2.0f}};
constexpr glm::vec3 windowCentre{-2.85f, -0.05f, -2.7f}, lampCentre{0, 0.9f, -2.1f};
constexpr float exposure = 0.86f; // of the sensor: the brightest surfaces stay just below its full scale

/// How one box is painted: front faces (x and z), top and bottom (y).
struct Thing {
	Box box;
	Paint x, y, z;
	float texelsPerMetre;
};

std::span<const Thing> things()
{
	using namespace paint;
	static const Thing all[] = {
		{{{-0.75f, -0.86f, -2.1f}, {0.75f, -0.82f, -1.2f}}, oak, oak, oak, 250},   // table top
		{{{-0.72f, -1.6f, -2.05f}, {-0.67f, -0.86f, -1.25f}}, oak, oak, oak, 120}, // its sides
		{{{0.67f, -1.6f, -2.05f}, {0.72f, -0.86f, -1.25f}}, oak, oak, oak, 120},
		{{{-0.55f, -0.82f, -1.75f}, {-0.3f, -0.739f, -1.5f}}, pages, bookCover, pages, 400}, // books
		{{{0.12f, -0.82f, -1.5f}, {0.2f, -0.72f, -1.42f}}, mug, mug, mug, 500},
		{{{0.3f, -0.82f, -1.95f}, {0.62f, -0.64f, -1.82f}}, radio, radio, radio, 400},
		{{{-2.2f, -1.6f, -5.2f}, {-1.0f, 0.4f, -4.85f}}, walnut, walnut, bookshelf, 220},
		{{{-0.3f, -1.6f, -5.2f}, {1.3f, -1.05f, -4.75f}}, walnut, walnut, drawers, 160}, // cabinet
		{{{0.0f, -1.0f, -5.15f}, {1.0f, -0.4f, -5.05f}}, metal, metal, television, 200},
		{{{0.4f, -1.05f, -5.12f}, {0.6f, -1.0f, -4.95f}}, metal, metal, metal, 80},             // its foot
		{{{-2.9f, -1.6f, -3.4f}, {-2.1f, -1.2f, -1.4f}}, sofaCloth, sofaCloth, sofaCloth, 150}, // sofa: seat, back, arms
		{{{-2.9f, -1.2f, -3.4f}, {-2.65f, -0.78f, -1.4f}}, sofaCloth, sofaCloth, sofaCloth, 150},
		{{{-2.65f, -1.2f, -3.4f}, {-2.1f, -1.0f, -3.2f}}, sofaCloth, sofaCloth, sofaCloth, 150},
		{{{-2.65f, -1.2f, -1.6f}, {-2.1f, -1.0f, -1.4f}}, sofaCloth, sofaCloth, sofaCloth, 150},
		{{{-2.65f, -1.2f, -2.3f}, {-2.5f, -0.85f, -1.9f}}, cushion, cushion, cushion, 200},
		{{{1.9f, -1.6f, -3.9f}, {2.2f, -1.25f, -3.6f}}, clay, walnut, clay, 150}, // plant
		{{{1.8f, -1.22f, -4.0f}, {2.3f, -0.45f, -3.5f}}, leaves, leaves, leaves, 200},
		{{{2.01f, -1.25f, -3.79f}, {2.09f, -1.22f, -3.71f}}, walnut, walnut, walnut, 80},
		{{{0.9f, -1.2f, -1.3f}, {1.25f, -1.15f, -0.95f}}, oak, stoolSeat, oak, 300}, // stool
		{{{0.94f, -1.6f, -1.26f}, {1.21f, -1.2f, -0.99f}}, walnut, walnut, walnut, 120},
		{{{-0.32f, -0.25f, -0.36f}, {-0.24f, -0.17f, -0.28f}}, colourCube, colourCube, colourCube, 900}, // at 0.45 m, on a stand
		{{{-0.29f, -1.6f, -0.33f}, {-0.27f, -0.25f, -0.31f}}, metal, metal, metal, 250},
		{{{0.4f, -1.6f, 1.5f}, {2.0f, 0.5f, 2.0f}}, oak, oak, drawers, 120}, // wardrobe behind
		{{{-0.35f, 0.93f, -2.35f}, {0.35f, 1.0f, -1.85f}}, lamp, lamp, lamp, 40},
	};
	return all;
}

float distanceTo(const Box &box, const glm::vec3 &point)
{
	return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::vec3(0)));
}

float sourceLight(const glm::vec3 &source, const glm::vec3 &direction, const glm::vec3 &point, const glm::vec3 &normal, float strength)
{
	const glm::vec3 offset = source - point;
	const float distance2 = glm::dot(offset, offset) + 0.5f; // an extended source: it never comes near
	const glm::vec3 towards = offset / std::sqrt(distance2);
	return strength * std::max(0.0f, glm::dot(normal, towards)) * std::max(0.0f, -glm::dot(direction, towards)) / distance2;
}

/// Daylight through the window, a lamp, what the walls return, and darkness where things touch.
glm::vec3 light(const glm::vec3 &point, const glm::vec3 &normal, std::span<const Box> near)
{
	const glm::vec3 daylight{0.97f, 1.0f, 1.06f}, lamplight{1.08f, 1.0f, 0.86f};
	glm::vec3 sum = glm::vec3(0.40f + 0.05f * normal.y + 0.05f * normal.z);
	sum += daylight * sourceLight(windowCentre, {1, 0, 0}, point, normal, 2.3f);
	sum += lamplight * sourceLight(lampCentre, {0, -1, 0}, point, normal, 1.0f);
	float open = 1;
	for (const Box &box : near) {
		const float reach = std::max(0.0f, 1 - distanceTo(box, point) / 0.28f);
		open *= 1 - 0.5f * reach * reach;
	}
	for (int axis = 0; axis < 3; axis++) { // the room's own edges
		const float edge = std::min(point[axis] - room.low[axis], room.high[axis] - point[axis]);
		const float reach = normal[axis] != 0 ? 0 : std::max(0.0f, 1 - edge / 0.45f);
		open *= 1 - 0.22f * reach * reach;
	}
	return sum * open * exposure;
}

constexpr uint32_t cell = 8; // texels

class RoomPainter
{
public:
	RoomPainter()
	{
		scene_.room = room;
		for (auto &plane : scene_.atlas) plane.reserve(size_t(3) << 20);
		for (const Thing &thing : things()) scene_.boxes.push_back(thing.box);
		const Paint shell[] = {paint::windowWall, paint::doorWall, paint::floorboards, paint::ceiling, paint::frontWall, paint::backWall};
		const float density[] = {130, 130, 140, 40, 130, 90};
		for (uint32_t face = 0; face < 6; face++) addFace(room, face, shell[face], density[face], nullptr);
		for (size_t i = 0; i < scene_.boxes.size(); i++) {
			const Thing &thing = things()[i];
			const Paint paints[] = {thing.x, thing.y, thing.z};
			for (uint32_t face = 0; face < 6; face++) addFace(thing.box, face, paints[face / 2], thing.texelsPerMetre, &scene_.boxes[i]);
		}
	}
	Scene take() { return std::move(scene_); }

private:
	/// Paints a face into the atlas. `own` is null for the room, whose faces look inwards.
	void addFace(const Box &box, uint32_t face, Paint paint, float density, const Box *own)
	{
		const int axis = int(face / 2), first = axis == 0 ? 2 : 0, second = axis == 1 ? 2 : 1;
		const bool isHigh = face % 2;
		Surface surface{.axis = uint32_t(axis), .texelsPerMetre = density, .low = {box.low[first], box.low[second]}};
		surface.width = uint32_t(std::ceil((box.high[first] - box.low[first]) * density));
		surface.height = uint32_t(std::ceil((box.high[second] - box.low[second]) * density));
		surface.base = uint32_t(scene_.atlas[0].size());
		surface.stride = surface.width;
		scene_.surfaces.push_back(surface);

		glm::vec3 point{0}, normal{0};
		point[axis] = isHigh ? box.high[axis] : box.low[axis];
		normal[axis] = (isHigh ? 1.0f : -1.0f) * (own ? 1.0f : -1.0f);
		const std::vector<Box> near = boxesNear(box, axis, point[axis], own);
		const auto place = [&](uint32_t column, uint32_t row) {
			point[first] = box.low[first] + (float(column) + 0.5f) / density;
			point[second] = box.low[second] + (float(row) + 0.5f) / density;
		};
		// Light changes slowly: it is worked out at the corners of cells and interpolated between them.
		const uint32_t cells = surface.width / cell + 2;
		std::vector<glm::vec3> above(cells), below(cells);
		const auto lightRow = [&](uint32_t row) {
			std::swap(above, below);
			for (uint32_t i = 0; i < cells; i++) {
				place(i * cell, row);
				below[i] = light(point, normal, near);
			}
		};
		lightRow(0);
		for (uint32_t row = 0; row < surface.height; row++) {
			if (row % cell == 0) lightRow(row + cell);
			for (uint32_t column = 0; column < surface.width; column++) {
				const uint32_t i = column / cell;
				const float along = float(column % cell) / cell, down = float(row % cell) / cell;
				const glm::vec3 lit = glm::mix(glm::mix(above[i], above[i + 1], along), glm::mix(below[i], below[i + 1], along), down);
				place(column, row);
				const glm::vec3 seen = paint({point[first], point[second]}) * lit;
				for (int c = 0; c < 3; c++) scene_.atlas[size_t(c)].push_back(uint8_t(std::clamp(seen[c], 0.0f, 1.0f) * 255 + 0.5f));
			}
		}
	}

	/// Those that can darken a face: within reach of its plane and its extent.
	std::vector<Box> boxesNear(const Box &box, int axis, float plane, const Box *own) const
	{
		constexpr float reach = 0.28f;
		Box face = box;
		face.low[axis] = face.high[axis] = plane;
		std::vector<Box> near;
		for (const Box &other : scene_.boxes) {
			const glm::vec3 gap = glm::max(glm::max(other.low - face.high, face.low - other.high), glm::vec3(0));
			if (&other != own && glm::length(gap) < reach) near.push_back(other);
		}
		return near;
	}

	Scene scene_;
};

} // namespace

Scene makeRoom() { return RoomPainter().take(); }

} // namespace arift::synthetic
