// Depth only. TEXTURED: holes of the base colour's picture stay open.
in vec2 texture_uv;

#ifdef TEXTURED
uniform sampler2D base_map;
uniform float alpha_cutoff;
uniform float base_alpha;
#endif

void main() {
#ifdef TEXTURED
  if (base_alpha * texture(base_map, texture_uv).a < alpha_cutoff) discard;
#endif
}
