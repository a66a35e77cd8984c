// The floor around the stage.
layout(location = 0) in vec2 place;  // x and z, metres

uniform mat4 view_projection;
uniform mat4 shadow_matrix;

out vec3 position_ws;
out vec3 shadow_position;

void main() {
  position_ws = vec3(place.x, 0.0, place.y);
  shadow_position = (shadow_matrix * vec4(position_ws, 1.0)).xyz;
  gl_Position = view_projection * vec4(position_ws, 1.0);
}
