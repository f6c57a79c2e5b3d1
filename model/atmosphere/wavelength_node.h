// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skyfit {

// One wavelength at which the model is solved.
struct WavelengthNode {
  double wavelength_nm;
  double ozone_cross_section_m2;                 // per molecule
  double oxygen_pair_cross_section_m5 = 0;       // per squared number density and length
  double nitrogen_dioxide_cross_section_m2 = 0;  // per molecule
  bool operator==(const WavelengthNode&) const = default;
};

}  // namespace skyfit
