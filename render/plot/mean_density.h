// SPDX-License-Identifier: Apache-2.0
// Nielsen 2003, figure 5.2: the mean of an exponential density along a vertical path between the
// ground and an eye, by the integral and by the two ways in which `nielsen` takes it.
#pragma once

#include "render/plot/figure_file.h"

namespace skyfit::plot {

// Densities relative to that at height 0.
struct MeanDensity {
  double exact = 0;           // the integral over the length
  double of_ends = 0;         // the mean of the densities at both ends, nielsen
  double at_mean_height = 0;  // the density at the mean height, nielsen:mean-height
};
// Between two heights, m, which may be the same.
MeanDensity mean_density(double from_m, double to_m, double scale_height_m);

// Over the height of the eye, 1 to 30 km, of ground at 1500 m as in the source; a panel for air and
// one for aerosol with his scale heights.
Figure mean_density_figure(const Sheet& sheet = {});

}  // namespace skyfit::plot
