// A colour of an application's picture stands for the world behind it. Included by panel.frag and surface.frag.

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

/// Of four texels, from their encoded, straight colours.
vec4 keptOfFour(vec4 red, vec4 green, vec4 blue, vec4 key, float softness)
{
	vec4 kept;
	for (int i = 0; i < 4; ++i) kept[i] = keptBy(vec3(red[i], green[i], blue[i]), key.rgb, key.a, softness);
	return kept;
}

/// Light of texels of these alphas without that of the key: what is half the key's colour has that much of it to lose, and no more light
/// than a picture of the alpha that is left.
vec4 withoutKey(vec4 light, vec4 alpha, vec4 left, float keyLight) { return clamp(light - (alpha - left) * keyLight, vec4(0.0), left); }
