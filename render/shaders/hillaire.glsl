// SPDX-License-Identifier: Apache-2.0
// Light along rays by the steps of Hillaire 2020, as model/literature/hillaire_tables.h computes it: whole rays through the
// picture of the sky (his sky-view look-up), from outside the atmosphere and to surfaces step by step.
#include "render/shaders/densities.glsl"
#include "model/shared/hillaire_mapping.glsl"

layout(binding = 5) uniform sampler2D sun_transmittance_table;
layout(binding = 6) uniform sampler2D multiple_scattering_table;  // 1/sr

const float kHillaireSteps = float(HILLAIRE_STEPS);
const vec2 hillaire_view_size = vec2(HILLAIRE_SKY_VIEW);  // columns, rows of rays to the sky and to the ground

vec4 hillaire_look_up(sampler2D table, vec2 unit) {
  vec2 size = vec2(textureSize(table, 0));
  return look_up(table, 0.5 / size + clamp(unit, vec2(0.0), vec2(1.0)) * (1.0 - 1.0 / size));
}

vec4 hillaire_sun(float h, float mu_s) {
  float mu_horizon = -horizon_distance(h, bottom_km) / (bottom_km + h);
  float half_disc = bottom_km / (bottom_km + h) * kSunRadius;
  float visible = smoothstep(-half_disc, half_disc, mu_s - mu_horizon);
  if (visible <= 0.0) return vec4(0.0);
  return visible * hillaire_look_up(sun_transmittance_table,
                                    vec2(unit_from_upward_ray(h, max(mu_s, mu_horizon), bottom_km, thickness_km),
                                         bruneton_unit_from_height(h, bottom_km, thickness_km)));
}

struct March {
  Scattering light;
  vec4 transmittance;
};

March march_begin() {
  March march;
  march.light.rayleigh_like = vec4(0.0);
  for (int c = 0; c < kClasses; ++c) march.light.single[c] = vec4(0.0);
  march.transmittance = vec4(1.0);
  return march;
}

// Between two distances, km.
March march_step(March march, Place from, float nu, float begin, float end) {
  Place at = place_along(from, nu, hillaire_sample(begin, end));
  vec4 depth = (end - begin) * extinction_at(at.h);
  vec4 reaching = (end - begin) * march.transmittance *
                  mix((1.0 - exp(-depth)) / max(depth, 1e-6), 1.0 - 0.5 * depth, lessThan(depth, vec4(1e-2)));
  vec4 sun = reaching * hillaire_sun(at.h, at.mu_s);
  vec4 multiple = reaching * hillaire_look_up(multiple_scattering_table, vec2(0.5 * at.mu_s + 0.5, at.h / thickness_km));
  Scattering here = scattering_at(at.h);
  vec4 all = here.rayleigh_like;
  for (int c = 0; c < kClasses; ++c) {
    all += here.single[c];
    march.light.single[c] += sun * here.single[c];
  }
  march.light.rayleigh_like += sun * here.rayleigh_like + multiple * all / rayleigh_phase(depolarisation, nu);
  march.transmittance *= exp(-depth);
  return march;
}

Scattering hillaire_march(Place from, float nu, float length_km) {
  March march = march_begin();
  for (float i = 0.0; i < kHillaireSteps; i += 1.0) {
    march = march_step(march, from, nu, length_km * hillaire_step_begin(i, kHillaireSteps),
                       length_km * hillaire_step_begin(i + 1.0, kHillaireSteps));
  }
  return march.light;
}

// The whole ray to the sky.
Scattering hillaire_ray(Place from, float nu) {
  return hillaire_march(from, nu, distance_to_outer_sphere(bottom_km, from.h, from.mu, thickness_km));
}

// Where a direction lies in the picture of the sky, 0..1; the picture holds the rows of rays to the sky.
vec2 hillaire_place_in_view(float h, float mu, float cosine_of_turn) {
  float row = hillaire_row_from_unit(hillaire_unit_from_view(clamp(mu, -1.0, 1.0), h, bottom_km), hillaire_view_size.y);
  return vec2(texture_from_unit(hillaire_unit_from_azimuth(cosine_of_turn), hillaire_view_size.x),
              (row + 0.5) / (0.5 * hillaire_view_size.y));
}

// Of a column and a row, counted from 0: cosines of the view zenith and of the azimuth from the sun.
vec2 hillaire_direction_in_view(vec2 texel, float h) {
  return vec2(hillaire_view_from_unit(hillaire_unit_from_row(texel.y, hillaire_view_size.y), h, bottom_km),
              hillaire_azimuth_from_unit(texel.x / (hillaire_view_size.x - 1.0)));
}
