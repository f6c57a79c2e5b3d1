// SPDX-License-Identifier: Apache-2.0
#include "model/solver/sun_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/angles.h"

namespace skyfit {

namespace {
constexpr double kDusk = 91 * kRadiansPerDegree;
}  // namespace

// docs/theory (7.6).
double SunGrid::decay_rate(double zenith) const {
  return zenith < kDusk ? 0 : fastest_ * (1 - std::exp((kDusk - zenith) / slow_));
}
double SunGrid::decay(double zenith) const {
  if (zenith < kDusk) return 1;
  const double x = zenith - kDusk;
  return std::exp(-fastest_ * (x + slow_ * std::expm1(-x / slow_)));
}

SunGrid::SunGrid(const Shells& shells) {
  constexpr double kEarth = 10 * kRadiansPerDegree;
  const double extent =
      std::max(kEarth, std::acos(shells.bottom_radius / (shells.bottom_radius + shells.top)));
  fastest_ = 10 / extent;
  slow_ = 0.6 * extent;
  // Steps in degrees up to each end: the field changes fastest near the horizon and decays
  // below the last node.
  struct Range {
    double end, step;
  };
  double zenith = 0;
  for (const Range range :
       {Range{60, 10}, Range{75, 5}, Range{85, 2.5}, Range{90, 2.5}, Range{108, 1.5}}) {
    if (range.end == 90) day_ = size();
    for (; zenith < range.end - 1e-9; zenith += range.step)
      zenith_.push_back(zenith * kRadiansPerDegree);
  }
  zenith_.push_back(zenith * kRadiansPerDegree);
  set_fours();
}

void SunGrid::set_fours() {
  for (int first = -1; first + 4 <= size(); ++first) {  // -1: one node beyond the zenith
    Four four;
    for (int i = 0; i < 4; ++i) {
      four.index[i] = std::abs(first + i);
      four.node[i] = first + i < 0 ? -zenith_[1] : zenith_[first + i];
    }
    for (int i = 0; i < 4; ++i) {
      four.factor[i] = 1 / decay(four.node[i]);
      for (int k = 0; k < 4; ++k) {
        if (k != i) four.factor[i] /= four.node[i] - four.node[k];
      }
    }
    fours_.push_back(four);
  }
}

double SunGrid::mu(int i) const { return std::cos(zenith_[i]); }

SunSlope SunGrid::slope(int i) const {
  const int first = std::min(i - 2, size() - 5);
  std::array<double, 5> node;
  SunSlope s;
  for (int k = 0; k < 5; ++k) {
    s.index[k] = std::abs(first + k);
    node[k] = first + k < 0 ? -zenith_[-first - k] : zenith_[first + k];
  }
  const double x = zenith_[i];
  for (int k = 0; k < 5; ++k) {
    double denominator = 1, sum = 0;
    for (int a = 0; a < 5; ++a) {
      if (a == k) continue;
      denominator *= node[k] - node[a];
      double product = 1;
      for (int b = 0; b < 5; ++b) {
        if (b != k && b != a) product *= x - node[b];
      }
      sum += product;
    }
    s.even[k] = sum / denominator;
    s.even[k] *= decay(x) / decay(node[k]);
    if (s.index[k] == i) s.even[k] -= decay_rate(x);
    s.odd[k] = first + k < 0 ? -s.even[k] : s.even[k];
  }
  return s;
}

SunStencil SunGrid::stencil(double mu_s) const {
  const double asked = std::acos(std::clamp(mu_s, -1.0, 1.0)), x = std::min(asked, zenith_.back());
  const int above =
      static_cast<int>(std::upper_bound(zenith_.begin(), zenith_.end(), x) - zenith_.begin());
  // Up to 85 deg no node below 85 deg is asked for: suns below are dear, for they come with all
  // their neighbours (sun_coupling() in model/solver/diffuse_field.h).
  const int last = x <= zenith_[day_] ? day_ : size() - 1;
  const int first = std::min(above - 2, last - 3);
  const Four& four = fours_[static_cast<std::size_t>(first + 1)];
  const double a = x - four.node[0], b = x - four.node[1], c = x - four.node[2],
               d = x - four.node[3];
  SunStencil s;
  s.index = four.index;
  s.even = {b * c * d * four.factor[0], a * c * d * four.factor[1], a * b * d * four.factor[2],
            a * b * c * four.factor[3]};
  for (double& weight : s.even) weight *= decay(asked);
  s.odd = s.even;
  if (first < 0) s.odd[0] = -s.odd[0];
  return s;
}

}  // namespace skyfit
