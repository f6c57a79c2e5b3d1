// SPDX-License-Identifier: Apache-2.0
#include "data_refs/absorption_bands.h"

#include <algorithm>
#include <array>

#include "data_refs/spectra.h"

namespace skyfit::refs {
namespace {

// Beyond 830 nm: where SPECTRL2 (Bird & Riordan 1984) has an absorption coefficient above 0.02.
constexpr std::array<AbsorptionBand, 7> kBands = {
    {{686, 694, "oxygen B band, 686-694 nm"},
     {715, 735, "water vapour, 715-735 nm"},
     {758, 772, "oxygen A band, 758-772 nm"},
     {890, 1000, "water vapour, 890-1000 nm"},
     {1085, 1620, "water vapour, oxygen and carbon dioxide, 1085-1620 nm"},
     {1660, 2180, "water vapour and carbon dioxide, 1660-2180 nm"},
     {2180, 2500, "water vapour and methane, 2180-2500 nm"}}};

}  // namespace

std::span<const AbsorptionBand> absorption_bands() { return kBands; }

int mask_absorption_bands(Reference& reference) {
  int masked = 0;
  for (Sample& sample : reference.samples) {
    const auto band = std::ranges::find_if(kBands, [&](const AbsorptionBand& b) {
      return sample.wavelength_nm >= b.shortest_nm && sample.wavelength_nm <= b.longest_nm;
    });
    if (band == kBands.end() || sample.weight == 0) continue;
    sample.weight = 0;
    sample.zero_weight_reason = band->reason;
    ++masked;
  }
  return masked;
}

void mask_unknown_wavelengths(Reference& reference) {
  for (Sample& sample : reference.samples) {
    if (sample.weight == 0 || sample.wavelength_nm == 0 ||
        has_spectra_at(standard_spectral_data(), sample.wavelength_nm))
      continue;
    sample.weight = 0;
    sample.zero_weight_reason = kOutsideSpectra;
  }
}

}  // namespace skyfit::refs
