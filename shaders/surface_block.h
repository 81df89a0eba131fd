// The numbers of one layer that panel.frag does not draw, shared by C++ and GLSL as those in panel_blocks.h.
#ifndef ARIFT_SURFACE_BLOCK_H
#define ARIFT_SURFACE_BLOCK_H

#include "panel_blocks.h"

#ifdef __cplusplus
namespace arift::shaders
{
#endif

/// One layer as one eye sees it, one band of lines.
struct SurfaceBlock {
	MatrixByLine ray; ///< (tangents, 1) -> flat: (x w, y w, w) with x, y texels of the image, integers at their centres, and w > 0 in
					  ///< front, and in the first column's w of a quad 1 / (distance ahead of the eye * w); else: direction in the layer's
					  ///< frame, as long as (tangents, -1), and in the columns' w the eye's place there, in radii
	vec4 placing;     ///< cylinder, sphere: texel straight ahead, and texels per unit to the right and up; deep: least and largest 1 / distance
					  ///< at which it is tested
	vec4 bounds;      ///< first and last texel of the sub-image: xy, zw
	vec4 colorScale, colorBias;
	vec4 source;      ///< factors of the layer's colour (x + y alpha) and of its alpha (z + w alpha)
	vec4 kept;        ///< the same of what is below it
	vec4 texels;      ///< 1 where: x: they are sRGB encoded; y: their alpha counts as 1; z: scale and bias apply; w: colour is straight
	vec4 size;        ///< xy: texture coordinate per texel; z: cylinder, sphere: 1 / radius; w: the key's softness
	vec4 key;         ///< the colour (encoded) that stands for what is behind the layer, and its tolerance
	// Deep alone, where `ray` is as of a flat layer that is infinitely far away, and its columns' w what the eye's place adds to (x w, y w,
	// w), by 1 / distance along the ray:
	vec4 depthTexel;  ///< place in the depth image, whose texels begin at integers = texel * xy + zw
	vec4 depthBounds; ///< its first and last texel: xy, zw
	vec4 depthSearch; ///< 1 / distance ahead = x + y value; z: the largest that counts; w: steps from there to 0
};

#ifdef __cplusplus
} // namespace arift::shaders
#endif
#endif
