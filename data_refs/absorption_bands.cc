// SPDX-License-Identifier: Apache-2.0
#include "data_refs/absorption_bands.h"

#include <algorithm>
#include <array>

namespace skyfit::refs {
namespace {

constexpr std::array<AbsorptionBand, 3> kBands = {{{686, 694, "oxygen B band, 686-694 nm"},
                                                   {715, 735, "water vapour, 715-735 nm"},
                                                   {758, 772, "oxygen A band, 758-772 nm"}}};

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

}  // namespace skyfit::refs
