// SPDX-License-Identifier: Apache-2.0
// How the ground's albedo depends on wavelength: a tabulated shape that is 1 at 550 nm.
#pragma once

#include "model/atmosphere/spectrum_table.h"

namespace skyfit {

// Columns wavelength_nm, ascending, and relative_albedo, >= 0 and > 0 at 550 nm; any factor.
extern const TableFormat kGroundFormat;

class GroundSpectrum {
 public:
  static constexpr double kWavelengthNm = 550;  // where the shape is 1

  // Divides by the value at 550 nm. Throws std::invalid_argument unless the table is as
  // kGroundFormat demands.
  explicit GroundSpectrum(TwoColumns table);

  const TwoColumns& table() const { return table_; }
  double at(double wavelength_nm) const { return clamped_interpolation(table_, wavelength_nm); }

 private:
  TwoColumns table_;
};

// docs/theory (2.16).
// A is Atmosphere of any scalar. The albedo at a wavelength: a shape that would exceed 1 stays
// there.
template <class A>
auto ground_albedo_at(const A& atmosphere, double wavelength_nm) {
  auto albedo = atmosphere.ground_albedo;
  if (atmosphere.ground_spectrum) {
    albedo = albedo * decltype(albedo)(atmosphere.ground_spectrum->at(wavelength_nm));
    if (albedo > decltype(albedo)(1.0)) albedo = decltype(albedo)(1.0);
  }
  return albedo;
}

}  // namespace skyfit
