// SPDX-License-Identifier: Apache-2.0
// Single scattering summed over samples in the middle of equal steps along the ray, O'Neil 2005, as
// model/literature/oneil.cc computes it: ONEIL_SAMPLES of them; ONEIL_POLYNOMIAL: optical depths by his polynomial;
// ONEIL_ISOTROPIC_AIR (densities.glsl), ONEIL_NO_SHADOW: his demo's choices.
#include "render/shaders/densities.glsl"

// From a point to the top, by the zenith angle there.
vec4 oneil_depth_to_top(float h, float mu) {
#ifdef ONEIL_POLYNOMIAL
  Scattering here = scattering_at(h);
  vec4 all = here.rayleigh_like;
  for (int c = 0; c < kClasses; ++c) all += here.single[c];
  return (0.25 * thickness_km * oneil_slant(mu)) * all;  // his scale height: a quarter of the thickness
#else
  return optical_depth_past_ground(h, mu);
#endif
}

// From the ray's beginning to a point on it; seen from the end that looks up.
vec4 oneil_depth_between(Place from, Place at) {
  if (at.mu < 0.0) return oneil_depth_to_top(at.h, -at.mu) - oneil_depth_to_top(from.h, -from.mu);
  vec4 beyond = oneil_depth_to_top(at.h, at.mu);
  if (from.mu >= 0.0) return oneil_depth_to_top(from.h, from.mu) - beyond;
  float lowest = max(height_after(bottom_km, from.h, from.mu, -(bottom_km + from.h) * from.mu), 0.0);
  return 2.0 * oneil_depth_to_top(lowest, 0.0) - oneil_depth_to_top(from.h, -from.mu) - beyond;
}

Scattering oneil_sum(Place from, float nu, float length_km) {
  float step_km = length_km / float(ONEIL_SAMPLES);
  Scattering sum;
  sum.rayleigh_like = vec4(0.0);
  for (int c = 0; c < kClasses; ++c) sum.single[c] = vec4(0.0);
  for (int i = 0; i < ONEIL_SAMPLES; ++i) {
    Place at = place_along(from, nu, (float(i) + 0.5) * step_km);
#ifndef ONEIL_NO_SHADOW
    if (ray_hits_ground(at.h, at.mu_s, bottom_km)) continue;
#endif
    vec4 through = exp(-max(oneil_depth_between(from, at), 0.0) - oneil_depth_to_top(at.h, at.mu_s));
    Scattering here = scattering_at(at.h);
    sum.rayleigh_like += here.rayleigh_like * through;
    for (int c = 0; c < kClasses; ++c) sum.single[c] += here.single[c] * through;
  }
  sum.rayleigh_like *= own_air_phase(nu);
  return scaled(sum, step_km);
}

// The whole ray to the sky.
Scattering oneil_ray(Place from, float nu) {
  return oneil_sum(from, nu, distance_to_outer_sphere(bottom_km, from.h, from.mu, thickness_km));
}
