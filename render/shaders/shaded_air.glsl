// SPDX-License-Identifier: Apache-2.0
// Shadows in the air, of the terrain (SHADOWS) and of sheets of clouds (CLOUD_SHADOWS): of the light that a sun's beam scatters
// into a view ray up to a distance, as the model has it lit all along, the part that comes from where the beam does not reach.
// By steps along the ray: under the terrain begun at another place in each sample of a pixel, under clouds, of which each step
// takes the mean over its length, from their middles.
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

// Models whose light may be less than the beam's along the path: formulas, and sums of few steps.
#if defined(CLOSED_FORM) || defined(ONEIL) || defined(HILLAIRE)
#define LESS_THAN_THE_BEAM

// All light of the beam between two places of the ray, as far as it is in air.
vec4 beam_light_between(ViewRay ray, Place start, float nu, float begin_km, float end_km) {
  float in_air = ray.hits_ground ? ray.to_ground : distance_to_outer_sphere(bottom_km, ray.h, ray.mu, thickness_km);
  float whole = min(end_km, in_air) - begin_km;
  if (whole <= 0.0) return vec4(0.0);
#ifdef CLOSED_FORM
  Place begin = place_along(start, nu, begin_km);
  vec4 through = begin_km > 0.0 ? closed_form_through(start, begin.h, begin_km) : vec4(1.0);
  return through * closed_form_beam_inscatter(begin, nu, place_along(start, nu, begin_km + whole).h, whole);
#else
  const int kSteps = 8;
  vec4 sum = vec4(0.0), unused = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    // Short steps first, as air grows thin.
    vec2 part = vec2(float(i), float(i + 1)) / float(kSteps);
    part *= part;
    float step_km = (part.y - part.x) * whole, step_end = begin_km + part.y * whole;
    sum += beam_light(ray, start, nu, step_end - 0.5 * step_km, step_km, step_end, unused);
  }
  return sum;
#endif
}
#endif

// Light of the beam along a path, and the part of it that is shaded. All of it is known of models whose light may be less, of
// others that of the steps.
struct BeamLight {
  vec4 all, shaded;
};

BeamLight no_beam_light() {
  BeamLight beam;
  beam.all = beam.shaded = vec4(0.0);
  return beam;
}

// The rest of what a model has as light of the path. Where that is less than the beam's it loses the same share.
vec4 without_shaded(vec4 light, BeamLight beam) {
  return max(light - beam.shaded * min(light / max(beam.all, 1e-30), 1.0), 0.0);
}

#ifdef SHADOWS
vec2 pixel_centre;  // that seen_at() is asked for; of samples

// Share of a sun's beam that the terrain takes from a place in the air.
float terrain_shade(vec3 position, int sun) {
  // The air above level ground is not in its shadow.
  vec4 place = place_off(position, normalize(position + vec3(0.0, 0.0, bottom_km + camera_km)), sun);
  float lit = place.z < 0.0 ? 1.0 : lit_in_map(place, sun);
  return shadow_strength(position, sun) * (1.0 - lit);
}

// Where in its steps a sample begins, 0 to 1: a quarter of its own in each block of 2 x 2 samples, so that the mean of a pixel is
// that of four times as many steps, and in it by interleaved gradient noise (Jimenez 2014).
float step_begin_of_sample() {
  vec2 cell = mod(floor(pixel_centre), 2.0), block = floor(0.5 * pixel_centre);
  float noise = fract(52.9829189 * fract(dot(block, vec2(0.06711056, 0.00583715))));
  return 0.25 * (2.0 * abs(cell.x - cell.y) + cell.y + noise);
}

BeamLight light_under_terrain(ViewRay ray, Place start, float nu, float length_km, int sun) {
  const int kSteps = 24;
  BeamLight beam = no_beam_light();
  float reach = min(length_km, shadow_reach_km - ray.entry);
  if (reach <= 0.0) return beam;
  float begin = step_begin_of_sample();
  vec4 before = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    // Short steps near the eye, where a pixel shows more.
    vec3 part = (float(i) + vec3(0.0, begin, 1.0)) / float(kSteps);
    part *= part * reach;
    float t = part.y;
    vec4 light = beam_light(ray, start, nu, t, part.z - part.x, part.z, before);
    beam.all += light;
    beam.shaded += terrain_shade(ray.eye + (ray.entry + t) * ray.direction, sun) * light;
  }
#ifdef LESS_THAN_THE_BEAM
  beam.all += beam_light_between(ray, start, nu, reach, length_km);
#endif
  return beam;
}
#endif

#ifdef CLOUD_SHADOWS
// Of a path and of its part before each sheet that it meets.
struct LightUnderClouds {
  BeamLight path, before[CLOUDS];
};

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
LightUnderClouds light_under_clouds(ViewRay ray, Place start, float nu, float length_km, MetClouds met, int sun, int steps) {
  LightUnderClouds beam;
  beam.path = no_beam_light();
  for (int c = 0; c < CLOUDS; ++c) beam.before[c] = no_beam_light();
  vec2 part = below_sheets(ray, length_km);
  float whole = part.y - part.x;
  if (whole <= 0.0) return beam;
  vec4 before = vec4(0.0);
#ifdef LESS_THAN_THE_BEAM
  if (part.x > 0.0) {
    before = beam_light_between(ray, start, nu, 0.0, part.x);
    beam.path.all = before;
    for (int c = 0; c < CLOUDS; ++c) beam.before[c].all = before;
  }
#endif
  for (int i = 0; i < steps; ++i) {
    // Short steps near the eye, where a pixel shows more.
    float step_begin = float(i) / float(steps), step_end = float(i + 1) / float(steps);
    if (part.x == 0.0) {
      step_begin *= step_begin;
      step_end *= step_end;
    }
    float step_km = (step_end - step_begin) * whole, t = part.x + step_begin * whole + 0.5 * step_km;
    vec4 light = beam_light(ray, start, nu, t, step_km, part.x + step_end * whole, before);
    vec3 position = ray.eye + (ray.entry + t) * ray.direction;
    Place at = place_along(start, nu, t);
    // What the step's ends are apart on a sheet, seen from the sun: nothing where one looks toward it.
    float width_km = step_km * length(ray.direction - suns[sun].xyz * (at.mu / max(at.mu_s, 1e-3)));
    float shaded = 1.0 - clear_of_clouds(position, at, suns[sun].xyz, kNoCloud, width_km);
#ifdef SHADOWS
    light *= 1.0 - terrain_shade(position, sun);
#endif
    beam.path.all += light;
    beam.path.shaded += shaded * light;
    for (int c = 0; c < CLOUDS; ++c) {
      if (ray.entry + t < met.distances[c]) {
        beam.before[c].all += light;
        beam.before[c].shaded += shaded * light;
      }
    }
  }
#ifdef LESS_THAN_THE_BEAM
  beam.path.all += beam_light_between(ray, start, nu, part.y, length_km);
#endif
  return beam;
}
#endif
