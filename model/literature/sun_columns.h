// SPDX-License-Identifier: Apache-2.0
// The sun's light at every height and for every sun, per unit solar irradiance, for the inner loops
// of the tables: 64 heights, denser below, and cosines spaced evenly, 0.014 deg at the horizon.
#pragma once

#include <tbb/parallel_for.h>

#include "model/atmosphere/shells.h"
#include "model/geometry/sun_disc.h"
#include "model/literature/grid.h"

namespace skyfit::literature {

template <int N>
class SunColumns {
 public:
  // `optical_depth(height, mu)`: to the top along a ray that misses the ground.
  template <class OpticalDepth>
  SunColumns(const Shells& shells, const OpticalDepth& optical_depth)
      : top_(shells.top), light_({kHeights, kCosines}) {
    tbb::parallel_for(0, kHeights, [&](int i) {
      const double x = unit_of(i, kHeights), height = shells.top * x * x;
      for (int k = 0; k < kCosines; ++k) {
        const double mu_s = 2 * unit_of(k, kCosines) - 1;
        const double visible = visible_sun(shells.bottom_radius, height, mu_s, shells.sun_radius);
        if (visible <= 0) continue;
        light_.at({i, k}) =
            visible * exp(-optical_depth(
                          height, std::max(mu_s, horizon_cosine(shells.bottom_radius, height))));
      }
    });
  }

  Between row(double height) const {
    return between(std::sqrt(std::max(height / top_, 0.0)), kHeights);
  }
  Dual<N> light(const Between& row, double mu_s) const {
    return light_.linear({row, between(0.5 * (mu_s + 1), kCosines)});
  }
  Dual<N> light(double height, double mu_s) const { return light(row(height), mu_s); }

 private:
  static constexpr int kHeights = 64, kCosines = 8192;
  double top_;
  Grid<N, 2> light_;
};

}  // namespace skyfit::literature
