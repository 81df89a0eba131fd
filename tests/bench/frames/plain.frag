#version 450
layout(set = 0, binding = 0) uniform sampler2D picture;
layout(location = 0) noperspective in vec2 place;
layout(location = 0) out vec4 colour;
void main() { colour = textureLod(picture, place, 0.0); }
