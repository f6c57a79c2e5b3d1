// SPDX-License-Identifier: Apache-2.0
// The ground's two materials, soil and rock, at three scales: grains near the eye, stones, and crags far away. The textures
// are solid noise in the planet's axes, so that no surface has a seam. What a user has of his own (OWN_SOIL_COLOR and so on)
// takes the place of that.
#include "render/shaders/view_ray.glsl"
#ifdef OWN_MATERIALS
#include "render/shaders/own_materials.glsl"
#endif

layout(binding = 18) uniform sampler3D grains;
layout(binding = 19) uniform sampler3D crags;

// Phases are texture coordinates of the camera, 0..1; the mean of a texture is its last mipmap.
#define MATERIAL_CONSTANTS(EACH) \
  EACH(vec3, grain_phase)        \
  EACH(float, grains_per_km)     \
  EACH(vec3, crag_phase)         \
  EACH(float, crags_per_km)      \
  EACH(vec3, far_crag_phase)     \
  EACH(float, far_crags_per_km)  \
  EACH(vec4, grain_mean)         \
  EACH(vec4, crag_mean)
CONSTANTS(5, Materials, MATERIAL_CONSTANTS)

// Of soil and of rock: the tangents of the steepest slopes, and how much of the textures' light and dark shows.
const vec2 kGrainSlope = vec2(0.5, 0.7), kCragSlope = vec2(0.3, 0.8);
const vec2 kGrainContrast = vec2(1.0, 0.8), kCragContrast = vec2(0.4, 0.5);
// Stones are the crags' texture again, smaller by this, a whole number (the phase is known but for whole ones); how steep they
// are, and how light and dark, in units of the crags'.
const float kStoneScale = 8.0;
const vec4 kStones = vec4(vec3(0.9), 1.5);
// Units by which the crags move the stones, whose repetition is not seen then.
const float kStoneBend = 1.0;

// 0 to 1: where a unit of a texture, seen at a mipmap, is but a few pixels, its repetition would show. A larger one takes its
// place.
float smallness(float level) { return smoothstep(0.5, 2.5, level); }

#ifdef GRAINS
// Grit is the grains' texture again, smaller by this, a whole number (the phase is known but for whole ones): the ground near the feet.
const float kGritScale = 6.0, kGritSlope = 0.6, kGritContrast = 0.8;

// The mean of four points along a pixel's long side, which lies away from the eye.
vec4 along(sampler3D solid, vec3 at, vec3 side, float level) {
  return 0.25 * (textureLod(solid, at - 0.375 * side, level) + textureLod(solid, at - 0.125 * side, level) +
                 textureLod(solid, at + 0.125 * side, level) + textureLod(solid, at + 0.375 * side, level));
}

// The grains and the grit seen at a slant: mipmaps whose texels are a pixel's short side, not the mean of both, which would
// blur the ground across.
vec4 grains_at(vec3 place, float d, vec3 ray, vec3 normal) {
  const float kMostSlant = 6.0;
  float cosine = max(abs(dot(ray, normal)), 1e-3);
  float slant = min(1.0 / cosine, kMostSlant);
  vec3 away = ray - dot(ray, normal) * normal;
  vec3 side = (d * pixel_angle * slant * inversesqrt(max(dot(away, away), 1e-6))) * away;
  float texels = 64.0 * d * pixel_angle * max(0.25 * slant, 1.0) * max(1.0 / (cosine * slant), 1.0);
  float level = log2(texels * grains_per_km);
  vec3 at = grain_phase + grains_per_km * place;
  side *= grains_per_km;
  vec4 grain = along(grains, at, side, level);
  vec4 grit = along(grains, kGritScale * at, kGritScale * side, level + log2(kGritScale)) - grain_mean;
  return grain + vec4(vec3(kGritSlope), kGritContrast) * grit;
}
#endif

// Tilts the normal and returns the reflectance. `place` is relative to the camera, km, in the planet's axes, as `ray` and
// `normal` are; rock < 0: neither material.
vec4 with_material(vec3 place, float d, vec3 ray, float rock, vec4 reflectance, inout vec3 normal) {
  // Between the two mipmaps whose texels are about a pixel, seen at a slant.
  float texels = 64.0 * d * pixel_angle * inversesqrt(max(abs(dot(ray, normal)), 0.1));
  float level = log2(texels * crags_per_km);
#ifdef GRAINS
  vec4 grain = grains_at(place, d, ray, normal);
#else
  vec4 grain = grain_mean;
#endif
  vec3 at = crag_phase + crags_per_km * place;
  vec4 crag = textureLod(crags, at, level);
  vec3 stone_at = kStoneScale * at + kStoneBend * (crag - crag_mean).xyz;
  float stone_level = level + log2(kStoneScale);
  float near = 1.0 - smallness(stone_level), far = smallness(level);
  if (near > 0.0) crag += near * kStones * (textureLod(crags, stone_at, stone_level) - crag_mean);
  if (far > 0.0) {
    vec3 far_at = far_crag_phase + far_crags_per_km * place;
    crag = mix(crag, textureLod(crags, far_at, log2(texels * far_crags_per_km)), far);
  }
  float rocky = max(rock, 0.0), land = rock < 0.0 ? 0.0 : 1.0;
  // Of soil and of rock.
  vec3 fine = (255.0 / 127.0) * (grain.xyz - 127.0 / 255.0), coarse = (255.0 / 127.0) * (crag.xyz - 127.0 / 255.0);
  vec3 soil_gradient = kGrainSlope.x * fine + kCragSlope.x * coarse;
  vec3 rock_gradient = kGrainSlope.y * fine + kCragSlope.y * coarse;
  vec2 light = 1.0 + land * (kGrainContrast * (2.0 * grain.w - 1.0) + kCragContrast * (2.0 * crag.w - 1.0));
  vec4 soil_reflectance = light.x * reflectance, rock_reflectance = light.y * reflectance;
#ifdef OWN_MATERIALS
  if (land > 0.0) {
    Footprint pixel = footprint_of(place, d, ray, normal);
#if defined(OWN_SOIL_COLOR) || defined(OWN_SOIL_RELIEF)
    if (rocky < 1.0) {
      OwnMaterial soil = own_material(soil_color, soil_slopes, own_means[0], own_means[1], 0, pixel);
#ifdef OWN_SOIL_COLOR
      soil_reflectance = soil.reflectance;
#endif
#ifdef OWN_SOIL_RELIEF
      soil_gradient = soil.gradient;
#endif
    }
#endif
#if defined(OWN_ROCK_COLOR) || defined(OWN_ROCK_RELIEF)
    if (rocky > 0.0) {
      OwnMaterial own_rock = own_material(rock_color, rock_slopes, own_means[2], own_means[3], 2, pixel);
#ifdef OWN_ROCK_COLOR
      rock_reflectance = own_rock.reflectance;
#endif
#ifdef OWN_ROCK_RELIEF
      rock_gradient = own_rock.gradient;
#endif
    }
#endif
  }
#endif
  vec3 gradient = mix(soil_gradient, rock_gradient, rocky);
  // What of the gradient lies in the surface tilts its normal.
  normal = normalize(normal - land * (gradient - dot(gradient, normal) * normal));
  return mix(soil_reflectance, rock_reflectance, rocky);
}
