// SPDX-License-Identifier: Apache-2.0
// The ground's two materials, soil and rock, at two scales: grains near the eye and crags far away. The textures are solid
// noise in the planet's axes, so that no surface has a seam.
#include "render/shaders/view_ray.glsl"

layout(binding = 18) uniform sampler3D grains;
layout(binding = 19) uniform sampler3D crags;

// Phases are texture coordinates of the camera, 0..1; the mean of the grains' texture is its last mipmap;
// finer_grain_levels = log2(grains_per_km / crags_per_km).
#define MATERIAL_CONSTANTS(HOW) \
  HOW vec3 grain_phase;         \
  HOW float grains_per_km;      \
  HOW vec3 crag_phase;          \
  HOW float crags_per_km;       \
  HOW vec4 grain_mean;          \
  HOW float finer_grain_levels;
CONSTANTS(5, Materials, MATERIAL_CONSTANTS)

// Of soil and of rock: the tangents of the steepest slopes, and how much of the textures' light and dark shows.
const vec2 kGrainSlope = vec2(0.5, 0.7), kCragSlope = vec2(0.3, 0.8);
const vec2 kGrainContrast = vec2(1.0, 0.8), kCragContrast = vec2(0.4, 0.5);

// Tilts the normal and returns the factor of the reflectance. `place` is relative to the camera, km, in the planet's axes,
// as `ray` and `normal` are; rock < 0: neither material.
float add_material(vec3 place, float d, vec3 ray, float rock, inout vec3 normal) {
  // Between the two mipmaps whose texels are about a pixel, seen at a slant.
  float texels = 64.0 * d * pixel_angle * inversesqrt(max(abs(dot(ray, normal)), 0.1));
  float level = log2(texels * crags_per_km);
#ifdef GRAINS
  vec4 grain = textureLod(grains, grain_phase + grains_per_km * place, level + finer_grain_levels);
#else
  vec4 grain = grain_mean;
#endif
  vec4 crag = textureLod(crags, crag_phase + crags_per_km * place, level);
  float rocky = max(rock, 0.0), land = rock < 0.0 ? 0.0 : 1.0;
  vec3 gradient = (255.0 / 127.0) * (mix(kGrainSlope.x, kGrainSlope.y, rocky) * (grain.xyz - 127.0 / 255.0) +
                                     mix(kCragSlope.x, kCragSlope.y, rocky) * (crag.xyz - 127.0 / 255.0));
  // What of the gradient lies in the surface tilts its normal.
  normal = normalize(normal - land * (gradient - dot(gradient, normal) * normal));
  return 1.0 + land * (mix(kGrainContrast.x, kGrainContrast.y, rocky) * (2.0 * grain.w - 1.0) +
                       mix(kCragContrast.x, kCragContrast.y, rocky) * (2.0 * crag.w - 1.0));
}
