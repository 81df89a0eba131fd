#version 450
// Rectangles of the image, in pixels.
layout(location = 0) in ivec2 pixel;
layout(push_constant) uniform Extent { vec2 pixelToClip; };

void main() { gl_Position = vec4(vec2(pixel) * pixelToClip - 1.0, 0.0, 1.0); }
