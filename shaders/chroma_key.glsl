// A colour of an application's picture stands for the world behind it. Included by panel.frag.

/// IEC 61966-2-1.
vec4 encodedLight(vec4 v)
{
	return mix(1.055 * pow(max(v, vec4(0.0031308)), vec4(1.0 / 2.4)) - 0.055, 12.92 * v, lessThan(v, vec4(0.0031308)));
}

/// How much of a texel stays, by how far its encoded colour is from the key's: Rec. 709's colour differences, and a quarter of its luma, so
/// that shades of the key go with it and greys are told apart all the same.
float keptBy(vec3 colour, vec3 key, float tolerance, float softness)
{
	const vec3 d = colour - key;
	const float luma = dot(d, vec3(0.2126, 0.7152, 0.0722));
	const vec3 apart = vec3(0.25 * luma, (d.b - luma) / 1.8556, (d.r - luma) / 1.5748);
	return smoothstep(tolerance, tolerance + max(softness, 1e-3), length(apart));
}
