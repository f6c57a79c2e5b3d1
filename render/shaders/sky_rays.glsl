// SPDX-License-Identifier: Apache-2.0
// Light of whole rays that miss the ground from the tables of model/tables/sky_rays.h. SKY_RAYS: which of its mappings.
#include "render/shaders/densities.glsl"
#include "model/shared/bodare_mapping.glsl"
#include "model/shared/bruneton_mapping.glsl"

layout(binding = 5) uniform sampler3D sky_ray_air;
layout(binding = 6) uniform sampler3D sky_ray_aerosol;

const vec3 sky_ray_size = vec3(SKY_RAY_SIZE);

Scattering sky_ray_texels(vec3 at) {
  Scattering texels = look_up_classes(sky_ray_air, sky_ray_aerosol, at);
#ifdef ENCODED
  texels = decoded(texels, texel_scale.zw, texel_offset.zw);
#endif
  return texels;
}

vec3 texture_from_units(vec3 unit) {
  return 0.5 / sky_ray_size + clamp(unit, vec3(0.0), vec3(1.0)) * (1.0 - 1.0 / sky_ray_size);
}

#if SKY_RAYS == 0  // from outside
Scattering sky_ray_scattering(Place from, float nu) {
  TableRay ray = table_ray(from, nu, false);
  vec3 at = texture_from_units(vec3(ray.sun, ray.azimuth, 0.0));
  at.z = texture_from_view(from.h, from.mu, false, 0.0, sky_ray_size.z, bottom_km, thickness_km, deck_km());
  return scaled(exponential(sky_ray_texels(at)), ray.light);
}
#elif SKY_RAYS == 1  // Bruneton
Scattering sky_ray_scattering(Place from, float nu) {
  const float kNu = float(BRUNETON_NU);
  float turn = bruneton_unit_from_nu(nu) * (kNu - 1.0);
  float first = min(floor(turn), kNu - 2.0);
#ifdef BRUNETON_BY_RADII  // all rays, those to the ground in the first half of the rows
  float r = bottom_km + from.h, top = bottom_km + thickness_km;
  bool ground = bruneton_meets_ground(r, from.mu, bottom_km);
  float half_rows = 0.5 * sky_ray_size.y;
  float view = ground ? bruneton_ground_unit_by_radius(r, from.mu, bottom_km)
                      : bruneton_sky_unit_by_radius(r, from.mu, bottom_km, top);
  vec3 near = texture_from_units(vec3(0.0, 0.0, bruneton_unit_from_radius(r, bottom_km, top)));
  near.y = 0.5 * (texture_from_unit(clamp(view, 0.0, 1.0), half_rows) + (ground ? 0.0 : 1.0));
#else
  vec3 near = texture_from_units(vec3(0.0, unit_from_upward_ray(from.h, from.mu, bottom_km, thickness_km),
                                      bruneton_unit_from_height(from.h, bottom_km, thickness_km)));
#endif
  float sun = bruneton_unit_from_sun(max(from.mu_s, LOWEST_SUN), LOWEST_SUN, bottom_km, thickness_km);
  near.x = (first + texture_from_unit(clamp(sun, 0.0, 1.0), sky_ray_size.x / kNu)) / kNu;
  Scattering low = sky_ray_texels(near), high = sky_ray_texels(near + vec3(1.0 / kNu, 0.0, 0.0));
  return scaled(between(low, high, turn - first), deep_twilight(from.mu_s));
}
#elif SKY_RAYS == 2  // Bodare
Scattering sky_ray_scattering(Place from, float nu) {
  float view = bodare_unit_from_sky_view(from.mu, bodare_horizon(from.h, bottom_km));
  Scattering texels = sky_ray_texels(texture_from_units(
      vec3(bodare_unit_from_sun(from.mu_s), view, bodare_unit_from_height(from.h, thickness_km))));
  float dusk = exp(min((from.mu_s - bodare_sun_from_unit(0.0)) * 57.3, 0.0));
  texels.rayleigh_like *= own_air_phase(nu);
  return scaled(texels, dusk);
}
#elif SKY_RAYS == 3  // Schafhitzel
Scattering sky_ray_scattering(Place from, float nu) {
  return sky_ray_texels(texture_from_units(
      vec3(kInversePi * acos(from.mu_s), kInversePi * acos(from.mu), from.h / thickness_km)));
}
#endif
