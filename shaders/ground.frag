// The floor: a pool of light where the bodies stand, which fades into the room; a fine grid every
// quarter metre and a heavier line each metre. SHADOWED: where the bodies' shadows can fall.
#include "light.glsl"

in vec3 position_ws;
in vec3 shadow_position;

uniform vec3 room_color;   // sRGB, where the floor has faded
// sRGB, in the middle of the pool: in shadow, and by how much more in the light. Encoded by the
// caller, because the floor is half of the picture.
uniform vec3 floor_dark;
uniform vec3 floor_gain;
uniform vec3 line_dark;
uniform vec3 line_gain;
uniform vec3 pool_center;
uniform float pool_radius;
uniform float grid_strength;
uniform vec2 picture_center;  // pixels
uniform float vignette;       // per square pixel

out vec4 pixel;

// How much of the pixel a line of this width covers, for lines at every multiple of `step`.
// Where lines come closer than pixels it settles at their mean.
float Line(vec2 p, vec2 footprint, vec2 per_footprint, float step, float width) {
  vec2 d = abs(fract(p * (1.0 / step) + 0.5) - 0.5) * step;
  vec2 w = max(vec2(width), footprint);
  vec2 cover = clamp((w - d) * per_footprint, 0.0, 1.0) * inversesqrt(w);
  return max(cover.x, cover.y) * sqrt(width);
}

void main() {
  vec2 p = position_ws.xz;
  vec2 footprint = fwidth(p);
  vec2 per_footprint = 1.0 / max(footprint, 1e-5);
  float from_pool = length(p - pool_center.xz) / pool_radius;
  float pool = 1.0 / (1.0 + from_pool * from_pool * from_pool);
  float away = length(position_ws - camera_position);
  float far_fade = clamp(1.25 - away / 32.0, 0.0, 1.0);
  float near_fade = clamp(1.2 - away / 12.0, 0.0, 1.0);

#ifdef SHADOWED
  float lit = SoftLit(shadow_position);
#else
  const float lit = 1.0;
#endif
  float grid = max(0.75 * Line(p, footprint, per_footprint, 1.0, 0.007),
                   0.26 * near_fade * Line(p, footprint, per_footprint, 0.25, 0.004));
  vec3 color = mix(floor_dark + lit * floor_gain, line_dark + lit * line_gain, grid_strength * grid);
  color = mix(room_color, color, pool * far_fade);
  vec2 d = gl_FragCoord.xy - picture_center;
  color *= 1.0 - vignette * dot(d, d);
  pixel = vec4(color + Dither(gl_FragCoord.xy), 1.0);
}
