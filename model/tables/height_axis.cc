// SPDX-License-Identifier: Apache-2.0
#include "model/tables/height_axis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

// From either end of a layer in steps that grow: light that comes out of it at a low angle is
// scattered near the end. Closer from the top, where the beam of a low sun ends. Without the last
// hundred-thousandth of the column.
std::vector<double> heights_in_layer(const LinearProfile& layer) {
  constexpr double kOutside = 1e-5, kFirst = 1.0 / 600;
  const double low = layer.height_below(1 - kOutside), high = layer.height_below(kOutside);
  const double first = kFirst * (high - low);
  std::vector<double> heights = {std::max(low - first, 0.0), low, std::midpoint(low, high), high,
                                 high + first};
  for (const auto& [from, to, growth] : {std::tuple(low, high, 1.8), std::tuple(high, low, 1.4)}) {
    for (double step = kFirst; step < 0.5; step *= growth)
      heights.push_back(std::lerp(from, to, step));
  }
  return heights;
}

double unit_of(double height, const Shells& shells) {
  return shared.unit_from_height(std::min(height, shells.top), shells.top);
}

bool is_dense_layer(const Shells& shells, std::size_t profile) {
  constexpr double kMost = 0.1, kSteps = 31;
  if (!shells.profiles[profile].is_layer()) return false;
  const std::vector<double> heights = heights_in_layer(shells.profiles[profile].table());
  const auto [low, high] = std::ranges::minmax(heights);
  return shells.layer_depth[profile] >
         kMost * kSteps * (unit_of(high, shells) - unit_of(low, shells));
}

}  // namespace

bool has_dense_layers(const Shells& shells) {
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    if (is_dense_layer(shells, i)) return true;
  }
  return false;
}

HeightAxis::HeightAxis(const Shells& shells, int heights) {
  std::vector<std::pair<double, double>> layers;
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    if (!is_dense_layer(shells, i)) continue;
    std::vector<double> units;
    for (const double h : heights_in_layer(shells.profiles[i].table()))
      units.push_back(unit_of(h, shells));
    const auto [low, high] = std::ranges::minmax(units);
    layers.emplace_back(low, high);
    nodes_.insert(nodes_.end(), units.begin(), units.end());
  }
  if (nodes_.empty()) return;
  const double step = 1.0 / (heights - 1);
  for (int i = 0; i < heights; ++i) {
    const double unit = i * step;
    constexpr double kClose = 0.4;  // of a step
    const bool within = std::ranges::any_of(layers, [&](const auto& layer) {
      return unit > layer.first - kClose * step && unit < layer.second + kClose * step;
    });
    if (!within || i == 0 || i == heights - 1) nodes_.push_back(unit);
  }
  std::ranges::sort(nodes_);
  constexpr double kSame = 1e-6;
  const auto repeated =
      std::ranges::unique(nodes_, [](double a, double b) { return b - a < kSame; });
  nodes_.erase(repeated.begin(), repeated.end());
  nodes_.back() = 1;
}

double HeightAxis::unit(double height, double thickness) const {
  const double unit = shared.unit_from_height(height, thickness);
  if (nodes_.empty()) return unit;
  const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, unit);
  const double low = *(above - 1);
  const auto below = static_cast<double>(above - nodes_.begin() - 1);
  return (below + (unit - low) / (*above - low)) / static_cast<double>(nodes_.size() - 1);
}

double HeightAxis::height(double unit, double thickness) const {
  if (!nodes_.empty()) {
    const double place = unit * static_cast<double>(nodes_.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
    unit = std::lerp(nodes_[below], nodes_[below + 1], place - static_cast<double>(below));
  }
  return std::min(shared.height_from_unit(unit, thickness), thickness);
}

int HeightAxis::texels(int heights) const {
  if (nodes_.empty()) return heights;
  const int steps = static_cast<int>(nodes_.size()) - 1;
  return steps * ((heights - 2) / steps + 1) + 1;
}

}  // namespace skyfit
