// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/angle_panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/numerics/angles.h"
#include "model/numerics/gauss.h"
#include "model/numerics/lagrange.h"
#include "model/numerics/wigner.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPieces = AnglePanels::kNodes - 1;

// Degrees. The forward peak of a size parameter x is some 100 deg / x wide; glories are as narrow,
// rainbows of drops some degrees wide.
std::vector<double> panel_edges_deg() {
  std::vector<double> edges = {0,  0.04, 0.15, 0.4, 0.8, 1.5, 2.5, 4,  6, 9,
                               13, 19,   26,   34,  42,  54,  66,  78, 90};
  for (std::size_t i = edges.size() - 1; i-- > 0;) edges.push_back(180 - edges[i]);
  return edges;
}

}  // namespace

AnglePanels::AnglePanels() {
  for (const double degrees : panel_edges_deg()) edges_.push_back(degrees * kRadiansPerDegree);
  edges_.back() = kPi;
  for (std::size_t p = 0; p + 1 < edges_.size(); ++p) {
    const double middle = 0.5 * (edges_[p] + edges_[p + 1]),
                 half = 0.5 * (edges_[p + 1] - edges_[p]);
    for (int k = p == 0 ? 0 : 1; k <= kPieces; ++k)
      angles_.push_back(middle - half * std::cos(kPi * k / kPieces));
  }
  for (const double angle : angles_) cosines_.push_back(std::cos(angle));
  for (auto* moments : {&moments_, &spin_moments_[0], &spin_moments_[1], &spin_moments_[2]})
    moments->assign(kMostMoments * size(), 0.0);
  // Exact for the polynomial times the fastest Legendre polynomial on the longest panel, 23 rad.
  const GaussRule rule = gauss_legendre(32);
  for (std::size_t p = 0; p + 1 < edges_.size(); ++p) {
    const double length = edges_[p + 1] - edges_[p];
    for (std::size_t q = 0; q < rule.node.size(); ++q) {
      const double angle = edges_[p] + rule.node[q] * length, nu = std::cos(angle);
      const double area = 2 * kPi * rule.weight[q] * length * std::sin(angle);
      const Weights interpolation = at(angle);
      const auto add = [&](const std::array<double, kMostMoments>& function,
                           std::vector<double>& moments) {
        for (std::size_t l = 0; l < kMostMoments; ++l) {
          for (std::size_t k = 0; k < kNodes; ++k)
            moments[l * size() + interpolation.first + k] +=
                area * function[l] * interpolation.weight[k];
        }
      };
      std::array<double, kMostMoments> function;
      double before = 0, legendre = 1;  // P_{l-1}, P_l by Bonnet's recursion
      for (int l = 0; l < kMostMoments; ++l) {
        function[static_cast<std::size_t>(l)] = legendre;
        before = std::exchange(legendre, ((2 * l + 1) * nu * legendre - l * before) / (l + 1));
      }
      add(function, moments_);
      for (std::size_t spin = 0; spin < spin_moments_.size(); ++spin) {
        constexpr int kIndex[] = {0, 2, -2};
        wigner_d2(kIndex[spin], kMostMoments, nu, function.data());
        add(function, spin_moments_[spin]);
      }
    }
  }
}

AnglePanels::Weights AnglePanels::at(double angle) const {
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, angle);
  const auto panel = static_cast<std::size_t>(above - edges_.begin()) - 1;
  Weights result{panel * kPieces, {}};
  lagrange_weights(angles_.data() + result.first, kNodes, angle, result.weight.data());
  return result;
}

}  // namespace skyfit
