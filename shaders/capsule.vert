// One mesh of a capsule, drawn as every limb, bone, joint and marker: its two ends and their radii
// come with each instance. Ends that coincide make a ball.
layout(location = 0) in vec4 point;  // unit direction from the end's centre; w: which end
layout(location = 3) in vec4 end_a;  // centre, world space, and radius
layout(location = 4) in vec4 end_b;
layout(location = 5) in vec4 instance_color;  // linear, with opacity

uniform mat4 view_projection;
uniform mat4 shadow_matrix;

out vec3 position_ws;
out vec3 normal_ws;
out vec3 shadow_position;
out vec2 texture_uv;
out vec4 base_color;

void main() {
  vec3 axis = end_b.xyz - end_a.xyz;
  float len = length(axis);
  vec3 y = len > 1e-6 ? axis / len : vec3(0.0, 1.0, 0.0);
  // A frame around the axis without a seam (Duff et al. 2017), with y in the place of z.
  float s = y.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + y.z);
  float b = y.x * y.y * a;
  vec3 x = vec3(1.0 + s * y.x * y.x * a, s * b, -s * y.x);
  vec3 z = -vec3(b, s + y.y * y.y * a, -y.y);  // keeps the mesh's winding
  vec3 direction = point.x * x + point.y * y + point.z * z;
  vec4 end = mix(end_a, end_b, point.w);
  position_ws = end.xyz + end.w * direction;
  // The side of a cone leans towards its thin end.
  float lean = len > 1e-6 ? clamp((end_a.w - end_b.w) / len, -0.7, 0.7) : 0.0;
  normal_ws = normalize(direction + lean * (1.0 - abs(point.y)) * y);
  texture_uv = vec2(0.0);
  base_color = instance_color;
  shadow_position = (shadow_matrix * vec4(position_ws + 0.012 * normal_ws, 1.0)).xyz;
  gl_Position = view_projection * vec4(position_ws, 1.0);
}
