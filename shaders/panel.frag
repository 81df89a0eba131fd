#version 450
#extension GL_GOOGLE_include_directive : require
// One pixel: lens -> tangents per colour -> camera texel and layer texel at this line's pose -> blended in linear light.
// Written for a software renderer as much as for a GPU: what costs there is the length of the chain of dependent operations, functions that
// sample float textures or encoded ones, and every fetch from memory.

#include "panel_lens.glsl"

layout(constant_id = 67) const int look = 0;                 // Look (compositor/pipeline_key.h) of the cameras' image
layout(constant_id = 68) const bool keyed = false;           // a colour of the layer stands for what is behind it

const int coverNone = 0, coverPartly = 1, coverFully = 2, coverOpaque = 3;
const int lookBackdrop = 0, lookFaded = 1, lookStyled = 2;
const int backgroundNone = 0, backgroundPattern = 1, backgroundCamera = 2, backgroundUnseen = 3;

layout(set = 0, binding = 1) uniform sampler2D sites;        // CameraImages: each texel the four neighbours that a place lies between
layout(set = 0, binding = 2) uniform sampler2D angleTable;
layout(set = 1, binding = 0) uniform sampler2D layerTexture; // values as they are stored: nothing is decoded

layout(location = 0) noperspective in vec2 lensVector;       // tangents before the lens correction
layout(location = 1) noperspective in mat3 cameraMatrix;     // at this line: EyeBlock, LayerBlock
layout(location = 4) noperspective in mat3 layerMatrix;
layout(location = 7) flat in vec4 siteOffset[2];
layout(location = 9) flat in vec4 siteScale;
layout(location = 10) flat in vec4 colourRange;
layout(location = 11) flat in vec4 fillColour;
layout(location = 12) flat in vec4 layerBounds;
layout(location = 13) flat in vec4 layerMode;
layout(location = 14) flat in vec4 layerFurther[2];

layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 cover;              // for blending over what is there already

#include "chroma_key.glsl"
#include "passthrough.glsl"

// ---- camera

float radial(float cosine)
{
	if (cameraCoefficients == 0) {
		const float at = acos(clamp(cosine, -1.0, 1.0)) * tableScale;
		const float last = float(textureSize(angleTable, 0).x) - 1.0;
		return textureLod(angleTable, vec2((at * last + 0.5) / (last + 1.0), 0.5), 0.0).r;
	}
	const float x = (cosine - cosineCentre) * cosineScale, square = x * x, fourth = square * square;
	return ARIFT_POLYNOMIAL(x, square, fourth, g, cameraCoefficients);
}

/// ShaderCamera (optics/camera_model.h): texel of a direction, integers at texel centres.
vec2 texelOf(vec3 q, out float cosine)
{
	const float inverseLength = inversesqrt(dot(q, q));
	cosine = q.z * inverseLength;
	vec2 m = q.xy * (inverseLength * radial(max(cosine, leastCosine)));
	if (tangentialDistortion) {
		const vec2 t = q.xy / max(q.z + xi / inverseLength, 1e-6);
		const float r2 = dot(t, t), both = 2.0 * t.x * t.y;
		m += vec2(p1 * both + p2 * (r2 + 2.0 * t.x * t.x),
			p1 * (r2 + 2.0 * t.y * t.y) + p2 * both);
	}
	return vec2(centreX, centreY) + vec2(affineXx, affineXy) * m.x + vec2(affineYx, affineYy) * m.y;
}

/// 1 where the camera sees well, soft towards the edge of its image and of its lens.
float seen(vec2 texel, float cosine)
{
	const vec2 inside = min(texel + 0.5, vec2(imageWidth, imageHeight) - 0.5 - texel);
	const float toBorder = clamp(min(inside.x, inside.y) * texelFade, 0.0, 1.0);
	const float fade = toBorder * clamp((cosine - leastCosine) * cosineFade, 0.0, 1.0);
	return fade * fade * (3.0 - 2.0 * fade) * siteScale.y;
}

