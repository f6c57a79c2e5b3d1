// SPDX-License-Identifier: Apache-2.0
#include "model/tables/height_axis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

using Units = std::vector<double>;  // unit_from_height() of heights, ascending

// How steps grow from the ends of a layer: closer from the top, where the beam of a low sun ends.
struct Growth {
  double from_bottom, from_top;
};
constexpr Growth kOneLayer = {1.8, 1.4}, kTwoLayers = {2.6, 1.8};

// From either end of a layer in steps that grow: light that comes out of it at a low angle is
// scattered near the end. Without the last hundred-thousandth of the column.
Units units_in_layer(const Shells& shells, std::size_t profile, const Growth& growth) {
  constexpr double kOutside = 1e-5, kFirst = 1.0 / 600;
  const LinearProfile& layer = shells.profiles[profile].table();
  const double low = layer.height_below(1 - kOutside), high = layer.height_below(kOutside);
  const double first = kFirst * (high - low);
  std::vector<double> heights = {low - first, low, std::midpoint(low, high), high, high + first};
  for (const auto& [from, to, grow] :
       {std::tuple(low, high, growth.from_bottom), std::tuple(high, low, growth.from_top)}) {
    for (double step = kFirst; step < 0.5; step *= grow)
      heights.push_back(std::lerp(from, to, step));
  }
  std::ranges::sort(heights);
  for (double& h : heights) h = shared.unit_from_height(std::clamp(h, 0.0, shells.top), shells.top);
  return heights;
}

bool is_dense_layer(const Shells& shells, std::size_t profile) {
  constexpr double kMost = 0.1, kSteps = 31;
  if (!shells.profiles[profile].is_layer()) return false;
  const Units units = units_in_layer(shells, profile, kTwoLayers);
  return shells.layer_depth[profile] > kMost * kSteps * (units.back() - units.front());
}

// Whether one lies below the other at all steps; they may touch.
bool keep_apart(std::span<const Shells> steps, std::size_t a, std::size_t b) {
  const auto below = [&](std::size_t low, std::size_t high) {
    return std::ranges::all_of(steps, [&](const Shells& shells) {
      const Units lower = units_in_layer(shells, low, kTwoLayers),
                  upper = units_in_layer(shells, high, kTwoLayers);
      return lower.rbegin()[1] <= upper[1];  // the ends, without the steps beyond them
    });
  };
  return below(a, b) || below(b, a);
}

// Of the profiles those that texels follow.
std::vector<std::size_t> followed(std::span<const Shells> steps) {
  constexpr std::size_t kMost = 2;                    // for the memory that tables take
  std::vector<std::pair<double, std::size_t>> dense;  // optical depth, profile
  for (std::size_t i = 0; i < steps.front().profiles.size(); ++i) {
    if (std::ranges::none_of(steps, [&](const Shells& s) { return is_dense_layer(s, i); }))
      continue;
    const auto depth = [&](const Shells& s) { return s.layer_depth[i]; };
    dense.emplace_back(depth(*std::ranges::max_element(steps, {}, depth)), i);
  }
  std::ranges::sort(dense, std::greater());
  std::vector<std::size_t> layers;
  for (const auto& [depth, layer] : dense) {
    const bool apart = std::ranges::all_of(
        layers, [&](std::size_t other) { return keep_apart(steps, layer, other); });
    if (apart && layers.size() < kMost) layers.push_back(layer);
  }
  return layers;
}

// Ascending in height.
std::vector<Units> layers_of(const Shells& shells, const std::vector<std::size_t>& profiles) {
  std::vector<Units> layers;
  for (const std::size_t profile : profiles)
    layers.push_back(units_in_layer(shells, profile, profiles.size() > 1 ? kTwoLayers : kOneLayer));
  std::ranges::sort(layers);
  return layers;
}

// From the ground to the lowest layer, .., from the highest to the top.
std::vector<std::pair<double, double>> gaps_between(const std::vector<Units>& layers) {
  std::vector<std::pair<double, double>> gaps;
  double low = 0;
  for (const Units& layer : layers) {
    gaps.emplace_back(low, layer.front());
    low = layer.back();
  }
  gaps.emplace_back(low, 1);
  return gaps;
}

// Layers and between them evenly spaced nodes, so many in each gap; the deck is the top of one.
HeightAxis axis_of(const std::vector<Units>& layers, const std::vector<int>& counts,
                   std::size_t of_deck) {
  const auto gaps = gaps_between(layers);
  std::vector<double> nodes = {0};
  std::size_t deck = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    for (int k = 1; k <= counts[i]; ++k)
      nodes.push_back(std::lerp(gaps[i].first, gaps[i].second, k / (counts[i] + 1.0)));
    if (i < layers.size()) nodes.insert(nodes.end(), layers[i].begin(), layers[i].end());
    if (i == of_deck) deck = nodes.size() - 2;  // the last lies beyond
  }
  nodes.push_back(1);
  // Where a layer has almost no thickness, begins at the ground or touches another.
  constexpr double kLeast = 1e-6;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    nodes[i] = std::max(nodes[i], nodes[i - 1] + kLeast);
  nodes.back() = 1;
  for (std::size_t i = nodes.size() - 1; i > 0; --i)
    nodes[i - 1] = std::min(nodes[i - 1], nodes[i] - kLeast);
  return {std::move(nodes), deck};
}

}  // namespace

bool has_dense_layers(const Shells& shells) {
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    if (is_dense_layer(shells, i)) return true;
  }
  return false;
}

std::vector<HeightAxis> height_axes(std::span<const Shells> steps, int heights) {
  const std::vector<std::size_t> profiles = followed(steps);
  if (profiles.empty()) return std::vector<HeightAxis>(steps.size());
  std::vector<int> counts(profiles.size() + 1);
  for (const Shells& shells : steps) {
    const auto gaps = gaps_between(layers_of(shells, profiles));
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const double steps_by_height = (gaps[i].second - gaps[i].first) * (heights - 1);
      counts[i] = std::max(counts[i], static_cast<int>(std::ceil(steps_by_height)) - 1);
    }
  }
  // Of the same layers in every step.
  const Units deepest = layers_of(steps.front(), {profiles.front()}).front();
  const auto below =
      std::ranges::count_if(layers_of(steps.front(), profiles),
                            [&](const Units& layer) { return layer.front() < deepest.front(); });
  std::vector<HeightAxis> axes;
  for (const Shells& shells : steps)
    axes.push_back(axis_of(layers_of(shells, profiles), counts, static_cast<std::size_t>(below)));
  return axes;
}

HeightAxis interpolated(const HeightAxis& a, const HeightAxis& b, double share) {
  if (a.nodes().size() != b.nodes().size())
    throw std::invalid_argument("heights of tables: expected as many in both");
  std::vector<double> nodes = a.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = std::lerp(nodes[i], b.nodes()[i], share);
  return a.deck_node() < 0 ? HeightAxis()
                           : HeightAxis(std::move(nodes), static_cast<std::size_t>(a.deck_node()));
}

double HeightAxis::deck(double thickness) const {
  return nodes_.empty() ? -1 : shared.height_from_unit(nodes_[deck_], thickness);
}

HeightAxis::HeightAxis(const Shells& shells, int heights)
    : HeightAxis(height_axes(std::span(&shells, 1), heights).front()) {}

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
