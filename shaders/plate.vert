// Name plates: rectangles in pixels, placed in clip space by the caller.
layout(location = 0) in vec3 position;  // normalised device coordinates
layout(location = 1) in vec2 local;     // pixels from the rectangle's middle
layout(location = 2) in vec4 shape;     // half width, half height, corner radius; w: 1 for a glyph
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;     // sRGB

out vec2 place;
flat out vec4 form;
out vec2 glyph_uv;
flat out vec4 ink;

void main() {
  place = local;
  form = shape;
  glyph_uv = uv;
  ink = color;
  gl_Position = vec4(position, 1.0);
}
