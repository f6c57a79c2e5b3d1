// SPDX-License-Identifier: Apache-2.0
// Light on a surface in the air or above it: sun, sky and the ground around, per unit irradiance of the first sun.
#include "render/shaders/atmosphere.glsl"

// A point above the atmosphere is lit through the air that the sun's rays cross on their way.
Place where_light_enters(Place at) {
#ifdef VOLUME  // the ground is in the air
  return at;
#else
  if (at.h <= thickness_km) return at;
  float r = bottom_km + at.h, top = bottom_km + thickness_km;
  float impact = r * sqrt(max(1.0 - at.mu_s * at.mu_s, 0.0));
  bool crosses = at.mu_s < 0.0 && impact < top;
  float half_chord = sqrt(max((top - impact) * (top + impact), 0.0));
  return place_at(thickness_km, at.mu, crosses ? -half_chord / top : 1.0);
#endif
}

// Of the sun's beam alone, see below.
vec4 direct_irradiance(Place at, vec3 normal, vec3 sun, float lit) {
  Place entry = where_light_enters(at);
  return lit * sun_transmittance(entry.h, entry.mu_s) * max(dot(normal, sun), 0.0);
}

// The irradiance of a surface that faces `normal`; `lit` is the part of the sun's beam that nothing shades.
vec4 surface_irradiance(Place at, vec3 normal, vec3 up, vec3 sun, float lit) {
  Place entry = where_light_enters(at);
  vec4 beam = sun_transmittance(entry.h, entry.mu_s);
  vec4 sky = sky_irradiance(entry.h, at.mu_s);
  float facing = dot(normal, up);
  // The planet fills less of the lower hemisphere from afar.
  float nearness = bottom_km / (bottom_km + at.h);
  vec4 around = ground_albedo * (beam * max(at.mu_s, 0.0) + sky) * (nearness * nearness);
  return lit * beam * max(dot(normal, sun), 0.0) + sky * (0.5 + 0.5 * facing) + around * (0.5 - 0.5 * facing);
}
