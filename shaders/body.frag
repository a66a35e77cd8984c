// Matte bodies in a key light from one side, a weak fill from the camera's, and the room's own
// light from above. TEXTURED: the base colour comes from a picture as well.
#include "light.glsl"

in vec3 position_ws;
in vec3 normal_ws;
in vec3 shadow_position;
in vec2 texture_uv;

#ifdef TEXTURED
uniform sampler2D base_map;
uniform float alpha_cutoff;  // discards what is thinner; 0: nothing
#endif
uniform vec4 color;  // linear, with opacity
uniform vec4 rim;    // linear colour and strength

out vec4 pixel;

void main() {
  vec4 base = color;
#ifdef TEXTURED
  base *= texture(base_map, texture_uv);
  if (base.a < alpha_cutoff) discard;
#endif
  vec3 n = normalize(gl_FrontFacing ? normal_ws : -normal_ws);
  vec3 v = normalize(camera_position - position_ws);
  float facing = clamp(dot(n, v), 0.0, 1.0);
  float key = clamp(dot(n, key_direction), 0.0, 1.0);
  vec3 light = mix(kBounce, kSky, 0.5 + 0.5 * n.y) + kFill * facing;
  light += kKey * key * Lit(shadow_position);
  float edge = 1.0 - facing;
  edge *= edge * edge;
  vec3 seen = Expose(base.rgb * light) + edge * (rim.rgb * rim.a + (0.035 + 0.035 * n.y) * kSky);
  pixel = vec4(Encode(seen), base.a);
}
