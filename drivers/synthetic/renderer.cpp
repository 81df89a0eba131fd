#include "drivers/synthetic/renderer.h"
#include "runtime/base/error.h"
#include "runtime/base/pose.h"
#include <algorithm>
#include <cmath>
#include <random>

namespace arift::synthetic
{

namespace
{

constexpr size_t noiseSize = 1 << 16;
constexpr float noiseScale = 32;
constexpr uint32_t samplesAcross = 4; // supersampling where markers are
constexpr float markerRed = 240;
constexpr float wallMargin = 0.05f; // metres that a camera keeps from the walls

std::array<uint32_t, 4> channelsOf(PixelFormat format)
{
	switch (format) {
	case PixelFormat::bayerRggb8: return {0, 1, 1, 2};
	case PixelFormat::bayerGrbg8: return {1, 0, 2, 1};
	case PixelFormat::bayerGbrg8: return {1, 2, 0, 1};
	case PixelFormat::bayerBggr8: return {2, 1, 1, 0};
	default: return {1, 1, 1, 1};
	}
}

std::vector<int8_t> makeNoise(uint64_t seed)
{
	std::mt19937_64 random(seed);
	std::normal_distribution<float> normal(0, noiseScale);
	std::vector<int8_t> noise(noiseSize);
	for (int8_t &value : noise) value = int8_t(std::clamp(std::round(normal(random)), -127.0f, 127.0f));
	return noise;
}

glm::vec3 toGlmFloat(const XrVector3f &v) { return {v.x, v.y, v.z}; }

} // namespace

Renderer::Renderer(std::shared_ptr<const Scene> scene, std::vector<Marker> markers, CameraGeometry geometry, const SensorSettings &sensor)
	: scene_(std::move(scene)),
	  markers_(std::move(markers)),
	  geometry_(std::move(geometry)),
	  sensor_(sensor),
	  columns_((geometry_.width + tileSize - 1) / tileSize),
	  rows_((geometry_.height + tileSize - 1) / tileSize)
{
	if (geometry_.rays.size() != size_t(geometry_.width) * geometry_.height || geometry_.rays.empty())
		throw InputError("simulated camera: {} rays, expected {} x {}", geometry_.rays.size(), geometry_.width, geometry_.height);
	tiles_.reserve(size_t(columns_) * rows_);
	for (uint32_t row = 0; row < rows_; row++)
		for (uint32_t column = 0; column < columns_; column++) tiles_.push_back(makeTile(column, row));
	if (sensor_.noise) noise_ = makeNoise(sensor_.seed);
	for (int value = 0; value < 256; value++) {
		const double raw = 255 * sensor_.blackLevel + value * (1 - sensor_.blackLevel);
		level_[size_t(value)] = int16_t(std::lround(raw * 16));
		// 0.7 of read noise, and shot noise of a sensor whose 255 is about 12000 electrons
		deviation_[size_t(value)] = int16_t(std::lround(16 * std::sqrt(0.49 + value * 255.0 / 12000)));
	}
}

glm::vec3 Renderer::rayAt(uint32_t x, uint32_t y) const
{
	return toGlmFloat(geometry_.rays[size_t(std::min(y, geometry_.height - 1)) * geometry_.width + std::min(x, geometry_.width - 1)]);
}

Renderer::Tile Renderer::makeTile(uint32_t column, uint32_t row) const
{
	Tile tile;
	glm::vec3 sum{0};
	uint32_t seeing = 0;
	for (uint32_t i = 0; i < tilePixels; i++) {
		const glm::vec3 ray = rayAt(column * tileSize + i % tileSize, row * tileSize + i / tileSize);
		seeing += ray != glm::vec3{0};
		sum += ray;
	}
	tile.isBlind = seeing == 0;
	tile.isPartlyBlind = seeing < tilePixels;
	tile.axis = glm::length(sum) > 0 ? glm::normalize(sum) : glm::vec3{0, 0, 1};
	for (uint32_t i = 0; i < tilePixels; i++) {
		glm::vec3 ray = rayAt(column * tileSize + i % tileSize, row * tileSize + i / tileSize);
		if (ray == glm::vec3{0}) ray = tile.axis; // drawn like the rest, then blackened
		tile.rays.x[i] = ray.x;
		tile.rays.y[i] = ray.y;
		tile.rays.z[i] = ray.z;
		tile.cosine = std::min(tile.cosine, glm::dot(ray, tile.axis));
	}
	tile.cosine = std::max(tile.cosine - 1e-5f, -1.0f);
	tile.sine = std::sqrt(std::max(0.0f, 1 - tile.cosine * tile.cosine));
	return tile;
}

/// The angle between the axes is at most the sum of the two half angles.
bool Renderer::Cone::meets(const Tile &tile) const
{
	if (cosine <= -1 || tile.cosine < -cosine) return true; // together more than half a turn
	return glm::dot(axis, tile.axis) >= cosine * tile.cosine - sine * tile.sine;
}

Renderer::Cone Renderer::coneOf(const glm::vec3 &centre, float radius, const TileView &view) const
{
	const glm::vec3 offset = centre - view.origin;
	const float distance = glm::length(offset);
	if (distance <= radius) return {};
	const float sine = radius / distance;
	return {glm::transpose(view.rotation) * offset / distance, std::sqrt(1 - sine * sine), sine};
}

void Renderer::draw(const glm::dquat &headOrientation, const glm::dvec3 &headPosition, uint64_t image, std::span<std::byte> pixels)
{
	TileView view;
	const glm::dvec3 position = headPosition + headOrientation * toGlm(geometry_.cameraInHead.position);
	view.origin = glm::clamp(glm::vec3(position), scene_->room.low + wallMargin, scene_->room.high - wallMargin);
	const glm::mat3 cvInCamera{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
	view.rotation = glm::mat3(glm::mat3_cast(headOrientation * toGlm(geometry_.cameraInHead.orientation))) * cvInCamera;
	const auto channels = channelsOf(sensor_.format);
	std::copy(channels.begin(), channels.end(), view.channels);
	for (size_t i = 0; i < 3; i++) view.planes[i] = scene_->atlas[i].data();

	std::vector<Cone> boxCones, markerCones;
	for (const Box &box : scene_->boxes)
		boxCones.push_back(coneOf((box.low + box.high) * 0.5f, glm::length(box.high - box.low) * 0.5f, view));
	for (const Marker &marker : markers_) {
		const double pixel = 0.003 * glm::length(marker.position); // about one, so that none at the rim is missed
		markerCones.push_back(coneOf(marker.position, float(2 * marker.radius + pixel), view));
	}

	std::minstd_rand random(uint32_t(image * 2654435761u + sensor_.seed));
	std::vector<uint16_t> boxes;
	TileImage tileImage;
	for (uint32_t row = 0; row < rows_; row++)
		for (uint32_t column = 0; column < columns_; column++) {
			const Tile &tile = tiles_[size_t(row) * columns_ + column];
			boxes.clear();
			for (size_t i = 0; i < boxCones.size(); i++)
				if (boxCones[i].meets(tile)) boxes.push_back(uint16_t(i));
			renderTile(*scene_, view, tile.rays, boxes, tileImage);
			for (size_t i = 0; i < markers_.size(); i++)
				if (markerCones[i].meets(tile)) drawMarker(markers_[i], markerCones[i], view, tile, column, row, tileImage);
			store(tile, column, row, uint32_t(random()), tileImage, pixels);
		}
}

void Renderer::drawMarker(const Marker &marker, const Cone &cone, const TileView &view, const Tile &tile, uint32_t column, uint32_t row,
						  TileImage &image) const
{
	for (uint32_t i = 0; i < tilePixels; i++) {
		const uint32_t x = column * tileSize + i % tileSize, y = row * tileSize + i / tileSize;
		if (x >= geometry_.width || y >= geometry_.height) continue;
		const glm::vec3 ray{tile.rays.x[i], tile.rays.y[i], tile.rays.z[i]};
		if (glm::dot(ray, cone.axis) < cone.cosine) continue;
		const uint32_t left = x > 0 ? x - 1 : x, right = std::min(x + 1, geometry_.width - 1);
		const uint32_t above = y > 0 ? y - 1 : y, below = std::min(y + 1, geometry_.height - 1);
		const glm::vec3 across = (rayAt(right, y) - rayAt(left, y)) / float(std::max(right - left, 1u));
		const glm::vec3 down = (rayAt(x, below) - rayAt(x, above)) / float(std::max(below - above, 1u));
		const float value = markerValue(marker, view, view.rotation * ray, view.rotation * across, view.rotation * down,
										view.channels[(x & 1) + 2 * (y & 1)], image.value[i]);
		image.value[i] = uint8_t(std::lround(value));
	}
}

/// The mean over the pixel's area. `ray` and its change per pixel are in the world. Nothing stands before a marker: half of one would be
/// found beside its place.
float Renderer::markerValue(const Marker &marker, const TileView &view, const glm::vec3 &ray, const glm::vec3 &across,
							const glm::vec3 &down, uint32_t channel, float background) const
{
	const glm::vec3 centre(marker.position), normal = -glm::normalize(centre), offset = centre - view.origin;
	const float height = glm::dot(normal, offset); // negative where the marker's face is seen
	const float radius2 = float(marker.radius * marker.radius);
	const auto sample = [&](const glm::vec3 &direction) {
		const float t = height / glm::dot(normal, direction);
		const glm::vec3 fromCentre = direction * t - offset;
		const float r2 = glm::dot(fromCentre, fromCentre);
		const bool isSeen = height < 0 && t > 0 && r2 <= 4 * radius2;
		return !isSeen ? background : r2 <= radius2 && channel == 0 ? markerRed : 0;
	};
	// Where neither rim crosses the pixel, whose half diagonal is stretched at most twice, one sample tells it all.
	const float t = height / glm::dot(normal, ray), reach = 0.75f * t * (glm::length(across) + glm::length(down));
	const float r = glm::length(ray * t - offset), radius = float(marker.radius);
	const bool isPlain = std::abs(r - radius) > reach && std::abs(r - 2 * radius) > reach && glm::dot(normal, ray) < -0.5f;
	if (isPlain) return sample(ray);
	float sum = 0;
	for (uint32_t i = 0; i < samplesAcross * samplesAcross; i++) {
		const float sx = (float(i % samplesAcross) + 0.5f) / samplesAcross - 0.5f;
		const float sy = (float(i / samplesAcross) + 0.5f) / samplesAcross - 0.5f;
		sum += sample(ray + across * sx + down * sy);
	}
	return sum / (samplesAcross * samplesAcross);
}

void Renderer::store(const Tile &tile, uint32_t column, uint32_t row, uint32_t noise, TileImage &image, std::span<std::byte> pixels) const
{
	if (tile.isBlind) std::fill(std::begin(image.value), std::end(image.value), uint8_t{0});
	const uint32_t width = std::min(tileSize, geometry_.width - column * tileSize),
				   height = std::min(tileSize, geometry_.height - row * tileSize);
	for (uint32_t y = 0; y < height; y++) {
		const size_t first = size_t(row * tileSize + y) * geometry_.width + column * tileSize;
		uint8_t *values = image.value + size_t(y) * tileSize;
		if (tile.isPartlyBlind)
			for (uint32_t x = 0; x < width; x++)
				if (geometry_.rays[first + x].x == 0 && geometry_.rays[first + x].y == 0 && geometry_.rays[first + x].z == 0) values[x] = 0;
		std::byte *out = pixels.data() + first;
		if (noise_.empty()) {
			for (uint32_t x = 0; x < width; x++) out[x] = std::byte((level_[values[x]] + 8) / 16);
			continue;
		}
		const int8_t *random = noise_.data() + (noise + y * 7919 * tileSize) % (noiseSize - tileSize);
		for (uint32_t x = 0; x < width; x++) {
			const int raw = (level_[values[x]] * int(noiseScale) + random[x] * deviation_[values[x]] + 8 * int(noiseScale)) >> 9;
			out[x] = std::byte(std::clamp(raw, 0, 255));
		}
	}
}

} // namespace arift::synthetic
