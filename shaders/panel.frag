#version 450
// One pixel: lens -> tangents per colour -> camera texel and layer texel at this line's pose -> blended in linear light.

layout(constant_id = 0) const int distortionCoefficients = 16;
layout(constant_id = 1) const int cameraCoefficients = 16;   // 0: the table
layout(constant_id = 2) const bool tangentialDistortion = false;
layout(constant_id = 3) const int background = 0;
layout(constant_id = 4) const bool encoded = false;          // camera values are sRGB encoded
layout(constant_id = 5) const bool hasLayer = false;
layout(constant_id = 6) const bool throughLens = true;       // false: the eye's image before the lens correction
layout(constant_id = 7) const bool redItself = false;        // red is evaluated, not derived from green and blue

// What the Rig decides is constant too. What changes from image to image comes from the vertices: a software renderer gathers every number
// that a fragment reads from a block, pixel by pixel.
#define ARIFT_NUMBER(id, name) layout(constant_id = id) const float name = 0.0;
ARIFT_NUMBER(8, d0) ARIFT_NUMBER(9, d1) ARIFT_NUMBER(10, d2) ARIFT_NUMBER(11, d3)
ARIFT_NUMBER(12, d4) ARIFT_NUMBER(13, d5) ARIFT_NUMBER(14, d6) ARIFT_NUMBER(15, d7)
ARIFT_NUMBER(16, d8) ARIFT_NUMBER(17, d9) ARIFT_NUMBER(18, d10) ARIFT_NUMBER(19, d11)
ARIFT_NUMBER(20, d12) ARIFT_NUMBER(21, d13) ARIFT_NUMBER(22, d14) ARIFT_NUMBER(23, d15)
ARIFT_NUMBER(24, largestR2) ARIFT_NUMBER(25, rimScale) ARIFT_NUMBER(26, fillScale)
ARIFT_NUMBER(27, blue0) ARIFT_NUMBER(28, blue1) ARIFT_NUMBER(29, red0) ARIFT_NUMBER(30, red1)
ARIFT_NUMBER(31, redFromBlue0) ARIFT_NUMBER(32, redFromBlue1) ARIFT_NUMBER(33, g0) ARIFT_NUMBER(34, g1)
ARIFT_NUMBER(35, g2) ARIFT_NUMBER(36, g3) ARIFT_NUMBER(37, g4) ARIFT_NUMBER(38, g5)
ARIFT_NUMBER(39, g6) ARIFT_NUMBER(40, g7) ARIFT_NUMBER(41, g8) ARIFT_NUMBER(42, g9)
ARIFT_NUMBER(43, g10) ARIFT_NUMBER(44, g11) ARIFT_NUMBER(45, g12) ARIFT_NUMBER(46, g13)
ARIFT_NUMBER(47, g14) ARIFT_NUMBER(48, g15) ARIFT_NUMBER(49, centreX) ARIFT_NUMBER(50, centreY)
ARIFT_NUMBER(51, cosineCentre) ARIFT_NUMBER(52, cosineScale) ARIFT_NUMBER(53, affineXx) ARIFT_NUMBER(54, affineXy)
ARIFT_NUMBER(55, affineYx) ARIFT_NUMBER(56, affineYy) ARIFT_NUMBER(57, p1) ARIFT_NUMBER(58, p2)
ARIFT_NUMBER(59, xi) ARIFT_NUMBER(60, tableScale) ARIFT_NUMBER(61, leastCosine) ARIFT_NUMBER(62, cosineFade)
ARIFT_NUMBER(63, texelFade) ARIFT_NUMBER(64, imageWidth) ARIFT_NUMBER(65, imageHeight)

const int backgroundNone = 0, backgroundPattern = 1, backgroundGrey = 2, backgroundBayer = 3, backgroundUnseen = 4;

layout(set = 0, binding = 1) uniform sampler2D firstPlane;   // grey, or the half plane with red
layout(set = 0, binding = 2) uniform sampler2D secondPlane;  // the half plane with blue
layout(set = 0, binding = 3) uniform sampler2D angleTable;
layout(set = 1, binding = 0) uniform sampler2DArray layerTexture;

layout(location = 0) noperspective in vec2 lensVector;       // tangents before the lens correction
layout(location = 1) noperspective in mat3 cameraMatrix;     // at this line: EyeBlock, LayerBlock
layout(location = 4) noperspective in mat3 layerMatrix;
layout(location = 7) flat in vec4 plane;
layout(location = 8) flat in vec4 planeOffset[2];
layout(location = 10) flat in vec4 colourRange;
layout(location = 11) flat in vec4 fillColour;
layout(location = 12) flat in vec4 layerRect;
layout(location = 13) flat in vec4 layerInside;
layout(location = 14) flat in vec4 mode;                     // the camera image's weight; the layer's array index, alpha counts, multiply

layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 cover;              // for blending over what is there already

// Horner's rule, written out: arrays of specialisation constants do not exist.
#define ARIFT_TERM(sum, x, c, count, i) if (count > i) sum = sum * x + c##i;
#define ARIFT_POLYNOMIAL(sum, x, c, count) \
	ARIFT_TERM(sum, x, c, count, 15) ARIFT_TERM(sum, x, c, count, 14) ARIFT_TERM(sum, x, c, count, 13) ARIFT_TERM(sum, x, c, count, 12) \
	ARIFT_TERM(sum, x, c, count, 11) ARIFT_TERM(sum, x, c, count, 10) ARIFT_TERM(sum, x, c, count, 9) ARIFT_TERM(sum, x, c, count, 8) \
	ARIFT_TERM(sum, x, c, count, 7) ARIFT_TERM(sum, x, c, count, 6) ARIFT_TERM(sum, x, c, count, 5) ARIFT_TERM(sum, x, c, count, 4) \
	ARIFT_TERM(sum, x, c, count, 3) ARIFT_TERM(sum, x, c, count, 2) ARIFT_TERM(sum, x, c, count, 1) ARIFT_TERM(sum, x, c, count, 0)

