// The inner loop of the camera simulation: one tile of rays against the room and a few boxes, down to one raw value per pixel.
#pragma once
#include "drivers/synthetic/scene.h"
#include <glm/mat3x3.hpp>
#include <span>

namespace arift::synthetic
{

constexpr uint32_t tileSize = 16;
constexpr uint32_t tilePixels = tileSize * tileSize;

/// Unit directions in the CV frame, row by row.
struct alignas(64) TileRays {
	float x[tilePixels], y[tilePixels], z[tilePixels];
};

/// Where the camera is, and what its pixels measure.
struct TileView {
	glm::vec3 origin{0};           ///< metres, world; inside the room
	glm::mat3 rotation{1};         ///< CV frame to world
	const uint8_t *planes[3] = {}; ///< of the scene's atlas
	uint32_t channels[4] = {};     ///< plane measured at (even, even), (odd, even), (even, odd), (odd, odd) column and row
};

struct alignas(64) TileImage {
	float distance[tilePixels];  ///< metres to what is seen
	int32_t surface[tilePixels]; ///< index into the scene's surfaces
	int32_t texel[tilePixels];   ///< index into the atlas
	uint8_t value[tilePixels];
};

/// `boxes`: indices of those that the tile may see.
void renderTile(const Scene &scene, const TileView &view, const TileRays &rays, std::span<const uint16_t> boxes, TileImage &image);

} // namespace arift::synthetic
