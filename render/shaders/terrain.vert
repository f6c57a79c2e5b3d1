// SPDX-License-Identifier: Apache-2.0
// The terrain into the G-buffer: positions relative to the camera in kilometres, infinite reversed depth near / distance.
layout(location = 0) in vec3 position_km;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 reflectance;

uniform mat3 view_from_site;
uniform vec2 tangent;   // of half the field of view, horizontal and vertical
uniform float near_km;

out vec3 ground_normal;
out vec4 ground_reflectance;

void main() {
  vec3 view = view_from_site * position_km;
  gl_Position = vec4(view.xy / tangent, near_km, -view.z);
  ground_normal = normal;
  ground_reflectance = reflectance;
}
