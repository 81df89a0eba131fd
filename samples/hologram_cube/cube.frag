#version 450
// A chequered texture without an image, lit by one lamp above (Lambert) and the light of the room.
layout(location = 0) in vec2 uv;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 colour;

const vec3 towardsLamp = normalize(vec3(0.3, 0.9, 0.5));

void main()
{
	const vec2 cell = floor(uv * 4.0);
	const vec2 toEdge = min(uv, 1.0 - uv);
	const bool border = min(toEdge.x, toEdge.y) < 0.04;
	const bool light = mod(cell.x + cell.y, 2.0) < 0.5;
	const vec3 paint = border ? vec3(0.90, 0.90, 0.92) : light ? vec3(0.05, 0.45, 0.85) : vec3(0.95, 0.45, 0.05);
	const float lambert = max(dot(normalize(normal), towardsLamp), 0.0);
	// Alpha 1: here the hologram hides the world. The colours are linear; the sRGB image encodes them.
	colour = vec4(paint * (0.25 + 0.75 * lambert), 1.0);
}
