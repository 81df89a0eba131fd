#include "drivers/synthetic/tile_kernel.h"
#include "runtime/base/vector_versions.h"
#include <algorithm>

// Every loop here runs over the whole tile and has no branch.
#define ARIFT_INLINE inline __attribute__((always_inline))

namespace arift::synthetic
{

namespace
{

constexpr float nearest = 0.02f; // metres: a box the camera is in, or touches, is not seen

/// Directions in the world and their reciprocals.
struct alignas(64) WorldRays {
	float direction[3][tilePixels], reciprocal[3][tilePixels];
};

ARIFT_INLINE void turn(const glm::mat3 &rotation, const TileRays &rays, WorldRays &world)
{
	for (int axis = 0; axis < 3; axis++) {
		const float x = rotation[0][axis], y = rotation[1][axis], z = rotation[2][axis];
		for (uint32_t i = 0; i < tilePixels; i++) {
			const float d = x * rays.x[i] + y * rays.y[i] + z * rays.z[i];
			world.direction[axis][i] = d;
			world.reciprocal[axis][i] = 1.0f / d;
		}
	}
}

/// The wall through which each ray leaves the room.
ARIFT_INLINE void hitRoom(const Box &room, const glm::vec3 &origin, const WorldRays &world, TileImage &image)
{
	const glm::vec3 low = room.low - origin, high = room.high - origin;
	for (uint32_t i = 0; i < tilePixels; i++) {
		const float rx = world.reciprocal[0][i], ry = world.reciprocal[1][i], rz = world.reciprocal[2][i];
		const float x0 = low.x * rx, x1 = high.x * rx, y0 = low.y * ry, y1 = high.y * ry, z0 = low.z * rz, z1 = high.z * rz;
		const float outX = x0 < x1 ? x1 : x0, outY = y0 < y1 ? y1 : y0, outZ = z0 < z1 ? z1 : z0; // one of each pair lies ahead
		const int32_t faceX = rx > 0 ? 1 : 0, faceY = ry > 0 ? 3 : 2, faceZ = rz > 0 ? 5 : 4;
		const float outXY = outX < outY ? outX : outY;
		const int32_t faceXY = outX < outY ? faceX : faceY;
		image.distance[i] = outXY < outZ ? outXY : outZ;
		image.surface[i] = outXY < outZ ? faceXY : faceZ;
	}
}

/// Where a ray enters a box nearer than anything before it.
ARIFT_INLINE void hitBox(const Box &box, const glm::vec3 &origin, int32_t firstFace, const WorldRays &world, TileImage &image)
{
	const glm::vec3 low = box.low - origin, high = box.high - origin;
	for (uint32_t i = 0; i < tilePixels; i++) {
		const float rx = world.reciprocal[0][i], ry = world.reciprocal[1][i], rz = world.reciprocal[2][i];
		const float x0 = low.x * rx, x1 = high.x * rx, y0 = low.y * ry, y1 = high.y * ry, z0 = low.z * rz, z1 = high.z * rz;
		const float inX = x0 < x1 ? x0 : x1, inY = y0 < y1 ? y0 : y1, inZ = z0 < z1 ? z0 : z1;
		const float outX = x0 < x1 ? x1 : x0, outY = y0 < y1 ? y1 : y0, outZ = z0 < z1 ? z1 : z0;
		const int32_t faceX = rx > 0 ? 0 : 1, faceY = ry > 0 ? 2 : 3, faceZ = rz > 0 ? 4 : 5;
		const float inXY = inX > inY ? inX : inY;
		const int32_t faceXY = inX > inY ? faceX : faceY;
		const float in = inXY > inZ ? inXY : inZ;
		const int32_t face = inXY > inZ ? faceXY : faceZ;
		const float outXY = outX < outY ? outX : outY;
		const float out = outXY < outZ ? outXY : outZ;
		const float limit = out < image.distance[i] ? out : image.distance[i];
		const bool isHit = (in < limit) & (in > nearest);
		image.surface[i] = isHit ? firstFace + face : image.surface[i];
		image.distance[i] = isHit ? in : image.distance[i];
	}
}

/// Texels of the pixels that see `surface`; the clamps also swallow what is not a number.
ARIFT_INLINE void findTexels(const Surface &surface, int32_t index, const glm::vec3 &origin, const WorldRays &world, TileImage &image)
{
	const int first = surface.axis == 0 ? 2 : 0, second = surface.axis == 1 ? 2 : 1;
	const float scale = surface.texelsPerMetre;
	const float firstOffset = (origin[first] - surface.low.x) * scale, secondOffset = (origin[second] - surface.low.y) * scale;
	const float lastColumn = float(surface.width - 1), lastRow = float(surface.height - 1);
	const int32_t base = int32_t(surface.base), stride = int32_t(surface.stride);
	const float *u = world.direction[first], *v = world.direction[second];
	for (uint32_t i = 0; i < tilePixels; i++) {
		const float along = image.distance[i] * scale;
		const float column = firstOffset + along * u[i], row = secondOffset + along * v[i];
		const int32_t texelColumn = int32_t(std::min(std::max(0.0f, column), lastColumn));
		const int32_t texelRow = int32_t(std::min(std::max(0.0f, row), lastRow));
		const int32_t texel = base + texelRow * stride + texelColumn;
		const int32_t before = image.texel[i], seen = image.surface[i];
		image.texel[i] = seen == index ? texel : before;
	}
}

/// Most tiles see one surface only, few more than three.
ARIFT_INLINE void findAllTexels(const Scene &scene, const glm::vec3 &origin, const WorldRays &world, TileImage &image)
{
	const int32_t first = image.surface[0];
	int32_t differing = 0;
	for (uint32_t i = 0; i < tilePixels; i++) {
		differing |= image.surface[i] ^ first;
		image.texel[i] = -1;
	}
	findTexels(scene.surfaces[size_t(first)], first, origin, world, image);
	if (differing == 0) return;
	for (uint32_t i = 1; i < tilePixels; i++)
		if (image.texel[i] < 0) findTexels(scene.surfaces[size_t(image.surface[i])], image.surface[i], origin, world, image);
}

ARIFT_INLINE void fetch(const TileView &view, TileImage &image)
{
	for (uint32_t row = 0; row < tileSize; row++) {
		const uint8_t *even = view.planes[view.channels[2 * (row & 1)]], *odd = view.planes[view.channels[2 * (row & 1) + 1]];
		for (uint32_t i = row * tileSize; i < (row + 1) * tileSize; i += 2) {
			image.value[i] = even[image.texel[i]];
			image.value[i + 1] = odd[image.texel[i + 1]];
		}
	}
}

} // namespace

ARIFT_VECTOR_VERSIONS void renderTile(const Scene &scene, const TileView &view, const TileRays &rays, std::span<const uint16_t> boxes,
									  TileImage &image)
{
	WorldRays world;
	turn(view.rotation, rays, world);
	hitRoom(scene.room, view.origin, world, image);
	for (const uint16_t box : boxes) hitBox(scene.boxes[box], view.origin, 6 * (int32_t(box) + 1), world, image);
	findAllTexels(scene, view.origin, world, image);
	fetch(view, image);
}

} // namespace arift::synthetic
