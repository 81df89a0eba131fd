#version 450
#extension GL_GOOGLE_include_directive : require
// Rectangles of the image, in pixels, and for their fragments the numbers of this eye, layer and line (panel.frag says what they mean).
#include "panel_blocks.h"

layout(constant_id = 0) const float clipPerPixelX = 1.0;
layout(constant_id = 1) const float clipPerPixelY = 1.0;
layout(constant_id = 2) const float lensVectorPerPixel = 1.0;

layout(location = 0) in ivec2 pixel;
layout(set = 0, binding = 0, std140) uniform Eye { EyeBlock eye; };
layout(push_constant, std430) uniform Layer { LayerBlock layer; };

layout(location = 0) noperspective out vec2 lensVector;
layout(location = 1) noperspective out mat3 cameraMatrix;
layout(location = 4) noperspective out mat3 layerMatrix;
layout(location = 7) flat out vec4 plane;
layout(location = 8) flat out vec4 planeOffset[2];
layout(location = 10) flat out vec4 colourRange;
layout(location = 11) flat out vec4 fillColour;
layout(location = 12) flat out vec4 layerRect;
layout(location = 13) flat out vec4 layerInside;
layout(location = 14) flat out vec4 mode;

mat3 atLine(MatrixByLine m, float s)
{
	return mat3(m.first[0].xyz + s * m.change[0].xyz, m.first[1].xyz + s * m.change[1].xyz, m.first[2].xyz + s * m.change[2].xyz);
}

void main()
{
	const vec2 position = vec2(pixel);
	gl_Position = vec4(position * vec2(clipPerPixelX, clipPerPixelY) - 1.0, 0.0, 1.0);
	const float s = (position.y - eye.lines.x) * eye.lines.y;
	lensVector = (position - eye.lines.zw) * vec2(lensVectorPerPixel, -lensVectorPerPixel);
	cameraMatrix = atLine(eye.camera, s);
	layerMatrix = atLine(layer.uv, s);
	plane = eye.plane;
	planeOffset = eye.planeOffset;
	colourRange = eye.colour;
	fillColour = eye.fill;
	layerRect = layer.rect;
	layerInside = layer.inside;
	mode = vec4(eye.weight.x, layer.uv.first[0].w, layer.uv.first[1].w, layer.uv.first[2].w);
}
