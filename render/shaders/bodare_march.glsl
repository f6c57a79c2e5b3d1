// SPDX-License-Identifier: Apache-2.0
// Light scattered into a path step by step, Bodare & Sandberg 2014, 6.4.2: of the sun and of all that the air gathers there
// from every side, which their table `gathered` holds over height and sun (model/literature/bodare_tables.h).
#include "render/shaders/densities.glsl"
#include "model/shared/bodare_mapping.glsl"

layout(binding = 15) uniform sampler2D gathered_table;  // x: sun, y: height

vec4 gathered_light(Place at) {
  vec2 size = vec2(textureSize(gathered_table, 0));
  vec2 unit = vec2(bodare_unit_from_sun(at.mu_s), bodare_unit_from_height(at.h, thickness_km));
  float dusk = exp(min((at.mu_s - bodare_sun_from_unit(0.0)) * 57.3, 0.0));
  return dusk * look_up(gathered_table, 0.5 / size + clamp(unit, vec2(0.0), vec2(1.0)) * (1.0 - 1.0 / size));
}

struct March {
  Scattering light;
  vec4 depth;  // optical, from the beginning
};

March march_begin() {
  March march;
  march.light.rayleigh_like = vec4(0.0);
  for (int c = 0; c < kClasses; ++c) march.light.single[c] = vec4(0.0);
  march.depth = vec4(0.0);
  return march;
}

// Where a step begins, as a share of the path: short ones in the denser air, at the beginning or at the ground.
const float kMarchSteps = 16.0;
float march_share(float step, bool downward) {
  float x = step / kMarchSteps;
  return downward ? x * (2.0 - x) : x * x;
}

// Between two distances, km: the light that falls on the middle of the step, as much of it as gets through from all of it.
March march_step(March march, Place from, float nu, float begin, float end, bool downward) {
  const vec4 least = vec4(1e-12);
  Place at = place_along(from, nu, 0.5 * (begin + end));
  vec4 depth = optical_depth_between(from, place_along(from, nu, end), downward);
  vec4 of_step = max(depth - march.depth, least);
  vec4 light = (end - begin) * exp(-march.depth) * (share_taken(of_step) / of_step) *
               (sun_transmittance(at.h, at.mu_s) + gathered_light(at));
  Scattering here = scattering_at(at.h);
  march.light.rayleigh_like += own_air_phase(nu) * light * here.rayleigh_like;
  for (int c = 0; c < kClasses; ++c) march.light.single[c] += light * here.single[c];
  march.depth = depth;
  return march;
}

// For each pixel, where there is no volume.
Scattering bodare_march(Place from, float nu, float length_km, bool downward) {
  March march = march_begin();
  for (float i = 0.0; i < kMarchSteps; i += 1.0) {
    march = march_step(march, from, nu, length_km * march_share(i, downward), length_km * march_share(i + 1.0, downward), downward);
  }
  return march.light;
}
