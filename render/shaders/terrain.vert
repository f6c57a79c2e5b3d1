// SPDX-License-Identifier: Apache-2.0
// The ground into the G-buffer: positions relative to the camera in kilometres, infinite reversed depth near / distance.
#include "render/shaders/terrain_block.glsl"
layout(location = 2) in vec4 fine_normal;
layout(location = 3) in vec4 coarse_normal;
layout(location = 4) in vec4 fine_reflectance;
layout(location = 5) in vec4 coarse_reflectance;
layout(location = 8) in vec3 far_phase;
#ifdef NEAR
layout(location = 9) in vec3 near_phase;
#endif

uniform mat3 view_from_planet;
uniform vec2 tangent;  // of half the field of view, horizontal and vertical
uniform float near_km;
uniform float far_per_km;  // repetitions of the materials' textures
#ifdef NEAR
uniform float near_per_km;
#endif

out vec4 ground_normal;  // planet axes; share of rock, -1 in water
out vec4 ground_reflectance;
out vec3 far_place;  // texture coordinates
#ifdef NEAR
out vec3 near_place;
#endif

void main() {
  float t = morph();
  vec3 in_block = mix(fine_km, coarse_km, t);
  vec3 view = view_from_planet * (in_block + offset_km);
  gl_Position = vec4(view.xy / tangent, near_km, -view.z);
  ground_normal = mix(fine_normal, coarse_normal, t);
  ground_reflectance = mix(fine_reflectance, coarse_reflectance, t);
#ifdef NEAR
  near_place = near_phase + near_per_km * in_block;
#endif
  far_place = far_phase + far_per_km * in_block;
}
