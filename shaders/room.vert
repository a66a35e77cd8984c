// Everything that nothing else covers: the whole picture at the far end of depth.
layout(location = 0) in vec2 corner;

void main() { gl_Position = vec4(corner, 1.0, 1.0); }
