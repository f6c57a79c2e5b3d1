// SPDX-License-Identifier: Apache-2.0
// The samples of a figure, sorted by sun position.
#pragma once

#include <vector>

#include "render/plot/comparison.h"

namespace skyfit::plot {

// Everything that the figure shows at one sun position. Indexed by curve.
struct SunSamples {
  double sun_zenith_deg = 0;
  std::vector<std::vector<Sample>> plane;  // in the principal plane, by signed view zenith
  std::vector<std::vector<Sample>> hemisphere;
};

// All sun positions of the figure, ascending, at most kMaxPanels; `total` says how many the data
// has.
struct Suns {
  std::vector<SunSamples> shown;
  std::size_t total = 0;
  bool has_hemisphere = false;
};
Suns samples_by_sun(const Comparison& comparison);

}  // namespace skyfit::plot
