// SPDX-License-Identifier: Apache-2.0
// The straight ray to what an eye sees along a bent one, by --refraction. Directions have z up at the eye.
#include "render/shaders/view_ray.glsl"
#ifdef REFRACTION
#include "model/shared/seen_refracted.glsl"

vec3 with_zenith(vec3 direction, float zenith) {
  return vec3(sin(zenith) * normalize(direction.xy), cos(zenith));
}

// To a point at a distance.
vec3 straight_ray(vec3 direction, float distance) {
  if (direction.xy == vec2(0.0)) return direction;
  float seen = atan(length(direction.xy), direction.z), zenith = seen;
  for (int i = 0; i < 3; ++i) zenith = seen + lift_by_air(camera_km, cos(zenith), distance, bottom_km, refractive_air.x, refractive_air.y);
  return with_zenith(direction, zenith);
}

// To the sky: one that comes as near to the ground; above the level of the eye the ray itself.
vec3 straight_ray(vec3 direction) {
  if (direction.z >= 0.0 || direction.xy == vec2(0.0)) return direction;
  float mu = straight_mu_as_near(direction.z, camera_km, bottom_km, refractive_air.x, refractive_air.y);
  return vec3(sqrt(max(1.0 - mu * mu, 0.0)) * normalize(direction.xy), mu);
}
#else
vec3 straight_ray(vec3 direction, float distance) { return direction; }
vec3 straight_ray(vec3 direction) { return direction; }
#endif
