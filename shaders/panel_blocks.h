// The numbers of one draw, shared by C++ and GLSL. Only vec4 and arrays of vec4: std140 and C++ agree on their layout.
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
	vec4 lens;            ///< xy: pixel of the lens axis; zw: lens vector per pixel (w negative: y up)
	vec4 circle;          ///< x: largest r^2 shown; y: 1 / width of its rim in r^2; z: 1 / x
	vec4 lines;           ///< x: pixel row at which the band begins; y: 1 / its height
	vec4 distortion[4];   ///< D(r^2), lowest order first
	vec4 chromatic;       ///< blue = green (x + y r^2); red = green (z + w r^2)
	vec4 redFromBlue;     ///< red's texel = green's + (blue's - green's) (x + y r^2), where red is not evaluated itself

	MatrixByLine camera;  ///< (tangents, 1) -> direction in the camera's frame (x right, y down, z forward), any length; without a camera: in the origin's
	vec4 g[4];            ///< ShaderCamera::g
	vec4 centre;          ///< xy: image centre, texels; z: cosineCentre; w: cosineScale
	vec4 affine;          ///< columns xy, zw
	vec4 tangential;      ///< x: p1, y: p2, z: xi, w: 1 / angle at the end of the table
	vec4 edge;            ///< x: cosine of the largest angle; y: 1 / fading width in cosines; z: 1 / fading width in texels; w: weight
	vec4 image;           ///< xy: width and height in texels
	vec4 plane;           ///< xy: texture coordinate per texel; zw: selects red (and the first green by its complement) in the first plane
	vec4 planeOffset[2];  ///< texture coordinates of texel (0, 0): first plane's red in xy, its green in zw; second plane's green, its blue
	vec4 colour;          ///< xyz: gain by channel; w: raw value of darkness
	vec4 fill;            ///< xyz: linear light shown where no camera sees; w: how much of what is behind a layer its alpha hides
};

/// One layer as one eye sees it, one band of lines.
struct LayerBlock {
	MatrixByLine uv;      ///< (tangents, 1) -> (u w, v w, w) with u, v in 0..1 over the sub-image and w > 0 in front
	vec4 rect;            ///< xy: texture coordinate of the sub-image's corner; zw: its size
	vec4 inside;          ///< smallest and largest texture coordinates: the centres of the sub-image's outermost texels
	vec4 mode;            ///< x: array layer; y: 1 where alpha counts; z: 1 where colour is still to be multiplied by alpha
};

#ifdef __cplusplus
} // namespace arift::shaders
#endif
#endif
