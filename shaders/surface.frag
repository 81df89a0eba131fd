#version 450
#extension GL_GOOGLE_include_directive : require
// One pixel of a layer that is not plain: on a cylinder, a sphere or a cube, as far away as a projection view's depth says, tested for how
// far away it is, keyed out with an alpha of its own, or with scaled colour or blend factors. Over what is there, in linear light; every colour at its own place, and with its own alpha.
#include "panel_lens.glsl"
#include "surface_block.h"
#include "chroma_key.glsl"

layout(constant_id = 68) const bool keyed = false;           // a colour of the layer stands for what is behind it
layout(constant_id = 69) const int surface = 1;              // Surface (compositor/panel_inputs.h)
const int surfaceCylinder = 2, surfaceSphere = 3;
const bool curved = surface == surfaceCylinder || surface == surfaceSphere;
layout(constant_id = 70) const int depth = 0;                // Depth (compositor/pipeline_key.h)
const int depthUnused = 0, depthOutside = 2;
layout(constant_id = 71) const bool keptByAlphaBelow = false; // what is below is multiplied by its own alpha wherever something is drawn

#ifdef ARIFT_CUBE
layout(set = 1, binding = 0) uniform samplerCube layerTexture; // light: its format decodes
#else
layout(set = 1, binding = 0) uniform sampler2D layerTexture;   // values as they are stored: nothing is decoded
#endif

layout(set = 2, binding = 0, std140) uniform Surface { SurfaceBlock block; }; // for its key alone

layout(location = 0) noperspective in vec2 lensVector;       // tangents before the lens correction
layout(location = 1) noperspective in mat3 rayMatrix;        // SurfaceBlock, at this line
layout(location = 4) noperspective in vec3 origin;
layout(location = 5) flat in vec4 placing;
layout(location = 6) flat in vec4 bounds;
layout(location = 7) flat in vec4 colorScale;
layout(location = 8) flat in vec4 colorBias;
layout(location = 9) flat in vec4 source;
layout(location = 10) flat in vec4 kept;
layout(location = 11) flat in vec4 texels;
layout(location = 12) flat in vec4 size;
#ifdef ARIFT_DEPTH
layout(set = 3, binding = 0) uniform sampler2D depthTexture;
layout(location = 13) flat in vec4 depthTexel;
layout(location = 14) flat in vec4 depthBounds;
layout(location = 15) flat in vec4 depthSearch;
#endif

layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 cover;              // how much of what is there it takes away

const float turn = 6.28318530718;
/// What is nearer than this, metres, is as near as this to a depth test.
const float nearestTested = 0.01;

/// Of one kind of a texel's colour, encoded or as light; alpha as it counts.
vec4 straightened(vec4 colour, vec4 alpha) { return texels.w > 0.0 ? colour : clamp(colour / max(alpha, 1e-4), 0.0, 1.0); }

#ifdef ARIFT_CUBE
/// Premultiplied.
vec4 keyedOut(vec4 light)
{
	const vec4 alpha = vec4(mix(light.a, 1.0, texels.y)), straight = straightened(light, alpha), encoded = encodedLight(straight);
	const vec4 left = alpha * keptBy(encoded.rgb, block.key.rgb, block.key.a, size.w), keyLight = decoded(block.key);
	vec4 colour = vec4(0.0, 0.0, 0.0, left.a);
	for (int channel = 0; channel < 3; ++channel) colour[channel] = withoutKey(straight * alpha, alpha, left, keyLight[channel])[channel];
	return colour;
}

/// Colours, their alphas, and green's 1 / distance ahead of the eye.
void layerColour(Seen seen, out vec3 colour, out vec3 alpha, out vec3 there, out float nearness)
{
	const vec3 across = rayMatrix[0] * seen.tangents.x + rayMatrix[1] * seen.tangents.y;
	const float factors[3] = float[](seen.chromatic.red, 1.0, seen.chromatic.blue);
	for (int channel = 0; channel < 3; ++channel) {
		vec4 rgba = textureLod(layerTexture, rayMatrix[2] + across * factors[channel], 0.0);
		if (keyed) rgba = keyedOut(rgba);
		colour[channel] = rgba[channel];
		alpha[channel] = rgba.a;
	}
	there = vec3(1.0);
	nearness = 0.0;
}
#else
/// Where a ray meets the surface, from inside: flat: texel; else angle to the right, and angle up or height in radii. z > 0: it does.
vec3 met(vec3 ray)
{
	if (!curved) return vec3(ray.xy * (1.0 / ray.z), ray.z);
	// (origin + along ray) has the length 1, the farther of both times; for a cylinder, without its y.
	const vec3 flattened = surface == surfaceCylinder ? vec3(1.0, 0.0, 1.0) : vec3(1.0);
	const vec3 r = ray * flattened, o = origin * flattened;
	const float a = max(dot(r, r), 1e-12), b = dot(o, r), square = b * b - a * (dot(o, o) - 1.0);
	const float along = (sqrt(max(square, 0.0)) - b) / a;
	const vec3 place = origin + ray * along;
	const float up = surface == surfaceCylinder ? place.y : atan(place.y, length(place.xz));
	return vec3(atan(place.x, -place.z), up, square >= 0.0 ? along : -1.0);
}

