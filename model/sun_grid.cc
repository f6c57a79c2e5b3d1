// SPDX-License-Identifier: Apache-2.0
#include "model/sun_grid.h"

#include <algorithm>
#include <cmath>
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
  for (const Range range : {Range{60, 10}, Range{75, 5}, Range{90, 2.5}, Range{108, 1.5}}) {
    for (; zenith < range.end - 1e-9; zenith += range.step)
      zenith_.push_back(zenith * std::numbers::pi / 180);
  }
  zenith_.push_back(zenith * std::numbers::pi / 180);
}

double SunGrid::mu(int i) const { return std::cos(zenith_[i]); }

SunStencil SunGrid::stencil(double mu_s) const {
  const double x = std::min(std::acos(std::clamp(mu_s, -1.0, 1.0)), zenith_.back());
  const int above =
      static_cast<int>(std::upper_bound(zenith_.begin(), zenith_.end(), x) - zenith_.begin());
  const int first = std::min(above - 2, size() - 4);  // -1: one node beyond the zenith
  std::array<double, 4> node;
  SunStencil s;
  for (int i = 0; i < 4; ++i) {
    s.index[i] = std::abs(first + i);
    node[i] = first + i < 0 ? -zenith_[1] : zenith_[first + i];
  }
  lagrange_weights(node.data(), 4, x, s.even.data());
  s.odd = s.even;
  if (first < 0) s.odd[0] = -s.odd[0];
  return s;
}

}  // namespace skyfit
