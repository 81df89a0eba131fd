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
layout(location = 7) flat out vec4 siteOffset[2];
layout(location = 9) flat out vec4 siteScale;
layout(location = 10) flat out vec4 colourRange;
layout(location = 11) flat out vec4 fillColour;
layout(location = 12) flat out vec4 layerBounds;
layout(location = 13) flat out vec4 layerMode;
layout(location = 14) flat out vec4 layerFurther[2];

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
	layerMatrix = atLine(layer.texel, s);
	siteOffset = eye.siteOffset;
	siteScale = eye.siteScale;
	colourRange = eye.colour;
	fillColour = eye.fill;
	layerBounds = layer.bounds;
	layerMode = layer.mode;
	layerFurther[0] = vec4(layer.texel.first[0].w, layer.texel.first[1].w, layer.texel.first[2].w, layer.texel.change[0].w);
	layerFurther[1] = vec4(layer.texel.change[1].w, layer.texel.change[2].w, 0.0, 0.0);
}
