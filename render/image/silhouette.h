// SPDX-License-Identifier: Apache-2.0
// Morphological antialiasing (Reshetov 2009, "Morphological antialiasing", 2.2) of the line between
// sky and ground: along it the steps of rows and columns of samples are replaced by the straight
// pieces between the steps' middles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skyfit {

struct SilhouetteSample {
  std::size_t sample, beside;  // beside: across the line
  double share;                // of the sample's area that what is beside it covers, 0 to 1/2
};

// `is_sky`: [sample] 0 or 1, rows of `width`.
std::vector<SilhouetteSample> silhouette(std::span<const std::uint8_t> is_sky, int width,
                                         int height);

}  // namespace skyfit
