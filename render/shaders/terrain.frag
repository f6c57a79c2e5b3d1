// SPDX-License-Identifier: Apache-2.0
// G-buffer of Sperlhofer 2011, 4.4: colour at the four wavelengths, scaled to a largest component of 1; normal with
// that largest reflectance / pi. Two materials, each at two scales.
in vec4 ground_normal;
in vec4 ground_reflectance;
in vec3 near_place, far_place;

layout(binding = 0) uniform sampler3D soil;
layout(binding = 1) uniform sampler3D rock;

uniform mat3 site_from_planet;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 normal_reflectance;

const float kPi = 3.14159265358979;
const float kSoilSlope = 0.35, kRockSlope = 0.8;  // of the materials' steepest gradients

void main() {
  float land = ground_normal.w >= 0.0 ? 1.0 : 0.0;
  float rocky = max(ground_normal.w, 0.0);
  vec4 soft = 0.5 * (texture(soil, near_place) + texture(soil, far_place));
  vec4 hard = 0.5 * (texture(rock, near_place) + texture(rock, far_place));
  // The gradient of the solid relief; what lies in the surface tilts its normal.
  vec3 gradient = (255.0 / 127.0) * mix(kSoilSlope * (soft.xyz - 127.0 / 255.0), kRockSlope * (hard.xyz - 127.0 / 255.0), rocky);
  vec3 normal = normalize(ground_normal.xyz);
  normal = normalize(normal - land * (gradient - dot(gradient, normal) * normal));
  float light = mix(1.0, 2.0 * mix(soft.w, hard.w, rocky), land);
  vec4 reflectance = min(ground_reflectance * light, vec4(1.0));
  float largest = max(max(reflectance.x, reflectance.y), max(reflectance.z, max(reflectance.w, 1e-6)));
  color = reflectance / largest;
  normal_reflectance = vec4(site_from_planet * normal, largest / kPi);
}