/// Every colour at its texel: between the four pixels of its lattice around it, which are one site. Beyond the image's edge, where nothing
/// is seen, whatever it is. All places first, then all fetches: they are on their way together.
vec3 rawColour(vec2 red, vec2 green, vec2 blue)
{
	const vec2 r = red * siteScale.x + siteOffset[0].xy, g = green * siteScale.x + siteOffset[0].zw, b = blue * siteScale.x + siteOffset[1].xy;
	const vec2 rBase = floor(r), gBase = floor(g), bBase = floor(b);
	const vec4 rFour = texelFetch(sites, ivec2(clamp(rBase, vec2(0.0), siteScale.zw)), 0);
	const vec4 gFour = texelFetch(sites, ivec2(clamp(gBase, vec2(0.0), siteScale.zw)), 0);
	const vec4 bFour = texelFetch(sites, ivec2(clamp(bBase, vec2(0.0), siteScale.zw)), 0);
	const vec2 rPart = r - rBase, gPart = g - gBase, bPart = b - bBase;
	const vec3 x = vec3(rPart.x, gPart.x, bPart.x), y = vec3(rPart.y, gPart.y, bPart.y);
	const vec3 upper = vec3(rFour.x, gFour.x, bFour.x) + (vec3(rFour.y, gFour.y, bFour.y) - vec3(rFour.x, gFour.x, bFour.x)) * x;
	const vec3 lower = vec3(rFour.z, gFour.z, bFour.z) + (vec3(rFour.w, gFour.w, bFour.w) - vec3(rFour.z, gFour.z, bFour.z)) * x;
	return upper + (lower - upper) * y;
}

/// At a texel, in the cameras' image as it was taken.
float edgeAt(vec2 green)
{
	const vec2 base = floor(green * siteScale.x + siteOffset[0].zw);
	const vec4 four = (texelFetch(sites, ivec2(clamp(base, vec2(0.0), siteScale.zw)), 0) - colourRange.w) * colourRange.y;
	return edgeOf(encoded ? four : encodedLight(four));
}

float edge = 0.0; // what behindLayers finds of one, where the look has edges

vec3 behindLayers(vec2 tangents, Chromatic chromatic, float r2)
{
	if (background == backgroundNone) return vec3(0.0);
	// The fill darkens towards the rim, so that the field of view has no hard frame.
	const vec3 fill = fillColour.rgb * (1.0 - 0.6 * r2 * fillScale);
	if (background == backgroundUnseen) return fill;
	const vec3 across = cameraMatrix[0] * tangents.x + cameraMatrix[1] * tangents.y;
	const vec3 q = cameraMatrix[2] + across;
	if (background == backgroundPattern) {
		const float up = q.y * inversesqrt(dot(q, q));
		return fill * (1.0 + 0.5 * up + 0.6 * exp2(-900.0 * up * up));
	}
	float cosine, unused;
	const vec2 green = texelOf(q, cosine);
	const vec2 blue = texelOf(cameraMatrix[2] + across * chromatic.blue, unused);
	const vec2 red = redItself ? texelOf(cameraMatrix[2] + across * chromatic.red, unused) : green + (blue - green) * chromatic.redFromBlue;
	vec3 colour = rawColour(red, green, blue);
	if (encoded) colour = decoded(vec4(colour, 0.0)).rgb;
	if (look == lookStyled) edge = edgeAt(green) * seen(green, cosine);
	return mix(fill, max((colour - colourRange.w) * colourRange.xyz, 0.0), seen(green, cosine));
}

// ---- layer

/// How much of each of four texels the key leaves.
vec4 keptOf(vec2 middle)
{
	vec4 red = textureGather(layerTexture, middle, 0), green = textureGather(layerTexture, middle, 1);
	vec4 blue = textureGather(layerTexture, middle, 2);
	if (!layerEncoded) {
		red = encodedLight(red);
		green = encodedLight(green);
		blue = encodedLight(blue);
	}
	return keptOfFour(red, green, blue, layerFurther[0], layerFurther[1].x);
}

