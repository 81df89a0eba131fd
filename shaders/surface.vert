#version 450
#extension GL_GOOGLE_include_directive : require
// As panel.vert, for layers that surface.frag draws.
#include "surface_block.h"

layout(constant_id = 0) const float clipPerPixelX = 1.0;
layout(constant_id = 1) const float clipPerPixelY = 1.0;
layout(constant_id = 2) const float lensVectorPerPixel = 1.0;

layout(location = 0) in ivec2 pixel;
layout(set = 0, binding = 0, std140) uniform Eye { EyeBlock eye; };
layout(set = 2, binding = 0, std140) uniform Surface { SurfaceBlock block; };

layout(location = 0) noperspective out vec2 lensVector;
layout(location = 1) noperspective out mat3 rayMatrix;
layout(location = 4) noperspective out vec3 origin;
layout(location = 5) flat out vec4 placing;
layout(location = 6) flat out vec4 bounds;
layout(location = 7) flat out vec4 colorScale;
layout(location = 8) flat out vec4 colorBias;
layout(location = 9) flat out vec4 source;
layout(location = 10) flat out vec4 kept;
layout(location = 11) flat out vec4 texels;
layout(location = 12) flat out vec4 size;
#ifdef ARIFT_DEPTH
layout(location = 13) flat out vec4 depthTexel;
layout(location = 14) flat out vec4 depthBounds;
layout(location = 15) flat out vec4 depthSearch;
#endif

void main()
{
	const vec2 position = vec2(pixel);
	gl_Position = vec4(position * vec2(clipPerPixelX, clipPerPixelY) - 1.0, 0.0, 1.0);
	const float s = (position.y - eye.lines.x) * eye.lines.y;
	lensVector = (position - eye.lines.zw) * vec2(lensVectorPerPixel, -lensVectorPerPixel);
	const vec4 x = block.ray.first[0] + s * block.ray.change[0], y = block.ray.first[1] + s * block.ray.change[1],
		one = block.ray.first[2] + s * block.ray.change[2];
	rayMatrix = mat3(x.xyz, y.xyz, one.xyz);
	origin = vec3(x.w, y.w, one.w);
	placing = block.placing;
	bounds = block.bounds;
	colorScale = block.colorScale;
	colorBias = block.colorBias;
	source = block.source;
	kept = block.kept;
	texels = block.texels;
	size = block.size;
#ifdef ARIFT_DEPTH
	depthTexel = block.depthTexel;
	depthBounds = block.depthBounds;
	depthSearch = block.depthSearch;
#endif
}
