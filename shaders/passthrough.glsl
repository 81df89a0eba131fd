// The cameras' image as a layer with a style: XR_FB_passthrough, XrPassthroughStyleFB. Included by panel.frag, after chroma_key.glsl.

const vec3 luma709 = vec3(0.2126, 0.7152, 0.0722);

/// CIELAB's f for the white point D65, and its inverse. CIE 15: 216/24389 and 841/108.
vec3 labOf(vec3 xyz)
{
	return mix(pow(max(xyz, vec3(1e-6)), vec3(1.0 / 3.0)), xyz * (841.0 / 108.0) + 4.0 / 29.0, lessThan(xyz, vec3(216.0 / 24389.0)));
}
vec3 xyzOf(vec3 f) { return mix(f * f * f, (f - 4.0 / 29.0) * (108.0 / 841.0), lessThan(f, vec3(6.0 / 29.0))); }

/// L* = 116 f.y - 16, a* = 500 (f.x - f.y), b* = 200 (f.y - f.z): contrast about the middle grey, then brightness; a* and b* by the saturation.
vec3 adjusted(vec3 light, float brightness, float contrast, float saturation)
{
	// Rec. 709 primaries, each row divided by the white point's.
	const mat3 toXyz = mat3(0.4338874, 0.2126390, 0.0177500, 0.3762240, 0.7151687, 0.1094476, 0.1898887, 0.0721923, 0.8728023);
	const mat3 toLight = mat3(3.0803988, -0.9212232, 0.0528740, -1.5373828, 1.8759673, -0.2039770, -0.5430160, 0.0452559, 1.1511030);
	const vec3 f = labOf(toXyz * light);
	const float middle = clamp((116.0 * f.y - 66.0) * contrast + 50.0, 0.0, 100.0);
	const float y = (clamp(middle + brightness, 0.0, 100.0) + 16.0) / 116.0;
	return max(toLight * xyzOf(vec3(y + (f.x - f.y) * saturation, y, y + (f.z - f.y) * saturation)), vec3(0.0));
}

/// 0..1: how much of an edge there is between four neighbours of the green lattice (encoded values), the camera's noise left out.
float edgeOf(vec4 four)
{
	const vec2 slope = 0.5 * vec2(four.y + four.w - four.x - four.z, four.z + four.w - four.x - four.y);
	return smoothstep(0.05, 0.2, length(slope));
}
