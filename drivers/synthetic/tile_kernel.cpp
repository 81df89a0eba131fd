#include "drivers/synthetic/tile_kernel.h"
#include <algorithm>
#include <limits>

// Every loop here runs over the whole tile and has no branch, so that the compiler can use vectors. One version for any x86-64 and one for
// those with AVX2; sanitizers and other machines get the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ARIFT_VECTOR_VERSIONS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ARIFT_VECTOR_VERSIONS
#endif
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
	for (uint32_t i = 0; i < tilePixels; i++) image.distance[i] = std::numeric_limits<float>::max();
	for (int axis = 0; axis < 3; axis++) {
		const float low = room.low[axis] - origin[axis], high = room.high[axis] - origin[axis];
		const int32_t face = 2 * axis;
		for (uint32_t i = 0; i < tilePixels; i++) {
			const float reciprocal = world.reciprocal[axis][i];
			const bool isHigh = reciprocal > 0;
			const float t = (isHigh ? high : low) * reciprocal;
			const bool isNearer = t < image.distance[i];
			image.surface[i] = isNearer ? (isHigh ? face + 1 : face) : image.surface[i];
			image.distance[i] = isNearer ? t : image.distance[i];
		}
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
	const float stride = float(surface.stride);
	const int32_t base = int32_t(surface.base);
	const float *u = world.direction[first], *v = world.direction[second];
	for (uint32_t i = 0; i < tilePixels; i++) {
		const float along = image.distance[i] * scale;
		float column = firstOffset + along * u[i], row = secondOffset + along * v[i];
		column = column > 0 ? column : 0;
		column = column < lastColumn ? column : lastColumn;
		row = row > 0 ? row : 0;
		row = row < lastRow ? row : lastRow;
		const int32_t texel = base + int32_t(float(int32_t(row)) * stride) + int32_t(column); // exact below 2^24
		image.texel[i] = image.surface[i] == index ? texel : image.texel[i];
	}
}

/// The surfaces that occur in a tile: rarely more than three.
ARIFT_INLINE void findAllTexels(const Scene &scene, const glm::vec3 &origin, const WorldRays &world, TileImage &image)
{
	int32_t remaining[tilePixels];
	uint32_t count = tilePixels;
	for (uint32_t i = 0; i < tilePixels; i++) {
		remaining[i] = image.surface[i];
		image.texel[i] = 0;
	}
	while (count > 0) {
		const int32_t index = remaining[0];
		findTexels(scene.surfaces[size_t(index)], index, origin, world, image);
		uint32_t kept = 0;
		for (uint32_t i = 0; i < count; i++) {
			remaining[kept] = remaining[i];
			kept += remaining[i] != index;
		}
		count = kept;
	}
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
	for (uint32_t i = 0; i < tilePixels; i++) image.surface[i] = 0;
	hitRoom(scene.room, view.origin, world, image);
	for (const uint16_t box : boxes) hitBox(scene.boxes[box], view.origin, 6 * (int32_t(box) + 1), world, image);
	findAllTexels(scene, view.origin, world, image);
	fetch(view, image);
}

} // namespace arift::synthetic