vec2 texelOf(vec3 place) { return curved ? placing.xy + place.xy * placing.zw : place.xy; }

/// One colour of four texels, without decoding, as if it were straight and opaque, and encoded.
vec4 straightOfFour(vec2 middle, int channel, vec4 alpha)
{
	const vec4 stored = channel == 0   ? textureGather(layerTexture, middle, 0)
						: channel == 1 ? textureGather(layerTexture, middle, 1)
									   : textureGather(layerTexture, middle, 2);
	// What was multiplied was light.
	return encodedLight(straightened(mix(stored, decoded(stored), texels.x), alpha));
}

/// One colour and its alpha between the four texels around a place, after decoding them; nothing beyond the sub-image. Keyed: multiplied.
vec2 sampled(vec3 place, int channel, out float there)
{
	const vec2 texel = texelOf(place), at = within(texel, bounds.xy, bounds.zw), off = abs(texel - at);
	const vec2 base = floor(at), part = at - base, middle = (base + 1.0) * size.xy;
	vec4 value = channel == 0   ? textureGather(layerTexture, middle, 0)
				 : channel == 1 ? textureGather(layerTexture, middle, 1)
								: textureGather(layerTexture, middle, 2);
	vec4 alpha = textureGather(layerTexture, middle, 3);
	value = mix(value, decoded(value), texels.x);
	if (keyed) {
		const vec4 own = mix(alpha, vec4(1.0), texels.y);
		alpha = own * keptOfFour(straightOfFour(middle, 0, own), straightOfFour(middle, 1, own), straightOfFour(middle, 2, own), block.key, size.w);
		value = withoutKey(straightened(value, own) * own, own, alpha, decoded(block.key)[channel]);
	}
	// A little more than half a texel: a whole turn ends where it begins, whatever is rounded.
	there = place.z > 0.0 && max(off.x, off.y) <= 0.501 ? 1.0 : 0.0;
	const vec4 left = vec4(value.wx, alpha.wx), across = left + (vec4(value.zy, alpha.zy) - left) * part.x;
	return across.xz + (across.yw - across.xz) * part.y;
}

/// Red's place follows from green's and blue's as in panel.frag; angles by the shorter way round.
vec3 redOf(vec3 green, vec3 blue, float redFromBlue)
{
	vec2 apart = blue.xy - green.xy;
	if (curved) apart.x -= turn * round(apart.x / turn);
	vec2 red = green.xy + apart * redFromBlue;
	if (curved) red.x -= turn * round(red.x / turn);
	return vec3(red, green.z);
}

#ifdef ARIFT_DEPTH
/// Where a ray passes at `nearness`, 1 / distance along it.
vec3 placeAt(vec3 ray, float nearness) { return met(ray + origin * nearness); }

/// A place in the image as one in the depth image, whose texels begin at integers.
vec3 inDepthImage(vec3 place) { return vec3(place.xy * depthTexel.xy + place.z * depthTexel.zw, place.z); }

/// 1 / distance ahead of the view of what it shows at a place in the depth image. Never NaN, whatever the image holds.
float inverseAt(vec3 place)
{
	const ivec2 texel = clamp(ivec2(place.xy * (1.0 / place.z)), ivec2(depthBounds.xy), ivec2(depthBounds.zw));
	const float inverse = depthSearch.x + depthSearch.y * texelFetch(depthTexture, texel, 0).r;
	return inverse > 0.0 ? inverse : 0.0;
}

/// The nearness at which the ray would have to meet what the view shows where the ray passes, there in the depth image.
float shownNearness(vec3 place) { return place.z * min(inverseAt(place), depthSearch.z); }

/// The first thing that the ray meets, from the viewer on: between two steps it goes behind what the view shows. On a plane the chord finds
/// the very place. Where what is shown comes nearer by more than a step, an edge lies between both: either the ray meets what is behind the
/// edge, or it passes into what the view did not see. Nothing is known of that, and it shows what is beside the edge and farther away, drawn
/// out over the hole: in a hologram's view mostly nothing. `shows`: the nearness of what is shown there.
float metNearness(vec3 ray, out float shows)
{
	const int steps = int(depthSearch.w);
	const float most = depthSearch.z * max(ray.z, 0.0), apart = most / depthSearch.w;
	const vec3 from = inDepthImage(ray), along = inDepthImage(origin);
	float before = most, shownBefore = shownNearness(from + along * before), now = before, shown = shownBefore;
	shows = before;
	if (shownBefore >= before) return before; // as near as can be
	for (int step = 1; step <= steps; ++step) {
		now = most - apart * float(step);
		shown = shownNearness(from + along * now);
		if (shown >= now) break;
		before = now;
		shownBefore = shown;
	}
	const float behind = shown - now, inFront = before - shownBefore;
	if (shown - shownBefore > apart) {
		shows = shown <= before ? shown : shownBefore;
		return min(shown, before);
	}
	shows = mix(now, before, clamp(behind / max(behind + inFront, 1e-9), 0.0, 1.0));
	return shows;
}

