// What every lit thing shares. Light is linear; Encode makes it sRGB, because the target's bytes
// are written as they are. No pow: on a processor that draws it costs more than all the rest.

uniform vec3 key_direction;  // towards the key light, unit
uniform vec3 camera_position;
uniform sampler2DShadow shadow_map;
uniform float shadow_strength;  // 0: no shadows
uniform vec2 shadow_texel;

const vec3 kKey = vec3(1.62, 1.53, 1.40);
const vec3 kSky = vec3(0.30, 0.33, 0.38);
const vec3 kBounce = vec3(0.115, 0.105, 0.098);
const vec3 kFill = vec3(0.20, 0.225, 0.26);

// sRGB from linear light by square roots, within half of a 255th.
vec3 Encode(vec3 linear) {
  vec3 a = sqrt(clamp(linear, 0.0, 1.0));
  vec3 b = sqrt(a);
  vec3 c = sqrt(b);
  return max(vec3(0.0), 0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * linear);
}

// Soft shoulder, so that bright skin in the key light keeps its hue.
vec3 Expose(vec3 light) { return light * (1.0 + light * 0.16) / (1.0 + light * 0.62); }

float Lit(vec3 shadow_position) {
  return 1.0 - shadow_strength * (1.0 - texture(shadow_map, shadow_position));
}

// Four taps in a turned square: a soft edge for the price of a small one.
float SoftLit(vec3 p) {
  float sum = texture(shadow_map, p + vec3(shadow_texel * vec2(0.6, 1.6), 0.0)) +
              texture(shadow_map, p + vec3(shadow_texel * vec2(1.6, -0.6), 0.0)) +
              texture(shadow_map, p + vec3(shadow_texel * vec2(-0.6, -1.6), 0.0)) +
              texture(shadow_map, p + vec3(shadow_texel * vec2(-1.6, 0.6), 0.0));
  return 1.0 - shadow_strength * (1.0 - 0.25 * sum);
}

// Below what eight bits can tell: hides the bands of dark gradients.
float Dither(vec2 pixel) {
  return (fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}
