// The numbers of one draw that change from image to image, shared by C++ and GLSL. Only vec4 and arrays of vec4: every layout rule of GLSL
// and C++ agree on them.
#ifndef ARIFT_PANEL_BLOCKS_H
#define ARIFT_PANEL_BLOCKS_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
namespace arift::shaders
{
using glm::vec4;
#endif

/// A 3x3 matrix that changes linearly from the first line of a band to the line after its last: columns in xyz. w is free.
struct MatrixByLine {
	vec4 first[3];
	vec4 change[3];
};

/// One eye, one band of lines. Pixels are those of the image drawn, (0, 0) its top left corner, pixel centres at +0.5, y down.
struct EyeBlock {
	vec4 lines;          ///< x: pixel row at which the band begins; y: 1 / its height; zw: pixel of the lens axis
	MatrixByLine camera; ///< (tangents, 1) -> direction in the camera's frame (x right, y down, z forward), any length; without a camera:
						 ///< in the origin's
	vec4 plane;          ///< xy: texture coordinate per texel; zw: selects red (and the first green by its complement) in the first plane
	vec4 planeOffset[2]; ///< texture coordinates of texel (0, 0): first plane's red in xy, its green in zw; second plane's green, its blue
	vec4 colour;         ///< xyz: gain by channel; w: raw value of darkness
	vec4 fill;           ///< xyz: linear light shown where no camera sees; w: how much of what is behind a layer its alpha hides
	vec4 weight;         ///< x: of the camera's image against the fill
};

/// One layer as one eye sees it, one band of lines. Push constants: just the 128 bytes that every device has.
struct LayerBlock {
	MatrixByLine uv; ///< (tangents, 1) -> (u w, v w, w) with u, v in 0..1 over the sub-image and w > 0 in front; in the free places of
					 ///< `first`: array layer; 1 where alpha counts; 1 where colour is still to be multiplied by alpha
	vec4 rect;       ///< xy: texture coordinate of the sub-image's corner; zw: its size
	vec4 inside;     ///< smallest and largest texture coordinates: the centres of the sub-image's outermost texels
};

#ifdef __cplusplus
} // namespace arift::shaders
#endif
#endif
