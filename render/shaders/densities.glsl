// SPDX-License-Identifier: Apache-2.0
// How much the classes of phase functions scatter over height, and the extinction.
#include "render/shaders/atmosphere.glsl"

layout(binding = 13) uniform sampler2D scattering_coefficients;  // 1/km; rows: the Rayleigh-like class, the others, all extinction

Scattering scattering_at(float h) {
  float x = height_coordinate(h, float(textureSize(scattering_coefficients, 0).x));
  Scattering s;
  s.rayleigh_like = texture(scattering_coefficients, vec2(x, 0.5 / float(kClasses + 2)));
  for (int c = 0; c < kClasses; ++c)
    s.single[c] = texture(scattering_coefficients, vec2(x, (float(c) + 1.5) / float(kClasses + 2)));
  return s;
}

// The phase function of air over that of the tables, where the model has its own.
float own_air_phase(float nu) {
#if defined(BODARE)
  return elek_rayleigh_phase(nu) / rayleigh_phase(depolarisation, nu);
#elif defined(ONEIL_ISOTROPIC_AIR)
  return 0.25 * kInversePi / rayleigh_phase(depolarisation, nu);
#else
  return 1.0;
#endif
}

vec4 extinction_at(float h) {
  float x = height_coordinate(h, float(textureSize(scattering_coefficients, 0).x));
  return texture(scattering_coefficients, vec2(x, 1.0 - 0.5 / float(kClasses + 2)));
}

// 1 - exp(-depth); by its series where the difference would lose digits, to 4e-7.
vec4 share_taken(vec4 depth) {
  return mix(1.0 - exp(-depth), depth * (1.0 - 0.5 * depth * (1.0 - depth * (1.0 / 3.0))), lessThan(depth, vec4(0.02)));
}
