// SPDX-License-Identifier: Apache-2.0
// The atmosphere that real-time engines hold (Bruneton 2017, Hillaire 2020 and what followed them):
// air and one aerosol with exponential profiles, one lobe, and an absorber in a tent; coefficients
// for red, green and blue, taken as those of 680, 550 and 440 nm.
#pragma once

#include <array>

#include "model/atmosphere/atmosphere.h"
#include "model/photometry/photometry.h"

namespace skyfit::fit {

using Rgb = std::array<double, 3>;
inline constexpr Rgb kEngineWavelengths_nm = {680, 550, 440};

struct EngineAtmosphere {
  double bottom_radius_m = 6360e3, top_radius_m = 6460e3;
  Rgb rayleigh_scattering{};  // 1/m at the bottom radius
  double rayleigh_scale_height_m = 8000;
  Rgb mie_scattering{}, mie_absorption{};  // 1/m at the bottom radius
  double mie_scale_height_m = 1200;
  double g = 0.8;
  PhaseType lobe = PhaseType::kHenyeyGreenstein;  // or kCornetteShanks
  Rgb absorption{};                               // 1/m at the tip of the tent
  double tent_peak_m = 25e3, tent_half_width_m = 15e3;
  Rgb ground_albedo{};
};

// The nearest of that form without any fit: optical depths, their dependence on wavelength, the
// absorbers' optical depth and the aerosols' mean cosine stay; scale heights and the tent are those
// of the constituents that have one, the largest first.
Atmosphere<double> engine_form(const Atmosphere<double>& atmosphere, const SpectralData& spectra,
                               PhaseType lobe);

// Between the two; `atmosphere` is of that form, with the constituents "rayleigh" and, if any,
// "mie" and "absorber". An aerosol that only absorbs is left out. A dependence on wavelength is a
// power law through red and blue where that meets green within 2 %, else a table.
EngineAtmosphere engine_atmosphere(const Atmosphere<double>& atmosphere);
Atmosphere<double> atmosphere_of(const EngineAtmosphere& engine);

}  // namespace skyfit::fit
