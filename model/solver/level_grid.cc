// SPDX-License-Identifier: Apache-2.0
#include "model/solver/level_grid.h"

#include <algorithm>
#include <cmath>

#include "model/numerics/lagrange.h"
#include "model/solver/sun_grid.h"

namespace skyfit {
namespace {

double bulk_depth_between(const Shells& shells, double low, double high) {
  double depth = 0;
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    if (shells.bulk_depth[i] == 0) continue;
    const Profile& profile = shells.profiles[i];
    const auto above = [&](double h) {
      return profile.column_to_top(shells.bottom_radius, h, 1, shells.top).value;
    };
    depth += shells.bulk_depth[i] * (above(low) - above(high)) / profile.vertical_column().value;
  }
  return depth;
}

}  // namespace

// docs/theory (3.1).
LevelGrid::LevelGrid(const Shells& shells, int count) : asked_(count) {
  const auto height = [&](double i) { return shells.top * std::pow(i / (count - 1), 3); };
  // The source is linear in optical depth between two levels. Of the thickest, few hundred levels.
  constexpr double kMostDepth = 0.15, kMostSteps = 100;
  const double most = std::max(kMostDepth, bulk_depth_between(shells, 0, shells.top) / kMostSteps);
  for (int i = 0; i + 1 < count; ++i) {
    const double depth = bulk_depth_between(shells, height(i), height(i + 1));
    const double parts = std::exp2(std::ceil(std::log2(std::max(depth / most, 1.0))));
    for (double k = 0; k < parts; ++k) heights_.push_back(height(i + k / parts));
  }
  heights_.push_back(shells.top);
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    const std::vector<double> wanted = shells.profiles[i].level_heights(shells.layer_depth[i]);
    if (wanted.size() < 2) continue;
    // A level of another origin close to one of these would make a layer of no use.
    const double apart = 0.4 * (wanted[1] - wanted[0]);
    std::erase_if(heights_, [&](double h) {
      return h > 0 && h < shells.top &&
             std::ranges::any_of(wanted, [&](double w) { return std::abs(h - w) < apart; });
    });
    for (const double h : wanted) {
      if (h > apart && h < shells.top - apart) heights_.push_back(h);
    }
    std::ranges::sort(heights_);
  }
  for (const double h : heights_) roots_.push_back(std::cbrt(h / shells.top));
}

double LevelGrid::coordinate(double height) const {
  const double root = std::cbrt(std::clamp(height / heights_.back(), 0.0, 1.0));
  const auto above = std::upper_bound(roots_.begin() + 1, roots_.end() - 1, root);
  const auto i = static_cast<std::size_t>(above - roots_.begin()) - 1;
  const double x = static_cast<double>(i) + (root - roots_[i]) / (roots_[i + 1] - roots_[i]);
  constexpr double kOnLevel = 1e-6;  // of the distance of two levels
  return std::abs(x - std::round(x)) < kOnLevel ? std::round(x) : x;
}

LevelStencil LevelGrid::stencil(double coordinate) const {
  const int below = static_cast<int>(coordinate);
  if (coordinate == below) return {below, {1.0}};
  const NodeRange range =
      without_short_steps(roots_, below + 1, {std::clamp(below - 1, 0, size() - 4), 4});
  LevelStencil stencil{range.first, std::vector<double>(static_cast<std::size_t>(range.count))};
  const auto at = static_cast<std::size_t>(below);
  const double root = std::lerp(roots_[at], roots_[at + 1], coordinate - below);
  lagrange_weights(&roots_[static_cast<std::size_t>(stencil.first)], range.count, root,
                   stencil.share.data());
  return stencil;
}

}  // namespace skyfit
