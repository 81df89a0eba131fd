// What the pictures are made of: colours, noise, shapes. All pure and cheap: millions of texels are painted at start-up.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace arift::synthetic::paint
{

/// A colour as a designer names it (sRGB, 0xRRGGBB), made linear by a polynomial within 0.003 of the exact curve.
constexpr glm::vec3 colour(uint32_t rgb)
{
	const auto channel = [&](int shift) {
		const float c = float((rgb >> shift) & 255) / 255;
		return c * (c * (c * 0.3053f + 0.6822f) + 0.0125f);
	};
	return {channel(16), channel(8), channel(0)};
}

/// 0 to 1, the same for the same pair.
constexpr float random(int x, int y)
{
	uint32_t h = uint32_t(x) * 0x8da6b343u ^ uint32_t(y) * 0xd8163841u;
	h = (h ^ (h >> 15)) * 0x2c1b3c6du;
	h = (h ^ (h >> 12)) * 0x297a2d39u;
	return float((h ^ (h >> 15)) >> 8) / float(1 << 24);
}

/// random() of 128 x 128 points, which repeat.
class Lattice
{
public:
	constexpr Lattice()
	{
		for (int y = 0; y < size; y++)
			for (int x = 0; x < size; x++) values_[size_t(y * size + x)] = random(x, y);
	}
	constexpr float at(int x, int y) const { return values_[size_t((y & (size - 1)) * size + (x & (size - 1)))]; }

private:
	static constexpr int size = 128;
	std::array<float, size_t(size) * size> values_{};
};
inline constexpr Lattice lattice;

/// Smooth noise with a grain of 1, 0 to 1.
inline float noise(glm::vec2 p)
{
	const int x = int(p.x) - (p.x < 0), y = int(p.y) - (p.y < 0);
	glm::vec2 s{p.x - float(x), p.y - float(y)};
	s = s * s * (3.0f - 2.0f * s);
	return glm::mix(glm::mix(lattice.at(x, y), lattice.at(x + 1, y), s.x), glm::mix(lattice.at(x, y + 1), lattice.at(x + 1, y + 1), s.x),
					s.y);
}

/// Two octaves.
inline float cloud(glm::vec2 p) { return 0.65f * noise(p) + 0.35f * noise(p * 2.3f + 17.0f); }

inline bool inRect(glm::vec2 p, float x0, float y0, float x1, float y1) { return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1; }
inline bool inDisc(glm::vec2 p, float x, float y, float radius)
{
	return glm::dot(p - glm::vec2(x, y), p - glm::vec2(x, y)) <= radius * radius;
}
/// From 0 to 1 inside a rectangle.
inline glm::vec2 within(glm::vec2 p, float x0, float y0, float x1, float y1) { return {(p.x - x0) / (x1 - x0), (p.y - y0) / (y1 - y0)}; }
inline float fraction(float x) { return x - std::floor(x); }
/// Distance to the nearest line of a grid with this period.
inline float toGrid(float x, float period) { return std::abs(x - period * std::round(x / period)); }

/// Grain along x: `light` and `dark` wood.
inline glm::vec3 wood(glm::vec2 p, const glm::vec3 &light, const glm::vec3 &dark)
{
	const float bend = 0.03f * noise(p * glm::vec2(1.5f, 4.0f));
	const float ring = 0.5f + 0.5f * std::sin(190.0f * (p.y + bend));
	return glm::mix(light, dark, 0.35f * ring * noise(p * glm::vec2(2.0f, 30.0f)) + 0.3f * noise(p * glm::vec2(6.0f, 90.0f)));
}

} // namespace arift::synthetic::paint
