// Edges of a mesh, in one plain colour.
in vec2 texture_uv;

uniform vec4 color;  // sRGB, with opacity

out vec4 pixel;

void main() { pixel = color; }
