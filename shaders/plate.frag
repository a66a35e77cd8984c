in vec2 place;
flat in vec4 form;
in vec2 glyph_uv;
flat in vec4 ink;

uniform sampler2D glyphs;

out vec4 pixel;

void main() {
  vec2 q = abs(place) - form.xy + form.z;
  float outside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - form.z;
  float cover = mix(clamp(0.5 - outside, 0.0, 1.0), texture(glyphs, glyph_uv).r, form.w);
  if (cover <= 0.0) discard;
  pixel = vec4(ink.rgb, ink.a * cover);
}
