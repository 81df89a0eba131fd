#version 450
// A disc that faces the viewer, its edge covered analytically over one pixel: pure blue light added to what lies behind (alpha 0).
layout(push_constant) uniform Marker {
	vec4 disc;    // centre in the view's frame, radius; metres
	vec4 window;  // tangents of the view's left and upper edge, tangents per pixel to the right and downwards
} marker;
layout(location = 0) out vec4 light;

void main()
{
	vec2 tangents = marker.window.xy + gl_FragCoord.xy * marker.window.zw;
	vec3 ray = vec3(tangents, -1.0);
	vec3 centre = marker.disc.xyz;
	float towards = dot(ray, centre);
	float offset = length(ray * (dot(centre, centre) / max(towards, 1e-6)) - centre);
	float pixel = length(vec2(dFdx(offset), dFdy(offset)));
	float coverage = clamp(0.5 + (marker.disc.w - offset) / max(pixel, 1e-9), 0.0, 1.0);
	if (coverage == 0.0) discard; // another disc may be there already
	light = vec4(0.0, 0.0, coverage, 0.0);
}
