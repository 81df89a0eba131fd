// The floor, the ceiling and the four walls with what hangs on them.
#include "drivers/synthetic/paint.h"
#include "drivers/synthetic/paint_base.h"

namespace arift::synthetic::paint
{

namespace
{

constexpr float floorLevel = -1.6f;

glm::vec3 plaster(glm::vec2 p, const glm::vec3 &tone) { return tone * (0.95f + 0.07f * cloud(p * 3.0f) + 0.02f * noise(p * 60.0f)); }

/// A wall in two tones with a rail between them and a skirting board.
glm::vec3 wall(glm::vec2 p, const glm::vec3 &upper, const glm::vec3 &lower)
{
	static const glm::vec3 white = colour(0xf2efe6);
	const float height = p.y - floorLevel;
	if (height < 0.11f) return white * (height > 0.095f ? 0.7f : 0.95f);
	if (std::abs(height - 0.95f) < 0.03f) return white * (height < 0.94f ? 0.75f : 0.95f);
	return plaster(p, height > 0.95f ? upper : lower * (toGrid(p.x, 0.14f) < 0.004f ? 0.8f : 1.0f));
}

/// Hills under an evening sky; `p` from 0 to 1.
glm::vec3 landscape(glm::vec2 p)
{
	glm::vec3 shade = glm::mix(colour(0xf4c27a), colour(0x4f86c6), glm::clamp((p.y - 0.35f) / 0.6f, 0.0f, 1.0f));
	if (inDisc(p * glm::vec2(1.6f, 1.0f), 1.05f, 0.66f, 0.09f)) shade = colour(0xfff1b8);
	if (p.y < 0.50f + 0.12f * std::sin(5.0f * p.x + 0.6f)) shade = colour(0x6b7fa3);
	if (p.y < 0.36f + 0.09f * std::sin(7.0f * p.x + 2.0f)) shade = colour(0x5d8a4e);
	if (p.y < 0.20f + 0.06f * std::sin(9.0f * p.x + 4.0f)) shade = colour(0x38602f);
	return shade * (0.92f + 0.12f * noise(p * 40.0f));
}

/// Coloured rectangles between black bars; `p` from 0 to 1.
glm::vec3 squares(glm::vec2 p)
{
	const auto bar = [](float x, float at) { return std::abs(x - at) < 0.018f; };
	if (bar(p.x, 0.35f) || bar(p.x, 0.8f) || bar(p.y, 0.3f) || bar(p.y, 0.72f)) return colour(0x18181a);
	if (p.x < 0.35f) return p.y < 0.3f ? colour(0x2148a8) : p.y < 0.72f ? colour(0xf3efe2) : colour(0xe9c83a);
	if (p.x < 0.8f) return p.y < 0.3f ? colour(0xf3efe2) : p.y < 0.72f ? colour(0xc0392b) : colour(0xf3efe2);
	return p.y < 0.72f ? colour(0xf3efe2) : colour(0x2148a8);
}

/// A picture in a frame with a mount around it.
template <typename Picture>
glm::vec3 framed(glm::vec2 p, float x0, float y0, float x1, float y1, const glm::vec3 &frame, Picture picture, const glm::vec3 &around)
{
	constexpr float shadow = 0.03f, rim = 0.035f, mount = 0.07f;
	if (inRect(p, x0 + rim + mount, y0 + rim + mount, x1 - rim - mount, y1 - rim - mount))
		return picture(within(p, x0 + rim + mount, y0 + rim + mount, x1 - rim - mount, y1 - rim - mount));
	if (inRect(p, x0 + rim, y0 + rim, x1 - rim, y1 - rim)) return colour(0xe9e5da);
	if (inRect(p, x0, y0, x1, y1)) return frame;
	return inRect(p, x0 - shadow, y0 - shadow, x1 + shadow, y1) ? around * 0.72f : around;
}

glm::vec3 outdoors(glm::vec2 p)
{
	glm::vec3 shade = glm::mix(colour(0xdfeefa), colour(0x8fc0ee), glm::clamp(p.y, 0.0f, 1.0f)) * 1.9f;
	shade += glm::vec3(0.5f) * std::max(0.0f, cloud(p * glm::vec2(3.0f, 6.0f)) - 0.52f);
	if (p.y < 0.30f + 0.16f * noise(p.x * glm::vec2(7.0f, 0.0f)) + 0.05f * noise(p * 28.0f))
		shade = colour(0x3f7a34) * (0.7f + 1.0f * noise(p * 34.0f));
	return shade;
}

} // namespace

glm::vec3 floorboards(glm::vec2 p)
{
	static const glm::vec3 light = colour(0xc99a62), dark = colour(0x8a5a2e);
	constexpr float width = 0.14f, length = 1.3f;
	const int row = int(std::floor(p.x / width));
	const float along = p.y + 0.61f * float(row);
	const int board = int(std::floor(along / length));
	if (toGrid(p.x, width) < 0.003f || toGrid(along, length) < 0.003f) return dark * 0.45f;
	const glm::vec3 plank = wood({p.y + 7.0f * random(row, board), p.x}, light, dark) * (0.78f + 0.34f * random(row, board));
	// a rug under and before the table
	if (!inRect(p, -1.35f, -2.45f, 1.35f, -0.55f)) return plank;
	const glm::vec2 r = within(p, -1.35f, -2.45f, 1.35f, -0.55f) * glm::vec2(2.7f, 1.9f);
	const float edge = std::min(std::min(r.x, 2.7f - r.x), std::min(r.y, 1.9f - r.y));
	const bool diamond = (fraction(r.x / 0.3f + r.y / 0.3f) < 0.5f) != (fraction(r.x / 0.3f - r.y / 0.3f) < 0.5f);
	static const glm::vec3 blue = colour(0x35507e), cream = colour(0xd9cfb4), red = colour(0x9c4238);
	const glm::vec3 woven = edge < 0.06f ? cream : edge < 0.2f ? red : edge < 0.24f ? cream : diamond ? blue : blue * 0.72f;
	return woven * (0.85f + 0.25f * noise(p * 120.0f));
}

glm::vec3 ceiling(glm::vec2 p) { return plaster(p, colour(0xefece4)) * (toGrid(p.x, 1.45f) < 0.02f ? 0.9f : 1.0f); }

glm::vec3 frontWall(glm::vec2 p)
{
	static const glm::vec3 upper = colour(0xe6dcc4), lower = colour(0x7e9a92), frame = colour(0x4a3522);
	const glm::vec3 bare = wall(p, upper, lower);
	return framed(p, 1.55f, -0.35f, 2.65f, 0.55f, frame, landscape, bare);
}

glm::vec3 backWall(glm::vec2 p)
{
	static const glm::vec3 upper = colour(0xe6dcc4), lower = colour(0x7e9a92), frame = colour(0x2b2b2e);
	return framed(p, -1.6f, -0.5f, -0.4f, 0.6f, frame, squares, wall(p, upper, lower));
}

glm::vec3 windowWall(glm::vec2 p)
{
	static const glm::vec3 upper = colour(0xe6dcc4), lower = colour(0x7e9a92), white = colour(0xf4f2ec), curtain = colour(0xb5553f);
	constexpr float x0 = -3.7f, y0 = -0.75f, x1 = -1.7f, y1 = 0.65f; // along z
	if (inRect(p, x0 - 0.35f, y1 + 0.06f, x1 + 0.35f, y1 + 0.1f)) return colour(0x5b4630);
	if (p.y < y1 + 0.06f && p.y > y0 - 0.15f && (inRect(p, x0 - 0.3f, -2, x0 + 0.12f, 2) || inRect(p, x1 - 0.12f, -2, x1 + 0.3f, 2)))
		return curtain * (0.7f + 0.3f * std::sin(75.0f * p.x + 1.5f * noise(p * 5.0f)));
	if (!inRect(p, x0, y0, x1, y1)) return inRect(p, x0 - 0.06f, y0 - 0.06f, x1 + 0.06f, y1) ? white : wall(p, upper, lower);
	const glm::vec2 pane = within(p, x0, y0, x1, y1);
	const bool isBar = toGrid(pane.x, 0.5f) < 0.022f || std::abs(pane.y - 0.62f) < 0.018f || pane.y < 0.03f || pane.y > 0.97f;
	return isBar ? white : outdoors(pane * glm::vec2(1.4f, 1.0f));
}

glm::vec3 doorWall(glm::vec2 p)
{
	static const glm::vec3 upper = colour(0xe6dcc4), lower = colour(0x7e9a92), white = colour(0xf0ece2), door = colour(0x6f8fae);
	constexpr float x0 = -4.4f, x1 = -3.5f, top = 0.45f; // along z
	if (inRect(p, x0, -2, x1, top)) {
		const glm::vec2 d = within(p, x0, floorLevel, x1, top);
		if (inDisc(p, x1 - 0.09f, -0.55f, 0.03f)) return colour(0xd8b85a);
		const auto panel = [&](float y0, float y1) {
			const bool outer = inRect(d, 0.14f, y0, 0.86f, y1), inner = inRect(d, 0.18f, y0 + 0.02f, 0.82f, y1 - 0.02f);
			return outer && !inner;
		};
		return door * (panel(0.08f, 0.42f) || panel(0.5f, 0.92f) ? 0.6f : 0.97f + 0.05f * noise(p * 25.0f));
	}
	if (inRect(p, x0 - 0.09f, -2, x1 + 0.09f, top + 0.09f)) return white;
	const glm::vec3 bare = wall(p, upper, lower);
	const glm::vec3 left = framed(p, -2.8f, -0.3f, -2.1f, 0.5f, colour(0x2b2b2e), squares, bare);
	return framed(p, -1.7f, -0.3f, -0.6f, 0.5f, colour(0x8a6a3a), landscape, left);
}

} // namespace arift::synthetic::paint
