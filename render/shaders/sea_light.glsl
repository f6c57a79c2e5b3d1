// SPDX-License-Identifier: Apache-2.0
// Light that the surface of the sea reflects, besides what comes out of the water: the sun's glitter and the sky, with CLOUDS by
// cloudy_path.glsl.
#include "render/shaders/view_ray.glsl"
#include "render/shaders/surface_light.glsl"
#include "model/shared/sea.glsl"

// The glitter alone, see below.
vec4 sea_glitter_radiance(Place at, vec3 to_eye, vec3 up, vec3 sun, float lit) {
  Place entry = where_light_enters(at);
  return lit * sun_transmittance(entry.h, entry.mu_s) *
         sea_glitter(max(dot(to_eye, up), 0.0), at.mu_s, dot(to_eye, sun), slope_variance);
}

// Toward the eye, per unit irradiance of the first sun; `position` is relative to the camera, `up` a unit vector, `lit` the part
// of the beam that nothing shades. The sky is seen in the facets' mean slope, as from a mirror, clouds as their mean over the
// facets.
vec4 sea_radiance(Place at, vec3 position, vec3 up, int i, float lit) {
  vec3 sun = suns[i].xyz, to_eye = -normalize(position);
  Place entry = where_light_enters(at);
  float mu_v = max(dot(to_eye, up), 0.0);
  vec4 light = sea_glitter_radiance(at, to_eye, up, sun, lit);
  vec3 aside = to_eye - mu_v * up;
  vec3 normal = normalize(up + sea_seen_slope(mu_v, slope_variance) / max(length(aside), 1e-6) * aside);
  vec3 mirrored = reflect(-to_eye, normal);
  float nu = clamp(dot(mirrored, sun), -1.0, 1.0);
  Place sky = Place(entry.h, clamp(dot(mirrored, up), 0.0, 1.0), at.mu_s);
#ifdef CLOSED_FORM
  vec4 mirrored_light = closed_form_sky(sky, nu);
#else
  vec4 mirrored_light = radiance(scattering(sky, nu, false), nu);
#endif
#ifdef CLOUDS
  ViewRay ray;
  ray.eye = position;
  ray.direction = mirrored;
  ray.air = true;
  ray.hits_ground = false;
  ray.entry = ray.to_ground = 0.0;
  ray.h = sky.h;
  ray.mu = sky.mu;
  const int kShadowSteps = 8;  // of a mean
  float spread = 2.0 * sqrt(slope_variance);
  vec4 of_clouds = among_clouds(mirrored_light, ray, sky, nu, kInfinity, meet_clouds(ray, kInfinity, spread), spread, i, kShadowSteps);
  mirrored_light += of_clouds;
#endif
  return light + water_reflectance(dot(to_eye, normal)) * mirrored_light;
}
