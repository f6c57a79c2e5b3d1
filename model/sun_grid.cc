// SPDX-License-Identifier: Apache-2.0
#include "model/sun_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace skyfit {

void lagrange_weights(const double* nodes, int count, double x, double* weights) {
  for (int i = 0; i < count; ++i) {
    weights[i] = 1;
    for (int k = 0; k < count; ++k) {
      if (k != i) weights[i] *= (x - nodes[k]) / (nodes[i] - nodes[k]);
    }
  }
}

SunGrid::SunGrid() {
  // Steps in degrees up to each end: the field changes fastest near the horizon and is dark below
  // 108.
  struct Range {
    double end, step;
  };
  double zenith = 0;
  for (const Range range : {Range{60, 6}, Range{80, 4}, Range{108, 2}}) {
    for (; zenith < range.end - 1e-9; zenith += range.step)
      mu_.push_back(std::cos(zenith * std::numbers::pi / 180));
  }
  mu_.push_back(std::cos(zenith * std::numbers::pi / 180));
}

SunStencil SunGrid::stencil(double mu_s) const {
  const double x = std::clamp(mu_s, mu_.back(), mu_.front());
  const auto below = std::lower_bound(mu_.begin(), mu_.end(), x, std::greater<>());
  const int first = std::clamp(static_cast<int>(below - mu_.begin()) - 2, 0, size() - 4);
  SunStencil s;
  for (int i = 0; i < 4; ++i) s.index[i] = first + i;
  lagrange_weights(&mu_[first], 4, x, s.weight.data());
  return s;
}

}  // namespace skyfit
