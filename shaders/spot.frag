in vec2 place;
in vec4 color;

out vec4 pixel;

void main() {
  float fall = clamp(1.0 - dot(place, place), 0.0, 1.0);
  fall *= fall;
  pixel = vec4(color.rgb, color.a * fall);
}
