// SPDX-License-Identifier: Apache-2.0
// The star that lights the planet. Radiances of the model are per unit of its irradiance, so it
// matters to luminance, colour and absolute radiance, and to the size and look of its disc.
#pragma once

#include <array>
#include <memory>

#include "model/atmosphere/spectrum_table.h"

namespace skyfit {

// Columns wavelength_nm, ascending from at most 360 to at least 830, and irradiance_w_m2_nm, >= 0.
extern const TableFormat kIrradianceFormat;

enum class StarSpectrum {
  kSolar,      // the standard solar table, which falls with the square of the distance
  kBlackBody,  // pi B(temperature) sin^2 of the disc's radius
  kTabulated   // as it is at the planet
};

struct Star {
  StarSpectrum spectrum = StarSpectrum::kSolar;
  double distance_au = 1;                                // kSolar
  double temperature_k = 5772;                           // kBlackBody
  std::shared_ptr<const SpectrumTable> table = nullptr;  // kTabulated
  double angular_diameter_deg = 0.5334;                  // 2 x 4.6548e-3 rad: the sun at 1 au
  // I(mu) / I(1) = 1 - u1 (1 - mu) - u2 (1 - mu)^2, mu the cosine from the disc's centre: the sun's
  // in green light (Cox 2000, Allen's Astrophysical Quantities, 14.7, as one term).
  std::array<double, 2> limb_darkening = {0.6, 0};

  double angular_radius_rad() const;

  bool operator==(const Star&) const = default;
};

// Throws std::invalid_argument as validate(Atmosphere) does.
void validate(const Star& star);

// Black body of that temperature and angular size, W m^-2 nm^-1 at normal incidence (Planck).
double black_body_irradiance(double wavelength_nm, double temperature_k, double angular_radius_rad);

}  // namespace skyfit