float stretch(float r2)
{
	float sum = 0.0;
	ARIFT_POLYNOMIAL(sum, r2, d, distortionCoefficients)
	return sum;
}

/// How each colour's tangents compare with green's, and how red's texel follows from green's and blue's.
struct Chromatic { float red, blue, redFromBlue; };

// ---- camera

float radial(float cosine)
{
	if (cameraCoefficients == 0) {
		const float at = acos(clamp(cosine, -1.0, 1.0)) * tableScale;
		const float last = float(textureSize(angleTable, 0).x) - 1.0;
		return textureLod(angleTable, vec2((at * last + 0.5) / (last + 1.0), 0.5), 0.0).r;
	}
	const float x = (cosine - cosineCentre) * cosineScale;
	float sum = 0.0;
	ARIFT_POLYNOMIAL(sum, x, g, cameraCoefficients)
	return sum;
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
	return fade * fade * (3.0 - 2.0 * fade) * mode.x;
}

vec3 rawColour(vec2 red, vec2 green, vec2 blue)
{
	const vec2 perTexel = plane.xy;
	if (background == backgroundGrey) {
		const vec2 offset = planeOffset[0].xy;
		return vec3(textureLod(firstPlane, red * perTexel + offset, 0.0).r, textureLod(firstPlane, green * perTexel + offset, 0.0).r,
			textureLod(firstPlane, blue * perTexel + offset, 0.0).r);
	}
	const vec2 isRed = plane.zw, isGreen = plane.wz;
	const vec2 r = textureLod(firstPlane, red * perTexel + planeOffset[0].xy, 0.0).rg;
	const vec2 g1 = textureLod(firstPlane, green * perTexel + planeOffset[0].zw, 0.0).rg;
	const vec2 g2 = textureLod(secondPlane, green * perTexel + planeOffset[1].xy, 0.0).rg;
	const vec2 b = textureLod(secondPlane, blue * perTexel + planeOffset[1].zw, 0.0).rg;
	// In the plane with blue, blue lies where the other one has green.
	return vec3(dot(r, isRed), 0.5 * (dot(g1, isGreen) + dot(g2, isRed)), dot(b, isGreen));
}

vec3 decoded(vec3 value)
{
	if (!encoded) return value;
	return mix(value / 12.92, pow((max(value, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(value, vec3(0.04045)));
}

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
	const vec3 colour = max((decoded(rawColour(red, green, blue)) - colourRange.w) * colourRange.xyz, 0.0);
	return mix(fill, colour, seen(green, cosine));
}

// ---- layer

vec4 layerTexel(vec2 uv, float w)
{
	const vec2 at = clamp(layerRect.xy + uv * layerRect.zw, layerInside.xy, layerInside.zw);
	const vec2 far = abs(uv - 0.5);
	const float inside = w > 0.0 && max(far.x, far.y) <= 0.5 ? 1.0 : 0.0;
	return textureLod(layerTexture, vec3(at, mode.y), 0.0) * inside + vec4(0.0, 0.0, 0.0, (1.0 - mode.z) * 2.0 * inside);
}

/// Light of the layer, premultiplied, and how much it covers, per colour.
void layerLight(vec2 tangents, Chromatic chromatic, out vec3 colour, out vec3 alpha)
{
	const vec3 across = layerMatrix[0] * tangents.x + layerMatrix[1] * tangents.y;
	const vec3 green = layerMatrix[2] + across, blue = layerMatrix[2] + across * chromatic.blue;
	const vec2 greenUv = green.xy / green.z, blueUv = blue.xy / blue.z;
	vec2 redUv = greenUv + (blueUv - greenUv) * chromatic.redFromBlue;
	if (redItself) {
		const vec3 red = layerMatrix[2] + across * chromatic.red;
		redUv = red.xy / red.z;
	}
	const vec4 r = layerTexel(redUv, green.z), g = layerTexel(greenUv, green.z), b = layerTexel(blueUv, green.z);
	alpha = clamp(vec3(r.a, g.a, b.a), 0.0, 1.0);
	colour = vec3(r.r, g.g, b.b) * (mode.w > 0.0 ? alpha : vec3(1.0));
}

void main()
{
	const float r2 = dot(lensVector, lensVector);
	Chromatic chromatic = Chromatic(1.0, 1.0, 0.0);
	vec2 tangents = lensVector;
	float shown = 1.0;
	if (throughLens) {
		shown = clamp(1.0 - (r2 - largestR2) * rimScale, 0.0, 1.0);
		const float r2Shown = min(r2, largestR2);
		tangents *= stretch(r2Shown);
		chromatic = Chromatic(red0 + red1 * r2Shown, blue0 + blue1 * r2Shown,
			redFromBlue0 + redFromBlue1 * r2Shown);
	}
	vec3 colour = behindLayers(tangents, chromatic, r2), alpha = vec3(0.0);
	if (hasLayer) {
		vec3 layerColour;
		layerLight(tangents, chromatic, layerColour, alpha);
		colour = colour * (1.0 - alpha * fillColour.w) + layerColour;
	}
	light = vec4(colour * shown, 1.0);
	cover = vec4(alpha * shown, 1.0);
}
