// SPDX-License-Identifier: Apache-2.0
// Morphological antialiasing (Reshetov 2009, "Morphological antialiasing", 2.2) of the line between
// sky and ground, for pictures with one sample to a pixel: along such a line the steps of rows and
// columns are replaced by the straight pieces between the steps' middles.
#pragma once

#include <cstddef>
#include <vector>

namespace skyfit {

struct SilhouettePixel {
  std::size_t pixel, beside;  // beside: across the line
  double share;               // of the pixel that what is beside it covers, 0 to 1/2
};

// `is_sky`: [pixel], rows of `width`.
std::vector<SilhouettePixel> silhouette(const std::vector<bool>& is_sky, int width, int height);

}  // namespace skyfit
