// SPDX-License-Identifier: Apache-2.0
// Shadows in the air, of the terrain (SHADOWS) and of sheets of clouds (CLOUD_SHADOWS): of the light that a sun's beam scatters
// into a view ray up to a distance, as the model has it lit all along, the part that comes from where the beam does not reach.
// By steps along the ray: under the terrain begun at another place in each pixel, under clouds, of which each step takes the
// mean over its length, from their middles.
#include "render/shaders/densities.glsl"
#include "render/shaders/view_ray.glsl"
#ifdef SHADOWS
#include "render/shaders/shadows.glsl"
#endif
#ifdef CLOUD_SHADOWS
#include "render/shaders/clouds.glsl"
#endif

// What the beam scatters into the ray in a step of a length that ends at `end_km`; at `t` in it. `before`: light of the path up
// to the step, of closed forms.
vec4 beam_light(ViewRay ray, Place start, float nu, float t, float step_km, float end_km, inout vec4 before) {
#ifdef CLOSED_FORM
  vec4 to_end = max(closed_form_beam_inscatter(start, nu, place_along(start, nu, end_km).h, end_km), before);
  vec4 light = to_end - before;
  before = to_end;
  return light;
#else
  Place at = place_along(start, nu, t);
  vec4 light = transmittance_between(start, at, ray.hits_ground) * sun_transmittance(at.h, at.mu_s);
  Scattering here = scattering_at(at.h);
  here.rayleigh_like *= own_air_phase(nu);
  return step_km * light * radiance(here, nu);
#endif
}

#ifdef SHADOWS
vec2 pixel_centre;  // that seen_at() is asked for

// Share of a sun's beam that the terrain takes from a place in the air.
float terrain_shade(vec3 position, int sun) {
  // The air above level ground is not in its shadow.
  vec4 place = place_off(position, normalize(position + vec3(0.0, 0.0, bottom_km + camera_km)), sun);
  float lit = place.z < 0.0 ? 1.0 : lit_in_map(place, sun);
  return shadow_strength(position, sun) * (1.0 - lit);
}

vec4 shaded_light(ViewRay ray, Place start, float nu, float length_km, int sun) {
  const int kSteps = 24;
  float reach = min(length_km, shadow_reach_km - ray.entry);
  if (reach <= 0.0) return vec4(0.0);
  float step_km = reach / float(kSteps);
  // Jimenez 2014: interleaved gradient noise.
  float begin = fract(52.9829189 * fract(dot(pixel_centre, vec2(0.06711056, 0.00583715))));
  vec4 sum = vec4(0.0), before = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float t = (float(i) + begin) * step_km;
    float shaded = terrain_shade((ray.entry + t) * ray.direction, sun);
    sum += shaded * beam_light(ray, start, nu, t, step_km, float(i + 1) * step_km, before);
  }
  return sum;
}
#endif

#ifdef CLOUD_SHADOWS
// Of the light before each sheet the part that clouds shade, of the ray and sun that shaded_by_clouds() was asked for.
vec4 shaded_before_sheets[CLOUDS];

// Where the ray runs below the highest sheet, from its entry into the air on, km.
vec2 below_sheets(ViewRay ray, float length_km) {
  float highest = cloud_sheets[0].x;
  for (int c = 1; c < CLOUDS; ++c) highest = max(highest, cloud_sheets[c].x);
  float begin = 0.0, end;
  if (ray.h < highest) {
    end = distance_to_outer_sphere(bottom_km, ray.h, ray.mu, highest);
  } else {
    float discriminant = sphere_discriminant(bottom_km, ray.h, ray.mu, highest);
    if (ray.mu >= 0.0 || discriminant <= 0.0) return vec2(0.0);
    begin = distance_to_inner_sphere(bottom_km, ray.h, ray.mu, highest);
    end = begin + 2.0 * sqrt(discriminant);
  }
  if (ray.hits_ground) end = min(end, ray.to_ground);
  return vec2(begin, min(end, length_km));
}

// What the terrain shades already does not count.
vec4 shaded_by_clouds(ViewRay ray, Place start, float nu, float length_km, int sun) {
  const int kSteps = 32;
  for (int c = 0; c < CLOUDS; ++c) shaded_before_sheets[c] = vec4(0.0);
  vec2 part = below_sheets(ray, length_km);
  float whole = part.y - part.x;
  vec4 sum = vec4(0.0), before = vec4(0.0);
  if (whole <= 0.0) return sum;
#ifdef CLOSED_FORM
  if (part.x > 0.0) before = closed_form_beam_inscatter(start, nu, place_along(start, nu, part.x).h, part.x);
#endif
  for (int i = 0; i < kSteps; ++i) {
    // Short steps near the eye, where a pixel shows more.
    float step_begin = float(i) / float(kSteps), step_end = float(i + 1) / float(kSteps);
    if (part.x == 0.0) {
      step_begin *= step_begin;
      step_end *= step_end;
    }
    float step_km = (step_end - step_begin) * whole, t = part.x + step_begin * whole + 0.5 * step_km;
    vec4 light = beam_light(ray, start, nu, t, step_km, part.x + step_end * whole, before);
    vec3 position = (ray.entry + t) * ray.direction;
    float shaded = 1.0 - clear_of_clouds(position, place_along(start, nu, t), suns[sun].xyz, kNoCloud, step_km);
#ifdef SHADOWS
    shaded *= 1.0 - terrain_shade(position, sun);
#endif
    sum += shaded * light;
    for (int c = 0; c < CLOUDS; ++c) {
      if (ray.entry + t < cloud_distances[c]) shaded_before_sheets[c] += shaded * light;
    }
  }
  return sum;
}
#endif
