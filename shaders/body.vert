// A mesh that is posed already, in world space.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

uniform mat4 view_projection;
uniform mat4 shadow_matrix;

out vec3 position_ws;
out vec3 normal_ws;
out vec3 shadow_position;
out vec2 texture_uv;

void main() {
  position_ws = position;
  normal_ws = normal;
  texture_uv = uv;
  shadow_position = (shadow_matrix * vec4(position + 0.012 * normal, 1.0)).xyz;
  gl_Position = view_projection * vec4(position, 1.0);
}
