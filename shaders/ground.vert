// A square of the ground around the camera's target.
layout(location = 0) in vec2 corner;  // -1 to 1

uniform mat4 view_projection;
uniform mat4 shadow_matrix;
uniform vec3 ground_center;
uniform float ground_reach;

out vec3 position_ws;
out vec3 shadow_position;

void main() {
  position_ws = vec3(ground_center.x + corner.x * ground_reach, 0.0,
                     ground_center.z + corner.y * ground_reach);
  shadow_position = (shadow_matrix * vec4(position_ws, 1.0)).xyz;
  gl_Position = view_projection * vec4(position_ws, 1.0);
}
