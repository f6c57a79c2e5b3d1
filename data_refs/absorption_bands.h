// SPDX-License-Identifier: Apache-2.0
// Wavelengths at which gases absorb that the models do not have.
#pragma once

#include <span>
#include <string_view>

#include "data_refs/samples.h"

namespace skyfit::refs {

struct AbsorptionBand {
  double shortest_nm, longest_nm;
  std::string_view reason;  // "oxygen B band, 686-694 nm"
};

// Oxygen B 686-694 nm, water vapour 715-735 nm, oxygen A 758-772 nm; of the infrared what lies
// between the windows at 870, 1020 to 1070 and 1640 nm.
std::span<const AbsorptionBand> absorption_bands();

// Gives spectral samples inside the bands weight 0 and the reason. The number of samples that had a
// weight before.
int mask_absorption_bands(Reference& reference);

// Gives spectral samples outside the model's spectra weight 0 and this reason.
inline constexpr std::string_view kOutsideSpectra = "wavelength outside the model's 300 to 2500 nm";
void mask_unknown_wavelengths(Reference& reference);

}  // namespace skyfit::refs
