#version 450
// One triangle over the whole image.
layout(location = 0) noperspective out vec2 place;
void main()
{
	place = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
	gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
