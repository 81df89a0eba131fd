#version 450
// A unit cube without vertex buffers: six faces of two triangles, counted by gl_VertexIndex.
layout(push_constant) uniform Placement {
	mat4 clipFromModel;
	mat4 roomFromModel;
};
layout(location = 0) out vec2 uv;
layout(location = 1) out vec3 normal;

const vec2 corners[6] = vec2[](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1));

void main()
{
	const int face = gl_VertexIndex / 6;
	const float side = (face & 1) == 0 ? 1.0 : -1.0;
	uv = corners[gl_VertexIndex % 6];
	// On each face, x to the right and y up as seen from outside: the triangles are counter-clockwise.
	const vec2 p = uv - 0.5;
	vec3 position;
	if (face < 2) {
		position = vec3(side * p.x, p.y, side * 0.5);
		normal = vec3(0, 0, side);
	} else if (face < 4) {
		position = vec3(side * 0.5, p.y, -side * p.x);
		normal = vec3(side, 0, 0);
	} else {
		position = vec3(p.x, side * 0.5, -side * p.y);
		normal = vec3(0, side, 0);
	}
	normal = mat3(roomFromModel) * normal;
	gl_Position = clipFromModel * vec4(position, 1.0);
}
