// SPDX-License-Identifier: Apache-2.0
// Light along straight paths by the closed forms of Nielsen 2003 (NIELSEN) and of Hoffman & Preetham 2002, as
// model/literature/nielsen.cc and hoffman_preetham.cc compute it, with the ground at its own height. They know no light from
// below the horizon, no shadow in the air and no space. Included by atmosphere.glsl, which has the constants and the formulas.

vec4 closed_form_dimming(float air_m, float aerosol_m) { return exp(-(air_beta * air_m + aerosol_beta * aerosol_m)); }

#ifdef NIELSEN
vec4 closed_form_to_sky(float h, float mu) {
  return closed_form_dimming(nielsen_air_sky_depth(mu, 1e3 * h), nielsen_aerosol_sky_depth(mu, 1e3 * h));
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
  return closed_form_dimming(1e3 * length_km, 1e3 * length_km);
}

vec4 closed_form_sun(float h, float mu_s) { return closed_form_to_sky(h, mu_s); }

float closed_form_air_phase(float nu) { return rayleigh_phase(depolarisation, nu); }

vec4 closed_form_aerosol_phase(float h, float mu_s, float nu) { return class_phase(0, nu); }
#endif

// What a path from a place in the air lets through; it ends at a height, or outside of the air.
vec4 closed_form_through(Place from, float to_h, float length_km) {
  return to_h < thickness_km ? closed_form_in_air(from.h, to_h, length_km) : closed_form_to_sky(from.h, from.mu);
}

// What it scatters toward its beginning.
vec4 closed_form_inscatter(Place from, float nu, vec4 through) {
  if (from.mu_s <= 0.0) return vec4(0.0);
  float air = closed_form_air_phase(nu);
  vec4 aerosol = closed_form_aerosol_phase(from.h, from.mu_s, nu), sum;
  for (int k = 0; k < 4; ++k) sum[k] = mixed_path_inscatter(air_beta[k], air, aerosol_beta[k], aerosol[k], through[k]);
  return closed_form_sun(from.h, from.mu_s) * sum;
}

vec4 closed_form_sky(Place from, float nu) {
  return closed_form_inscatter(from, nu, closed_form_to_sky(from.h, from.mu));
}
