// SPDX-License-Identifier: Apache-2.0
// Shorthand for the atmospheres of tests.
#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

// The scattering coefficient at a wavelength and its power law.
inline void set_scattering(Constituent<double>& c, double wavelength_nm, double per_m,
                           double exponent) {
  c.wavelength_nm = wavelength_nm;
  c.amount = per_m;
  c.angstrom_exponent = exponent;
}

inline VerticalProfile<double> tabulated_profile(TabulatedProfile table) {
  VerticalProfile<double> profile;
  profile.type = ProfileType::kTabulated;
  profile.table = std::move(table);
  return profile;
}

inline double scattering_at(const Constituent<double>& c, double wavelength_nm) {
  return c.amount * std::pow(wavelength_nm / c.wavelength_nm, -c.angstrom_exponent);
}

}  // namespace skyfit
