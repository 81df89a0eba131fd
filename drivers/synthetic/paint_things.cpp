// Furniture and things.
#include "drivers/synthetic/paint.h"
#include "drivers/synthetic/paint_base.h"
#include <iterator>

namespace arift::synthetic::paint
{

namespace
{

glm::vec3 spine(int shelf, int book)
{
	static const glm::vec3 spines[] = {colour(0x8c2f2b), colour(0x2e4a6b), colour(0x3f6a45), colour(0xc7a34b), colour(0x5a3d63),
									   colour(0xd8d0bd), colour(0x2a2a2c), colour(0xb4632f), colour(0x6f8b93)};
	return spines[size_t(random(shelf, book) * float(std::size(spines)))];
}

} // namespace

glm::vec3 oak(glm::vec2 p)
{
	static const glm::vec3 light = colour(0xd8b27c), dark = colour(0x9a6e3c);
	return wood(p, light, dark);
}

glm::vec3 walnut(glm::vec2 p)
{
	static const glm::vec3 light = colour(0x7d5636), dark = colour(0x40281a);
	return wood(p, light, dark);
}

glm::vec3 bookshelf(glm::vec2 p)
{
	constexpr float pitch = 0.38f, board = 0.03f, bottom = -1.6f;
	const float height = p.y - bottom;
	const int shelf = int(std::floor(height / pitch));
	const float above = height - float(shelf) * pitch;
	if (above < board || toGrid(p.x + 1.6f, 0.6f) < 0.015f || p.x < -2.17f || p.x > -1.03f) return walnut(p);
	const float stretch = 0.022f + 0.020f * random(shelf, 99);
	const int book = int(std::floor(p.x / stretch));
	const float tall = 0.20f + 0.11f * random(book, shelf);
	const bool isGap = random(book / 5, shelf + 40) < 0.12f;
	if (isGap || above > board + tall) return colour(0x2a1c12) * (0.6f + 0.4f * above / pitch);
	const float across = fraction(p.x / stretch);
	const glm::vec3 cloth = spine(shelf, book) * (0.55f + 0.9f * across * (1 - across) * 2);
	const float up = (above - board) / tall;
	return (up > 0.76f && up < 0.83f) || (up > 0.2f && up < 0.23f) ? glm::mix(cloth, colour(0xe8d9a8), 0.6f) : cloth;
}

glm::vec3 drawers(glm::vec2 p)
{
	const float x = toGrid(p.x - 0.5f, 0.8f), y = toGrid(p.y + 1.6f, 0.275f);
	if (x < 0.008f || y < 0.008f) return colour(0x1d120b);
	const float knobX = toGrid(p.x - 0.1f, 0.8f), knobY = toGrid(p.y + 1.4625f, 0.275f);
	if (knobX * knobX + knobY * knobY < 0.022f * 0.022f) return colour(0xd2c28f);
	return walnut(p);
}

glm::vec3 television(glm::vec2 p)
{
	if (!inRect(p, 0.03f, -0.97f, 0.97f, -0.43f)) return colour(0x141416);
	const glm::vec2 s = within(p, 0.03f, -0.97f, 0.97f, -0.43f);
	glm::vec3 picture = glm::mix(colour(0x1b6fae), colour(0x9fd3f0), 1 - s.y);
	if (s.y < 0.35f) picture = colour(0x2f8f4a) * (toGrid(s.x, 0.25f) < 0.125f ? 1.0f : 0.85f);
	if (inDisc(s * glm::vec2(1.74f, 1.0f), 0.9f, 0.45f, 0.13f)) picture = colour(0xf5f5f0);
	if (inDisc(s * glm::vec2(1.74f, 1.0f), 0.9f, 0.45f, 0.045f)) picture = colour(0x202022);
	return picture * 1.2f;
}

glm::vec3 sofaCloth(glm::vec2 p)
{
	static const glm::vec3 cloth = colour(0x4d6a7c);
	const float seam = toGrid(p.x + 2.3f, 0.667f) < 0.012f ? 0.55f : 1.0f;
	return cloth * seam * (0.8f + 0.3f * noise(p * 90.0f) + 0.1f * cloud(p * 6.0f));
}

glm::vec3 cushion(glm::vec2 p)
{
	static const glm::vec3 yellow = colour(0xd9a93a), brown = colour(0x8c5a24);
	return glm::mix(yellow, brown, toGrid(p.x + p.y, 0.08f) < 0.012f ? 1.0f : 0.2f * noise(p * 60.0f));
}

glm::vec3 leaves(glm::vec2 p)
{
	static const glm::vec3 dark = colour(0x17381a), light = colour(0x5f9a45);
	const glm::vec2 cell = p * glm::vec2(11.0f, 8.0f) + 0.8f * glm::vec2(noise(p * 9.0f), noise(p * 9.0f + 40.0f));
	const glm::vec2 centre{fraction(cell.x) - 0.5f, fraction(cell.y) - 0.5f};
	const float leaf = 1 - std::min(1.0f, glm::length(centre * glm::vec2(1.9f, 1.1f)) * 1.7f);
	const float vein = std::abs(centre.x) < 0.03f ? 0.8f : 1.0f;
	return glm::mix(dark, light * (0.6f + 0.8f * random(int(std::floor(cell.x)), int(std::floor(cell.y)))), leaf) * vein;
}

glm::vec3 clay(glm::vec2 p) { return colour(0xb5653f) * (0.85f + 0.2f * noise(p * 30.0f)) * (p.y > -1.29f ? 1.1f : 0.95f); }
glm::vec3 metal(glm::vec2 p) { return colour(0x8a8f94) * (0.9f + 0.2f * noise(p * glm::vec2(200.0f, 3.0f))); }
glm::vec3 lamp(glm::vec2) { return {4.0f, 3.9f, 3.6f}; }

glm::vec3 bookCover(glm::vec2 p)
{
	const glm::vec2 s = within(p, -0.55f, -1.75f, -0.3f, -1.5f);
	if (inRect(s, 0.15f, 0.55f, 0.85f, 0.8f)) return fraction(s.y * 18) < 0.45f && s.x < 0.75f ? colour(0x28324a) : colour(0xefe7cf);
	return inDisc(s, 0.5f, 0.3f, 0.14f) ? colour(0xe3b341) : colour(0x35587e) * (0.9f + 0.15f * noise(p * 80.0f));
}

glm::vec3 pages(glm::vec2 p)
{
	const int book = int(std::floor((p.y + 0.86f) / 0.027f));
	const float within = fraction((p.y + 0.86f) / 0.027f);
	const glm::vec3 cover = book == 0 ? colour(0x8c2f2b) : book == 1 ? colour(0x3f6a45) : colour(0x35587e);
	return within < 0.16f || within > 0.84f ? cover : colour(0xe8e0cc) * (0.8f + 0.2f * noise({p.x * 3.0f, p.y * 900.0f}));
}

glm::vec3 radio(glm::vec2 p)
{
	const glm::vec2 s = within(p, 0.3f, -0.86f, 0.62f, -0.68f);
	const glm::vec2 inCircle = s * glm::vec2(1.78f, 1.0f);
	if (inDisc(inCircle, 0.45f, 0.5f, 0.36f)) {
		const bool hole = glm::length(glm::vec2(toGrid(p.x, 0.012f), toGrid(p.y, 0.012f))) < 0.0042f;
		return hole ? colour(0x17130f) : colour(0xb9a27a);
	}
	if (inRect(s, 0.55f, 0.62f, 0.93f, 0.86f))
		return toGrid(s.x, 0.06f) < 0.006f ? colour(0x202020) : s.x > 0.72f && s.x < 0.735f ? colour(0xd03020) : colour(0xf3e6b8);
	if (inDisc(inCircle, 1.1f, 0.32f, 0.13f) || inDisc(inCircle, 1.5f, 0.32f, 0.13f)) return colour(0xd9d4c6);
	return colour(0x9c3b2e) * (0.92f + 0.12f * noise(p * 40.0f));
}

glm::vec3 mug(glm::vec2 p)
{
	const float height = (p.y + 0.86f) / 0.1f;
	if (height > 0.35f && height < 0.65f) return toGrid(p.x, 0.02f) < 0.004f ? colour(0xf5f2ea) : colour(0x2f7fb5);
	return colour(0xf5f2ea);
}

glm::vec3 colourCube(glm::vec2 p)
{
	static const glm::vec3 faces[] = {colour(0xe8e8e0), colour(0xd7b419), colour(0x1f8a3c),
									  colour(0x1d57b5), colour(0xc8501c), colour(0xb02020)};
	constexpr float pitch = 0.08f / 3;
	// the cube's own corner, whichever face this is
	const glm::vec2 q = (p + glm::vec2(0.32f, 0.25f)) / pitch;
	if (toGrid(q.x, 1) < 0.07f || toGrid(q.y, 1) < 0.07f) return colour(0x101010);
	return faces[size_t(random(int(std::floor(q.x)) + 5, int(std::floor(q.y)) - 3) * 6)];
}

glm::vec3 stoolSeat(glm::vec2 p)
{
	const glm::vec2 s = within(p, 0.9f, -1.3f, 1.25f, -0.95f) - 0.5f;
	const float r = glm::length(s);
	return r < 0.46f ? (fraction(r * 9) < 0.5f ? colour(0xc7d3c4) : colour(0x7d9a86)) : oak(p);
}

} // namespace arift::synthetic::paint
