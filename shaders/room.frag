// The room behind the bodies: plain, a little darker in the corners.
#include "light.glsl"

uniform vec3 room_color;  // sRGB
uniform vec2 picture_center;
uniform float vignette;

out vec4 pixel;

void main() {
  vec2 d = gl_FragCoord.xy - picture_center;
  pixel = vec4(room_color * (1.0 - vignette * dot(d, d)) + Dither(gl_FragCoord.xy), 1.0);
}