/// What a depth test is to know of a place in the depth image where something is shown at this nearness: more than how it is moved.
float testedNearness(vec3 place, float shows)
{
	const float inverse = inverseAt(place);
	return inverse > depthSearch.z ? place.z * inverse : shows;
}

/// All colours are as far away as green: where edges move by much, red and blue have theirs a few pixels off.
void layerColour(Seen seen, out vec3 colour, out vec3 alpha, out vec3 there, out float nearness)
{
	const vec3 across = rayMatrix[0] * seen.tangents.x + rayMatrix[1] * seen.tangents.y;
	const vec3 ray = rayMatrix[2] + across;
	const float at = metNearness(ray, nearness);
	if (depth != depthUnused) nearness = testedNearness(inDepthImage(ray) + inDepthImage(origin) * at, nearness);
	const vec3 green = placeAt(ray, at), blue = placeAt(rayMatrix[2] + across * seen.chromatic.blue, at);
	const vec3 red = redItself ? placeAt(rayMatrix[2] + across * seen.chromatic.red, at) : redOf(green, blue, seen.chromatic.redFromBlue);
	const vec2 r = sampled(red, 0, there.x), g = sampled(green, 1, there.y), b = sampled(blue, 2, there.z);
	colour = vec3(r.x, g.x, b.x);
	alpha = vec3(r.y, g.y, b.y);
}
#else
void layerColour(Seen seen, out vec3 colour, out vec3 alpha, out vec3 there, out float nearness)
{
	const vec3 across = rayMatrix[0] * seen.tangents.x + rayMatrix[1] * seen.tangents.y;
	const vec3 green = met(rayMatrix[2] + across), blue = met(rayMatrix[2] + across * seen.chromatic.blue);
	const vec3 red = redItself ? met(rayMatrix[2] + across * seen.chromatic.red) : redOf(green, blue, seen.chromatic.redFromBlue);
	nearness = curved ? size.z / max(green.z, 1e-6) : green.z * origin.x;
	const vec2 r = sampled(red, 0, there.x), g = sampled(green, 1, there.y), b = sampled(blue, 2, there.z);
	colour = vec3(r.x, g.x, b.x);
	alpha = vec3(r.y, g.y, b.y);
}
#endif
#endif

void main()
{
	const Seen seen = throughTheLens(lensVector);
	vec3 colour, alpha, there;
	float nearness;
	layerColour(seen, colour, alpha, there, nearness);
	if ((depth != depthUnused || keptByAlphaBelow) && there == vec3(0.0)) discard;
	if (depth != depthUnused) {
#ifdef ARIFT_DEPTH
		const bool within = nearness >= placing.x && nearness <= placing.y;
		if (within == (depth == depthOutside)) discard;
#endif
		gl_FragDepth = clamp(nearness * nearestTested, 0.0, 1.0);
	}
	if (!keyed) alpha = mix(alpha, vec3(1.0), texels.y);
	else if (texels.w > 0.0) colour = mix(vec3(0.0), colour / max(alpha, 1e-6), greaterThan(alpha, vec3(0.0))); // as it was
	// XR_KHR_composition_layer_color_scale_bias: of straight colour, which then is what it was before, straight or not.
	const vec3 straight = texels.w > 0.0 ? colour : mix(vec3(0.0), colour / max(alpha, 1e-6), greaterThan(alpha, vec3(0.0)));
	const vec3 scaledAlpha = clamp(alpha * colorScale.a + colorBias.a, 0.0, 1.0);
	const vec3 scaled = max(straight * colorScale.rgb + colorBias.rgb, 0.0) * (texels.w > 0.0 ? vec3(1.0) : scaledAlpha);
	if (texels.z > 0.0) {
		colour = scaled;
		alpha = scaledAlpha;
	}
	const vec3 shown = there * seen.shown;
	light = vec4(colour * (source.x + source.y * alpha) * shown, alpha.g * (source.z + source.w * alpha.g) * shown.g);
	cover = vec4((1.0 - kept.x - kept.y * alpha) * shown, (1.0 - kept.z - kept.w * alpha.g) * shown.g);
}
