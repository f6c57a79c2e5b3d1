// SPDX-License-Identifier: Apache-2.0
// Light along straight paths by the closed forms of Nielsen 2003 (NIELSEN), of Hoffman & Preetham 2002, and of the formulas over
// the turbidity (FORMULA_SKY) of Preetham, Shirley & Smits 1999 and of Hosek & Wilkie 2012 (HOSEK_WILKIE), as
// model/literature/nielsen.cc, hoffman_preetham.cc, preetham.cc and hosek_wilkie.cc compute it, with the ground at its own
// height. They know no light from below the horizon and no space. Included by atmosphere.glsl, which has the constants and the
// formulas.
#ifdef FORMULA_SKY
#include "model/shared/preetham.glsl"
#endif
#ifdef HOSEK_WILKIE
#include "model/shared/hosek_wilkie.glsl"
#endif
#ifdef NIELSEN
#include "model/shared/nielsen_horizon.glsl"
#endif

vec4 closed_form_dimming(float air_m, float aerosol_m) { return exp(-(air_beta * air_m + aerosol_beta * aerosol_m)); }

#ifdef NIELSEN
vec4 closed_form_to_sky(float h, float mu) {
  float level_mu = nielsen_level_mu(mu, h, bottom_km);
  return closed_form_dimming(nielsen_air_sky_depth(level_mu, 1e3 * h), nielsen_aerosol_sky_depth(level_mu, 1e3 * h));
}

float nielsen_path_depth(float from_m, float to_m, float length_m, float scale_height_m) {
#ifdef NIELSEN_MEAN_HEIGHT
  return nielsen_mean_height_depth(from_m, to_m, length_m, scale_height_m);
#else
  return nielsen_terrain_depth(from_m, to_m, length_m, scale_height_m);
#endif
}

vec4 closed_form_in_air(float from_h, float to_h, float length_km) {
  float from_m = 1e3 * from_h, to_m = 1e3 * to_h, length_m = 1e3 * length_km;
  return closed_form_dimming(nielsen_path_depth(from_m, to_m, length_m, nielsen_air_scale_height()),
                             nielsen_path_depth(from_m, to_m, length_m, nielsen_aerosol_scale_height()));
}

vec4 closed_form_sun(float h, float mu_s) {
#ifdef NIELSEN_PUBLISHED_SUN
  return vec4(nielsen_sunlight(nielsen_haze.y));
#else
  return closed_form_to_sky(h, mu_s);
#endif
}

float closed_form_air_phase(float nu) {
#ifdef NIELSEN_PUBLISHED_PHASE
  return nielsen_air_phase(nu);
#else
  return rayleigh_phase(depolarisation, nu);
#endif
}

vec4 closed_form_aerosol_phase(float h, float mu_s, float nu) {
  float g = nielsen_asymmetry(1e3 * h, acos(clamp(mu_s, -1.0, 1.0)), nielsen_haze.y, nielsen_haze.x);
  return vec4(lobe_phase(NIELSEN_LOBE, g, nu));
}
#else
vec4 closed_form_to_sky(float h, float mu) {
  return closed_form_dimming(scale_heights_m.x * relative_air_mass(mu), scale_heights_m.y * relative_air_mass(mu));
}

vec4 closed_form_in_air(float from_h, float to_h, float length_km) {
#ifdef FORMULA_SKY
  return closed_form_dimming(preetham_path_depth(1e3 * from_h, 1e3 * to_h, 1e3 * length_km, scale_heights_m.x),
                             preetham_path_depth(1e3 * from_h, 1e3 * to_h, 1e3 * length_km, scale_heights_m.y));
#else
  return closed_form_dimming(1e3 * length_km, 1e3 * length_km);
#endif
}

vec4 closed_form_sun(float h, float mu_s) { return closed_form_to_sky(h, mu_s); }

float closed_form_air_phase(float nu) { return rayleigh_phase(depolarisation, nu); }

vec4 closed_form_aerosol_phase(float h, float mu_s, float nu) { return class_phase(0, nu); }
#endif

// What a path from a place in the air lets through; it ends at a height, or outside of the air.
vec4 closed_form_through(Place from, float to_h, float length_km) {
  return to_h < thickness_km ? closed_form_in_air(from.h, to_h, length_km) : closed_form_to_sky(from.h, from.mu);
}

// What a mixture with such coefficients scatters of light on its way; `air` and `aerosol`: the light times the phase functions.
vec4 closed_form_mixture(vec4 air_extinction, vec4 air, vec4 aerosol_extinction, vec4 aerosol, vec4 through) {
  vec4 sum;
  for (int k = 0; k < 4; ++k)
    sum[k] = mixed_path_inscatter(air_extinction[k], air[k], aerosol_extinction[k], aerosol[k], through[k]);
  return sum;
}

