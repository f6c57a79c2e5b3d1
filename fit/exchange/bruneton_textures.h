// SPDX-License-Identifier: Apache-2.0
// The textures that the shaders of Bruneton 2017 (Precomputed Atmospheric Scattering: a New
// Implementation, functions.glsl, constants.h) read, filled with the light of our own solver.
#pragma once

#include <functional>
#include <vector>

#include "fit/exchange/engine_form.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {

// max_sun_zenith_angle, rad: 108 deg, twilight included.
inline constexpr double kHighestSun = 108 * kRadiansPerDegree;

// Their sizes, those of constants.h: texels along mu or sun, along height, of suns and of nu.
struct BrunetonSizes {
  int transmittance_mu = 256, transmittance_r = 64;
  int irradiance_mu_s = 64, irradiance_r = 16;
  int scattering_r = 32, scattering_mu = 128, scattering_mu_s = 32, scattering_nu = 8;
};

// [texel][4] of 680, 550 and 440 nm and 0, but in `scattering` single Mie scattering of 680 nm, x
// fastest: transmittance to the top (mu by r); diffuse
// irradiance of a level surface, W m^-2 nm^-1 (mu_s by r); radiance over the Rayleigh phase
// function and of single Mie scattering over its own, W m^-2 nm^-1 sr^0 (nu and mu_s, mu, r), whose
// sum times the phase functions 3 (1 + nu^2) / (16 pi) and Cornette & Shanks' is the sky.
struct BrunetonTextures {
  std::vector<float> transmittance, irradiance, scattering, single_mie;
};

// Of the model `reference` without polarisation, by its tables for renderers; suns stand up to
// `highest_sun` from the zenith, rad. The irradiance of the sun is engine_solar_irradiance().
BrunetonTextures bruneton_textures(const EngineAtmosphere& engine, const Star& star,
                                   const SpectralData& spectra, double highest_sun,
                                   const BrunetonSizes& sizes, int threads,
                                   const std::function<void(double)>& progress);

// At the wavelengths of the textures, W m^-2 nm^-1.
Rgb engine_solar_irradiance(const SpectralData& spectra);

}  // namespace skyfit::fit
