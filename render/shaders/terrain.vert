// SPDX-License-Identifier: Apache-2.0
// The ground into the G-buffer: positions relative to the camera in kilometres, infinite reversed depth near / distance.
#include "render/shaders/seen_point.glsl"
#include "render/shaders/terrain_block.glsl"
layout(location = 2) in vec4 fine_normal;
layout(location = 3) in vec4 coarse_normal;
layout(location = 4) in vec4 fine_reflectance;
layout(location = 5) in vec4 coarse_reflectance;
layout(location = 8) in vec2 above_water;  // fine and coarse

uniform mat3 clip_from_planet;  // x, y and w
uniform float near_km;
uniform vec3 up;  // at the camera, planet axes

out vec4 ground_normal;  // share of rock
out vec4 ground_reflectance;
out float ground_above_water;

void main() {
  float t = morph();
  vec3 clip = clip_from_planet * seen_point(mix(fine_km, coarse_km, t) + offset_km, up);
  gl_Position = vec4(clip.xy, near_km, clip.z);
  ground_normal = mix(fine_normal, coarse_normal, t);
  ground_reflectance = mix(fine_reflectance, coarse_reflectance, t);
  ground_above_water = mix(above_water.x, above_water.y, t);
}
