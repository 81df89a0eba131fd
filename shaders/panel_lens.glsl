// What the fragment shaders of the panel have in common: the constants of their pipelines, and the lens.

layout(constant_id = 0) const int distortionCoefficients = 16;
layout(constant_id = 1) const int cameraCoefficients = 16;   // 0: the table
layout(constant_id = 2) const bool tangentialDistortion = false;
layout(constant_id = 3) const int background = 0;
layout(constant_id = 4) const bool encoded = false;          // camera values are sRGB encoded
layout(constant_id = 5) const int layerCover = 0;            // Cover (compositor/tiles.h)
layout(constant_id = 6) const bool throughLens = true;       // false: the eye's image before the lens correction
layout(constant_id = 7) const bool redItself = false;        // red is evaluated, not derived from green and blue
layout(constant_id = 8) const bool layerEncoded = false;     // the layer's texels are sRGB encoded

// What the Rig decides is constant too. What changes from image to image comes from the vertices: a software renderer checks the range of
// every number that a fragment reads from a block.
#define ARIFT_NUMBER(id, name) layout(constant_id = id) const float name = 0.0;
ARIFT_NUMBER(9, d0) ARIFT_NUMBER(10, d1) ARIFT_NUMBER(11, d2) ARIFT_NUMBER(12, d3)
ARIFT_NUMBER(13, d4) ARIFT_NUMBER(14, d5) ARIFT_NUMBER(15, d6) ARIFT_NUMBER(16, d7)
ARIFT_NUMBER(17, d8) ARIFT_NUMBER(18, d9) ARIFT_NUMBER(19, d10) ARIFT_NUMBER(20, d11)
ARIFT_NUMBER(21, d12) ARIFT_NUMBER(22, d13) ARIFT_NUMBER(23, d14) ARIFT_NUMBER(24, d15)
ARIFT_NUMBER(25, largestR2) ARIFT_NUMBER(26, rimScale) ARIFT_NUMBER(27, fillScale) ARIFT_NUMBER(28, blue0)
ARIFT_NUMBER(29, blue1) ARIFT_NUMBER(30, red0) ARIFT_NUMBER(31, red1) ARIFT_NUMBER(32, redFromBlue0)
ARIFT_NUMBER(33, redFromBlue1) ARIFT_NUMBER(34, g0) ARIFT_NUMBER(35, g1) ARIFT_NUMBER(36, g2)
ARIFT_NUMBER(37, g3) ARIFT_NUMBER(38, g4) ARIFT_NUMBER(39, g5) ARIFT_NUMBER(40, g6)
ARIFT_NUMBER(41, g7) ARIFT_NUMBER(42, g8) ARIFT_NUMBER(43, g9) ARIFT_NUMBER(44, g10)
ARIFT_NUMBER(45, g11) ARIFT_NUMBER(46, g12) ARIFT_NUMBER(47, g13) ARIFT_NUMBER(48, g14)
ARIFT_NUMBER(49, g15) ARIFT_NUMBER(50, centreX) ARIFT_NUMBER(51, centreY) ARIFT_NUMBER(52, cosineCentre)
ARIFT_NUMBER(53, cosineScale) ARIFT_NUMBER(54, affineXx) ARIFT_NUMBER(55, affineXy) ARIFT_NUMBER(56, affineYx)
ARIFT_NUMBER(57, affineYy) ARIFT_NUMBER(58, p1) ARIFT_NUMBER(59, p2) ARIFT_NUMBER(60, xi)
ARIFT_NUMBER(61, tableScale) ARIFT_NUMBER(62, leastCosine) ARIFT_NUMBER(63, cosineFade) ARIFT_NUMBER(64, texelFade)
ARIFT_NUMBER(65, imageWidth) ARIFT_NUMBER(66, imageHeight)

// Polynomials, written out: arrays of specialisation constants do not exist. Estrin's scheme: few operations wait for each other.
#define ARIFT_PAIR(x, c, count, i, j) (count > j ? c##i + c##j * x : count > i ? c##i : 0.0)
#define ARIFT_FOUR(x, x2, c, count, i, j, k, l) (ARIFT_PAIR(x, c, count, i, j) + (count > k ? ARIFT_PAIR(x, c, count, k, l) * x2 : 0.0))
#define ARIFT_EIGHT(x, x2, x4, c, count, i, j, k, l, m, n, o, p) \
	(ARIFT_FOUR(x, x2, c, count, i, j, k, l) + (count > m ? ARIFT_FOUR(x, x2, c, count, m, n, o, p) * x4 : 0.0))
#define ARIFT_POLYNOMIAL(x, x2, x4, c, count) \
	(ARIFT_EIGHT(x, x2, x4, c, count, 0, 1, 2, 3, 4, 5, 6, 7) + \
	 (count > 8 ? ARIFT_EIGHT(x, x2, x4, c, count, 8, 9, 10, 11, 12, 13, 14, 15) * (x4 * x4) : 0.0))

float stretch(float r2)
{
	const float square = r2 * r2, fourth = square * square;
	return ARIFT_POLYNOMIAL(r2, square, fourth, d, distortionCoefficients);
}

/// How each colour's tangents compare with green's, and how red's texel follows from green's and blue's.
struct Chromatic { float red, blue, redFromBlue; };

/// Light of an sRGB encoded value in 0..1, within half of 1/255 of the encoded value.
vec4 decoded(vec4 v)
{
	return ((((0.749220899 * v - 1.77447071) * v + 1.76711091) * v + 0.195501003) * v + 0.066401595) * v;
}

/// Never NaN.
vec2 within(vec2 v, vec2 least, vec2 most)
{
	const vec2 low = mix(least, v, greaterThan(v, least));
	return mix(most, low, lessThan(low, most));
}

/// What a place on the panel shows, seen through the lens.
struct Seen {
	vec2 tangents;       ///< of green
	Chromatic chromatic;
	float r2;            ///< of the place itself
	float shown;         ///< 0 beyond the lens' rim
};
Seen throughTheLens(vec2 place)
{
	const float r2 = dot(place, place);
	if (!throughLens) return Seen(place, Chromatic(1.0, 1.0, 0.0), r2, 1.0);
	const float r2Shown = min(r2, largestR2);
	return Seen(place * stretch(r2Shown),
		Chromatic(red0 + red1 * r2Shown, blue0 + blue1 * r2Shown, redFromBlue0 + redFromBlue1 * r2Shown), r2,
		clamp(1.0 - (r2 - largestR2) * rimScale, 0.0, 1.0));
}
