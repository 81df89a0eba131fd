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

/// A 3x3 matrix that changes linearly from the first line of a band to the line after its last: columns in xyz.
struct MatrixByLine {
	vec4 first[3];
	vec4 change[3];
};

/// One eye, one band of lines. Pixels are those of the image drawn, (0, 0) its top left corner, pixel centres at +0.5, y down.
struct EyeBlock {
	vec4 lines;          ///< x: pixel row at which the band begins; y: 1 / its height; zw: pixel of the lens axis
	MatrixByLine camera; ///< (tangents, 1) -> direction in the camera's frame (x right, y down, z forward), any length; without a camera:
						 ///< in the origin's
	vec4 siteOffset[2];  ///< from texel to site, red in xy, green in zw; blue in xy: site = texel * siteScale.x + offset
	vec4 siteScale;      ///< x: sites per texel; y: weight of the camera's image against the fill; zw: the last site
	vec4 colour;         ///< xyz: gain by channel; w: raw value of darkness
	vec4 fill;           ///< xyz: linear light shown where no camera sees; w: how much of what is behind a layer its alpha hides
};

/// One layer as one eye sees it, one band of lines. Push constants: just the 128 bytes that every device has.
/// What else a layer has lies in the w of its matrix's columns, `first` before `change`. Keyed out: the key's colour (encoded), tolerance,
/// softness, opacity. Passthrough: 1 where there is a map; its bounds are opacity, brightness, contrast and saturation, its mode is the
/// colour of edges.
struct LayerBlock {
	MatrixByLine texel; ///< (tangents, 1) -> (x w, y w, w) with x, y texels of the image, integers at their centres, and w > 0 in front
	vec4 bounds;        ///< first and last texel of the sub-image: xy, zw
	vec4 mode;          ///< xy: texture coordinate per texel; z: 0 where alpha counts, else 1; w: 1 where colour is not yet multiplied by alpha
};

#ifdef __cplusplus
} // namespace arift::shaders
#endif
#endif
