// Draws what one simulated camera sees at an instant: raw Bayer, 8 bit, linear, every pixel along its own ray.
#pragma once
#include "drivers/synthetic/tile_kernel.h"
#include "runtime/device/camera.h"
#include "runtime/device/driver.h"
#include <glm/gtc/quaternion.hpp>
#include <memory>

namespace arift::synthetic
{

struct SensorSettings {
	PixelFormat format = PixelFormat::bayerGrbg8;
	double blackLevel = 0; ///< raw value of darkness, 0..1
	bool noise = false;    ///< shot and read noise
	uint64_t seed = 1;
};

/// Thread-bound. No motion blur: the shutter is taken as instant.
class Renderer
{
public:
	/// The geometry's rays are used up.
	Renderer(std::shared_ptr<const Scene> scene, std::vector<Marker> markers, CameraGeometry geometry, const SensorSettings &sensor);

	/// `pixels`: width * height values. `image` numbers the noise.
	void draw(const glm::dquat &headOrientation, const glm::dvec3 &headPosition, uint64_t image, std::span<std::byte> pixels);

private:
	struct Tile {
		TileRays rays;
		glm::vec3 axis{0};                           ///< CV frame; of the cone that holds the tile's rays
		float cosine = 1, sine = 0;                  ///< of half the cone's angle
		bool isBlind = false, isPartlyBlind = false; ///< the lens sees nothing at all, or at some pixels
	};
	struct Cone { ///< of a thing as seen from the camera, CV frame
		glm::vec3 axis{0};
		float cosine = -1, sine = 0;
		bool meets(const Tile &tile) const;
	};

	Tile makeTile(uint32_t column, uint32_t row) const;
	Cone coneOf(const glm::vec3 &centre, float radius, const TileView &view) const;
	void drawMarker(const Marker &marker, const Cone &cone, const TileView &view, const Tile &tile, uint32_t column, uint32_t row,
					TileImage &image) const;
	float markerValue(const Marker &marker, const TileView &view, const glm::vec3 &ray, const glm::vec3 &across, const glm::vec3 &down,
					  uint32_t channel, float background) const;
	void store(const Tile &tile, uint32_t column, uint32_t row, uint32_t noise, TileImage &image, std::span<std::byte> pixels) const;
	glm::vec3 rayAt(uint32_t x, uint32_t y) const;

	const std::shared_ptr<const Scene> scene_;
	const std::vector<Marker> markers_;
	const CameraGeometry geometry_;
	const SensorSettings sensor_;
	uint32_t columns_, rows_; ///< tiles
	std::vector<Tile> tiles_;
	std::vector<int8_t> noise_;            ///< standard normal, times 32; empty: none
	std::array<int16_t, 256> level_{};     ///< raw value of an atlas value, times 16
	std::array<int16_t, 256> deviation_{}; ///< of the noise at that value, times 16
};

} // namespace arift::synthetic
