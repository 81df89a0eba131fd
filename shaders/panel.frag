#version 450
#extension GL_GOOGLE_include_directive : require
// One pixel: lens -> tangents per colour -> camera texel and layer texel at this line's pose -> blended in linear light.
#include "panel_blocks.h"

layout(constant_id = 0) const int distortionCoefficients = 16;
layout(constant_id = 1) const int cameraCoefficients = 16;   // 0: the table
layout(constant_id = 2) const bool tangentialDistortion = false;
layout(constant_id = 3) const int background = 0;
layout(constant_id = 4) const bool encoded = false;          // camera values are sRGB encoded
layout(constant_id = 5) const bool hasLayer = false;
layout(constant_id = 6) const bool throughLens = true;       // false: the eye's image before the lens correction
layout(constant_id = 7) const bool redItself = false;        // red is evaluated, not derived from green and blue

const int backgroundNone = 0, backgroundPattern = 1, backgroundGrey = 2, backgroundBayer = 3;

layout(set = 0, binding = 0, std140) uniform Eye { EyeBlock eye; };
layout(set = 0, binding = 1) uniform sampler2D firstPlane;   // grey, or the half plane with red
layout(set = 0, binding = 2) uniform sampler2D secondPlane;  // the half plane with blue
layout(set = 0, binding = 3) uniform sampler2D angleTable;
layout(set = 1, binding = 0, std140) uniform Layer { LayerBlock layer; };
layout(set = 1, binding = 1) uniform sampler2DArray layerTexture;

layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 cover;              // for blending over what is there already

// Horner's rule over 16 coefficients in four vectors, written out: a loop over them would cost a software renderer an address per step.
#define ARIFT_TERM(sum, x, values, count, i) if (count > (i)) sum = sum * x + values[(i) / 4][(i) % 4];
#define ARIFT_FOUR_TERMS(sum, x, values, count, i) \
	ARIFT_TERM(sum, x, values, count, i + 3) ARIFT_TERM(sum, x, values, count, i + 2) \
	ARIFT_TERM(sum, x, values, count, i + 1) ARIFT_TERM(sum, x, values, count, i)
#define ARIFT_POLYNOMIAL(sum, x, values, count) \
	ARIFT_FOUR_TERMS(sum, x, values, count, 12) ARIFT_FOUR_TERMS(sum, x, values, count, 8) \
	ARIFT_FOUR_TERMS(sum, x, values, count, 4) ARIFT_FOUR_TERMS(sum, x, values, count, 0)

float stretch(float r2)
{
	float d = 0.0;
	ARIFT_POLYNOMIAL(d, r2, eye.distortion, distortionCoefficients)
	return d;
}

/// How each colour's tangents compare with green's, and how red's texel follows from green's and blue's.
struct Chromatic { float red, blue, redFromBlue; };

#define ARIFT_AT_LINE(m, s) \
	mat3(m.first[0].xyz + s * m.change[0].xyz, m.first[1].xyz + s * m.change[1].xyz, m.first[2].xyz + s * m.change[2].xyz)

// ---- camera

float radial(float cosine)
{
	if (cameraCoefficients == 0) {
		const float at = acos(clamp(cosine, -1.0, 1.0)) * eye.tangential.w;
		const float last = float(textureSize(angleTable, 0).x) - 1.0;
		return textureLod(angleTable, vec2((at * last + 0.5) / (last + 1.0), 0.5), 0.0).r;
	}
	const float x = (cosine - eye.centre.z) * eye.centre.w;
	float g = 0.0;
	ARIFT_POLYNOMIAL(g, x, eye.g, cameraCoefficients)
	return g;
}

/// ShaderCamera (optics/camera_model.h): texel of a direction, integers at texel centres.
vec2 texelOf(vec3 q, out float cosine)
{
	const float inverseLength = inversesqrt(dot(q, q));
	cosine = q.z * inverseLength;
	vec2 m = q.xy * (inverseLength * radial(max(cosine, eye.edge.x)));
	if (tangentialDistortion) {
		const vec2 t = q.xy / max(q.z + eye.tangential.z / inverseLength, 1e-6);
		const float r2 = dot(t, t), both = 2.0 * t.x * t.y;
		m += vec2(eye.tangential.x * both + eye.tangential.y * (r2 + 2.0 * t.x * t.x),
			eye.tangential.x * (r2 + 2.0 * t.y * t.y) + eye.tangential.y * both);
	}
	return eye.centre.xy + eye.affine.xy * m.x + eye.affine.zw * m.y;
}

/// 1 where the camera sees well, soft towards the edge of its image and of its lens.
float seen(vec2 texel, float cosine)
{
	const vec2 inside = min(texel + 0.5, eye.image.xy - 0.5 - texel);
	const float toBorder = clamp(min(inside.x, inside.y) * eye.edge.z, 0.0, 1.0);
	const float fade = toBorder * clamp((cosine - eye.edge.x) * eye.edge.y, 0.0, 1.0);
	return fade * fade * (3.0 - 2.0 * fade) * eye.edge.w;
}

