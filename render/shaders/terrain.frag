// SPDX-License-Identifier: Apache-2.0
// The ground into the G-buffer. Two materials, each at two scales: the finer one only NEAR, where a pixel can show it.
#include "render/shaders/gbuffer.glsl"

in vec4 ground_normal;
in vec4 ground_reflectance;
in vec3 far_place;
#ifdef NEAR
in vec3 near_place;
#endif

layout(binding = 0) uniform sampler3D soil;
layout(binding = 1) uniform sampler3D rock;

uniform mat3 site_from_planet;

const vec4 kSmooth = vec4(vec3(127.0), 127.5) / 255.0;  // what a texture is from afar
const float kSoilSlope = 0.35, kRockSlope = 0.8;  // of the materials' steepest gradients

void main() {
  float land = ground_normal.w >= 0.0 ? 1.0 : 0.0;
  float rocky = max(ground_normal.w, 0.0);
  vec4 soft = texture(soil, far_place);
  vec4 hard = texture(rock, far_place);
#ifdef NEAR
  soft = 0.5 * (soft + texture(soil, near_place));
  hard = 0.5 * (hard + texture(rock, near_place));
#else
  soft = 0.5 * (soft + kSmooth);
  hard = 0.5 * (hard + kSmooth);
#endif
  // The gradient of the solid relief; what lies in the surface tilts its normal.
  vec3 gradient = (255.0 / 127.0) * mix(kSoilSlope * (soft.xyz - 127.0 / 255.0), kRockSlope * (hard.xyz - 127.0 / 255.0), rocky);
  vec3 normal = normalize(ground_normal.xyz);
  normal = normalize(normal - land * (gradient - dot(gradient, normal) * normal));
  float light = mix(1.0, 2.0 * mix(soft.w, hard.w, rocky), land);
  write_gbuffer(site_from_planet * normal, min(ground_reflectance * light, vec4(1.0)));
}
