// SPDX-License-Identifier: Apache-2.0
// The physics that an atmosphere says, next to what the literature calls plausible for clear air.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/atmosphere.h"

namespace skyfit::fit {

struct Finding {
  std::string_view name;  // "aerosol optical depth at 550 nm"
  std::string_view key;   // of report.json
  double value;
  double lower, upper;  // plausible
  std::string_view source;
  bool plausible() const { return value >= lower && value <= upper; }
};

// Aerosol optical depth, Angstrom exponent, turbidity, single scattering albedo, mean cosine of
// the scattering angle (not g of Cornette & Shanks), of a cloud optical depth and mean cosine,
// ground albedo. Turbidity is (tau_air + tau_aerosol) / tau_air at 550 nm (Preetham et al. 1999,
// with vertical optical depths).
std::vector<Finding> findings(const Atmosphere<double>& atmosphere);

}  // namespace skyfit::fit