vec3 rawColour(vec2 red, vec2 green, vec2 blue)
{
	const vec2 perTexel = eye.plane.xy;
	if (background == backgroundGrey) {
		const vec2 offset = eye.planeOffset[0].xy;
		return vec3(textureLod(firstPlane, red * perTexel + offset, 0.0).r, textureLod(firstPlane, green * perTexel + offset, 0.0).r,
			textureLod(firstPlane, blue * perTexel + offset, 0.0).r);
	}
	const vec2 isRed = eye.plane.zw, isGreen = eye.plane.wz;
	const vec2 r = textureLod(firstPlane, red * perTexel + eye.planeOffset[0].xy, 0.0).rg;
	const vec2 g1 = textureLod(firstPlane, green * perTexel + eye.planeOffset[0].zw, 0.0).rg;
	const vec2 g2 = textureLod(secondPlane, green * perTexel + eye.planeOffset[1].xy, 0.0).rg;
	const vec2 b = textureLod(secondPlane, blue * perTexel + eye.planeOffset[1].zw, 0.0).rg;
	// In the plane with blue, blue lies where the other one has green.
	return vec3(dot(r, isRed), 0.5 * (dot(g1, isGreen) + dot(g2, isRed)), dot(b, isGreen));
}

vec3 decoded(vec3 value)
{
	if (!encoded) return value;
	return mix(value / 12.92, pow((max(value, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(value, vec3(0.04045)));
}

vec3 behindLayers(vec2 tangents, Chromatic chromatic, float s, float r2)
{
	if (background == backgroundNone) return vec3(0.0);
	// The fill darkens towards the rim, so that the field of view has no hard frame.
	const vec3 fill = eye.fill.rgb * (1.0 - 0.6 * r2 * eye.circle.z);
	const mat3 m = ARIFT_AT_LINE(eye.camera, s);
	const vec3 across = m[0] * tangents.x + m[1] * tangents.y;
	const vec3 q = m[2] + across;
	if (background == backgroundPattern) {
		const float up = q.y * inversesqrt(dot(q, q));
		return fill * (1.0 + 0.5 * up + 0.6 * exp2(-900.0 * up * up));
	}
	float cosine, unused;
	const vec2 green = texelOf(q, cosine);
	const vec2 blue = texelOf(m[2] + across * chromatic.blue, unused);
	const vec2 red = redItself ? texelOf(m[2] + across * chromatic.red, unused) : green + (blue - green) * chromatic.redFromBlue;
	const vec3 colour = max((decoded(rawColour(red, green, blue)) - eye.colour.w) * eye.colour.xyz, 0.0);
	return mix(fill, colour, seen(green, cosine));
}

// ---- layer

vec4 layerTexel(vec2 uv, float w)
{
	const vec2 at = clamp(layer.rect.xy + uv * layer.rect.zw, layer.inside.xy, layer.inside.zw);
	const vec2 far = abs(uv - 0.5);
	const float inside = w > 0.0 && max(far.x, far.y) <= 0.5 ? 1.0 : 0.0;
	return textureLod(layerTexture, vec3(at, layer.mode.x), 0.0) * inside + vec4(0.0, 0.0, 0.0, (1.0 - layer.mode.y) * 2.0 * inside);
}

/// Light of the layer, premultiplied, and how much it covers, per colour.
void layerLight(vec2 tangents, Chromatic chromatic, float s, out vec3 colour, out vec3 alpha)
{
	const mat3 m = ARIFT_AT_LINE(layer.uv, s);
	const vec3 across = m[0] * tangents.x + m[1] * tangents.y;
	const vec3 green = m[2] + across, blue = m[2] + across * chromatic.blue;
	const vec2 greenUv = green.xy / green.z, blueUv = blue.xy / blue.z;
	vec2 redUv = greenUv + (blueUv - greenUv) * chromatic.redFromBlue;
	if (redItself) {
		const vec3 red = m[2] + across * chromatic.red;
		redUv = red.xy / red.z;
	}
	const vec4 r = layerTexel(redUv, green.z), g = layerTexel(greenUv, green.z), b = layerTexel(blueUv, green.z);
	alpha = clamp(vec3(r.a, g.a, b.a), 0.0, 1.0);
	colour = vec3(r.r, g.g, b.b) * (layer.mode.z > 0.0 ? alpha : vec3(1.0));
}

void main()
{
	const vec2 lensVector = (gl_FragCoord.xy - eye.lens.xy) * eye.lens.zw;
	const float s = (gl_FragCoord.y - eye.lines.x) * eye.lines.y;
	const float r2 = dot(lensVector, lensVector);
	Chromatic chromatic = Chromatic(1.0, 1.0, 0.0);
	vec2 tangents = lensVector;
	float shown = 1.0;
	if (throughLens) {
		shown = clamp(1.0 - (r2 - eye.circle.x) * eye.circle.y, 0.0, 1.0);
		const float r2Shown = min(r2, eye.circle.x);
		tangents *= stretch(r2Shown);
		chromatic = Chromatic(eye.chromatic.z + eye.chromatic.w * r2Shown, eye.chromatic.x + eye.chromatic.y * r2Shown,
			eye.redFromBlue.x + eye.redFromBlue.y * r2Shown);
	}
	vec3 colour = behindLayers(tangents, chromatic, s, r2), alpha = vec3(0.0);
	if (hasLayer) {
		vec3 layerColour;
		layerLight(tangents, chromatic, s, layerColour, alpha);
		colour = colour * (1.0 - alpha * eye.fill.w) + layerColour;
	}
	light = vec4(colour * shown, 1.0);
	cover = vec4(alpha * shown, 1.0);
}
