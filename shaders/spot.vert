// Round spots: darkness where a foot is near the floor, light where skin touches skin.
layout(location = 0) in vec2 corner;
layout(location = 3) in vec4 center;  // world space, and radius
layout(location = 4) in vec4 spot_color;

uniform mat4 view_projection;
uniform vec3 axis_x;
uniform vec3 axis_y;

out vec2 place;
out vec4 color;

void main() {
  place = corner;
  color = spot_color;
  vec3 p = center.xyz + center.w * (corner.x * axis_x + corner.y * axis_y);
  gl_Position = view_projection * vec4(p, 1.0);
}