#ifdef FORMULA_SKY
vec4 sky_irradiance(float h, float mu_s);

// X, Y and Z of the sky, cd/m^2.
#ifdef HOSEK_WILKIE
TABLE(5, sampler2D, hosek_wilkie_curves)

vec3 formula_xyz(float mu, float gamma, float nu, float sun_zenith) {
  float elevation = hosek_wilkie_elevation(sun_zenith);
  vec3 shape[10];
  for (int i = 0; i < 10; ++i) shape[i] = vec3(0.0);
  for (int k = 0; k < 6; ++k) {
    float weight = hosek_wilkie_weight(k, elevation);
    for (int i = 0; i < 10; ++i) shape[i] += weight * texelFetch(hosek_wilkie_curves, ivec2(i, k), 0).xyz;
  }
  vec3 xyz;
  for (int c = 0; c < 3; ++c)
    xyz[c] = hosek_wilkie_light(mu, gamma, nu, shape[0][c], shape[1][c], shape[2][c], shape[3][c], shape[4][c], shape[5][c],
                                shape[6][c], shape[7][c], shape[8][c], shape[9][c]);
  return xyz;
}
#else
vec3 formula_xyz(float mu, float gamma, float nu, float sun_zenith) {
  float luminance = preetham_luminance(turbidity, mu, gamma, sun_zenith);
  float x = preetham_x(turbidity, mu, gamma, sun_zenith), y = preetham_y(turbidity, mu, gamma, sun_zenith);
  return (luminance / y) * vec3(x, y, 1.0 - x - y);
}
#endif

vec4 closed_form_sky(Place from, float nu) {
  if (from.mu_s <= 0.0) return vec4(0.0);
  float mu = max(from.mu, 1e-3);  // below the horizon: as at it
  vec3 xyz = formula_xyz(mu, acos(clamp(nu, -1.0, 1.0)), nu, acos(from.mu_s));
  return xyz.x * radiance_from_xyz[0] + xyz.y * radiance_from_xyz[1] + xyz.z * radiance_from_xyz[2];
}

// What a path scatters toward its beginning, of the sun's beam and of `sky`, the light of the sky from each of its directions.
// In each step the proportion of air and aerosol is that of its middle.
vec4 preetham_path(Place from, float nu, float to_h, float length_km, vec4 sky) {
  const int kSteps = 8;
  vec4 beam = closed_form_sun(from.h, from.mu_s);
  vec4 air = beam * closed_form_air_phase(nu) + 0.5 * sky;
  vec4 aerosol = beam * closed_form_aerosol_phase(from.h, from.mu_s, nu) + 0.5 * sky;
  vec4 sum = vec4(0.0), before = vec4(1.0);
  float share_before = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    // Short steps at the lower end, where the aerosol changes most.
    float near = float(i) / float(kSteps), share = to_h > from.h ? near * near : near * (2.0 - near);
    vec4 through = closed_form_in_air(from.h, mix(from.h, to_h, share), share * length_km);
    vec2 density = exp(-1e3 * mix(from.h, to_h, 0.5 * (share_before + share)) / scale_heights_m);
    share_before = share;
    sum += before * closed_form_mixture(density.x * air_beta, air, density.y * aerosol_beta, aerosol,
                                        through / max(before, 1e-30));
    before = through;
  }
  return sum;
}

// Up to where it ends, at a height, or outside of the air. Light of the sky comes evenly from its half of all directions.
vec4 closed_form_inscatter(Place from, float nu, float to_h, float length_km) {
  if (from.mu_s <= 0.0) return vec4(0.0);
  if (to_h >= thickness_km) return closed_form_sky(from, nu);
  return preetham_path(from, nu, to_h, length_km, sky_irradiance(from.h, from.mu_s) * kInversePi);
}

// The part of it that is the sun's beam's, within the air.
vec4 closed_form_beam_inscatter(Place from, float nu, float to_h, float length_km) {
  return from.mu_s <= 0.0 ? vec4(0.0) : preetham_path(from, nu, to_h, length_km, vec4(0.0));
}
#else
// What it scatters toward its beginning.
vec4 closed_form_inscatter(Place from, float nu, float to_h, float length_km) {
  if (from.mu_s <= 0.0) return vec4(0.0);
  return closed_form_sun(from.h, from.mu_s) *
         closed_form_mixture(air_beta, vec4(closed_form_air_phase(nu)), aerosol_beta,
                             closed_form_aerosol_phase(from.h, from.mu_s, nu), closed_form_through(from, to_h, length_km));
}

// All of it is the sun's beam's.
vec4 closed_form_beam_inscatter(Place from, float nu, float to_h, float length_km) {
  return closed_form_inscatter(from, nu, to_h, length_km);
}

vec4 closed_form_sky(Place from, float nu) { return closed_form_inscatter(from, nu, thickness_km, 0.0); }
#endif