/// Light and cover of one colour at a texel (integers at texel centres): between the four texels around it, after decoding them.
vec2 layerTexel(vec2 texel, float w, int channel)
{
	const vec2 at = layerCover == coverPartly ? within(texel, layerBounds.xy, layerBounds.zw) : texel;
	const vec2 base = floor(at), part = at - base;
	// In the very middle of the four, so that no rounding chooses others.
	const vec2 middle = (base + 1.0) * layerMode.xy;
	vec4 value = channel == 0   ? textureGather(layerTexture, middle, 0)
				 : channel == 1 ? textureGather(layerTexture, middle, 1)
								: textureGather(layerTexture, middle, 2);
	vec4 alpha = textureGather(layerTexture, middle, 3);
	if (keyed) alpha = keptOf(middle);
	if (layerEncoded) value = decoded(value);
	if (keyed) value = withoutKey(value, vec4(1.0), alpha, decoded(layerFurther[0])[channel]) * layerFurther[1].y;
	if (keyed) alpha *= layerFurther[1].y;
	if (layerCover == coverOpaque) {
		const vec2 across = value.wx + (value.zy - value.wx) * part.x;
		return vec2(across.x + (across.y - across.x) * part.y, 1.0);
	}
	const vec4 left = vec4(value.wx, alpha.wx), right = vec4(value.zy, alpha.zy);
	const vec4 across = left + (right - left) * part.x;
	const vec2 between = across.xz + (across.yw - across.xz) * part.y;
	if (layerCover == coverFully) return between;
	const vec2 off = abs(texel - at);
	return w > 0.0 && max(off.x, off.y) <= 0.5 ? vec2(between.x, min(between.y + layerMode.z, 1.0)) : vec2(0.0);
}

/// Light of the layer, premultiplied, and how much it covers, per colour.
void layerLight(vec2 tangents, Chromatic chromatic, out vec3 colour, out vec3 alpha)
{
	const vec3 across = layerMatrix[0] * tangents.x + layerMatrix[1] * tangents.y;
	const vec3 green = layerMatrix[2] + across, blue = layerMatrix[2] + across * chromatic.blue;
	const vec2 greenTexel = green.xy * (1.0 / green.z), blueTexel = blue.xy * (1.0 / blue.z);
	vec2 redTexel = greenTexel + (blueTexel - greenTexel) * chromatic.redFromBlue;
	if (redItself) {
		const vec3 red = layerMatrix[2] + across * chromatic.red;
		redTexel = red.xy * (1.0 / red.z);
	}
	const vec2 r = layerTexel(redTexel, green.z, 0), g = layerTexel(greenTexel, green.z, 1), b = layerTexel(blueTexel, green.z, 2);
	alpha = vec3(r.y, g.y, b.y);
	if (layerCover == coverOpaque) {
		colour = vec3(r.x, g.x, b.x);
		return;
	}
	// layerMode.w: how much of its alpha the colour has still to be multiplied by.
	colour = vec3(r.x, g.x, b.x) * (1.0 + layerMode.w * (alpha - 1.0));
}

// ---- passthrough layer

/// Premultiplied light of the cameras' image in the layer's style, and how much it covers.
vec4 styled(vec3 colour)
{
	if (look == lookFaded) return vec4(colour, 1.0) * layerBounds.x;
	const float grey = clamp(encodedLight(vec4(dot(colour, luma709))).x, 0.0, 1.0);
	const vec4 map = textureLod(layerTexture, vec2((grey * 255.0 + 0.5) / 256.0, 0.5), 0.0);
	const float mapped = layerFurther[0].x, opacity = layerBounds.x * mix(1.0, map.a, mapped);
	const vec3 picture = mix(adjusted(colour, layerBounds.y, layerBounds.z, layerBounds.w), decoded(map).rgb, mapped);
	return mix(vec4(picture, 1.0) * opacity, vec4(layerMode.rgb, 1.0), edge * layerMode.a);
}

void main()
{
	const Seen place = throughTheLens(lensVector);
	vec3 colour = behindLayers(place.tangents, place.chromatic, place.r2), alpha = vec3(0.0);
	if (look != lookBackdrop) {
		const vec4 layer = styled(colour);
		colour = layer.rgb;
		alpha = vec3(layer.a);
	}
	if (layerCover != coverNone) {
		vec3 layerColour;
		layerLight(place.tangents, place.chromatic, layerColour, alpha);
		colour = layerCover == coverOpaque ? layerColour : colour * (1.0 - alpha * fillColour.w) + layerColour;
	}
	light = vec4(colour * place.shown, 1.0);
	cover = vec4(alpha * place.shown, 1.0);
}
