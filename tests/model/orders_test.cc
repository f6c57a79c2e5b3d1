// SPDX-License-Identifier: Apache-2.0
// Single orders of scattering: together they are the whole, and each passes on less than it got.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "model/numerics/gauss.h"
#include "model/solver/reference_model.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
const WavelengthNode kGreen{550, 0};

// Order 0 is the whole.
std::vector<double> radiances(const Atmosphere<double>& atmosphere,
                              const std::vector<SkyPoint>& points, int order) {
  ReferenceOptions options;
  options.order = order;
  return ReferenceModel(options).radiance(atmosphere, {&kGreen, 1}, points, {}).value;
}

Atmosphere<double> haze(double optical_depth, double ground_albedo) {
  Atmosphere<double> a;
  a.at("ozone").amount = 0;
  a.at("mie").single_scattering_albedo = 1;
  a.at("mie").amount = optical_depth / a.at("mie").profile.scale_height_m;
  a.ground_albedo = ground_albedo;
  return a;
}

TEST(Orders, AddUpToTheWhole) {
  constexpr double kOfTheWhole = 1e-3;
  constexpr int kOrders = 60;
  const Atmosphere<double> bright = haze(0.5, 1);
  const std::vector<SkyPoint> points = {{0, 40 * kDegree, 10 * kDegree, 0},
                                        {0, 40 * kDegree, 80 * kDegree, kPi},
                                        {5e3, 40 * kDegree, 120 * kDegree, 1},
                                        {50e3, 40 * kDegree, 170 * kDegree, 2}};
  std::vector<double> sum(points.size());
  for (int order = 1; order <= kOrders; ++order) {
    const std::vector<double> part = radiances(bright, points, order);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  }
  const std::vector<double> whole = radiances(bright, points, 0);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(sum[i] / whole[i], 1, kOfTheWhole) << i;
  }
}

// Light that leaves the atmosphere, upward at its top and downward into black ground, per order.
TEST(Orders, CarryLessAndLessEnergy) {
  constexpr int kNodes = 8;
  constexpr double kTop = 100e3;
  const GaussRule rule = gauss_legendre(kNodes);
  std::vector<SkyPoint> points;
  std::vector<double> weights;
  for (int i = 0; i < kNodes; ++i) {
    for (int k = 0; k < kNodes; ++k) {
      const double mu = rule.node[i], zenith = std::acos(mu), azimuth = kPi * rule.node[k];
      points.push_back({0, 50 * kDegree, zenith, azimuth});
      points.push_back({kTop, 50 * kDegree, kPi - zenith, azimuth});
      weights.insert(weights.end(), 2, 2 * kPi * mu * rule.weight[i] * rule.weight[k]);
    }
  }
  for (const double optical_depth : {0.005, 0.2, 1.0}) {
    double previous = std::cos(50 * kDegree);  // what the sun sends
    for (int order = 1; order <= 8; ++order) {
      const std::vector<double> part = radiances(haze(optical_depth, 0), points, order);
      double energy = 0;
      for (std::size_t i = 0; i < part.size(); ++i) energy += weights[i] * part[i];
      EXPECT_GT(energy, 0) << optical_depth << " " << order;
      EXPECT_LT(energy, previous) << optical_depth << " " << order;
      previous = energy;
    }
  }
}

}  // namespace
}  // namespace skyfit
