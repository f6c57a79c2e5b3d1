// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skyfit {

// One wavelength at which the model is solved.
struct WavelengthNode {
  double wavelength_nm;
  double ozone_cross_section_m2;
  bool operator==(const WavelengthNode&) const = default;
};

}  // namespace skyfit
