// SPDX-License-Identifier: Apache-2.0
// With the sun's depression the light of the sky falls, and stays above 0, to the end of twilight.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/solver/reference_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void expect_falling(const Atmosphere<double>& a, Transfer transfer) {
  constexpr double kViews[] = {0, 30, 60, 80, 85}, kAzimuths[] = {0, 45, 90, 135, 180};
  std::vector<double> suns;
  for (double sun = 92; sun <= 108; sun += 0.5) suns.push_back(sun);
  std::vector<SkyPoint> points;
  for (const double sun : suns) {
    for (const double view : kViews) {
      for (const double azimuth : kAzimuths)
        points.push_back({0, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  ReferenceOptions options;
  options.transfer = transfer;
  options.threads = 2;
  const WavelengthNode node{550, 3e-25};
  const SkyValues sky = ReferenceModel(options).radiance(a, {&node, 1}, points, {});
  const std::size_t directions = points.size() / suns.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(sky.value[i], 0) << "sun " << suns[i / directions] << " direction " << i % directions;
    if (i < directions) continue;
    EXPECT_LT(sky.value[i], sky.value[i - directions])
        << "sun " << suns[i / directions] << " direction " << i % directions;
  }
}

TEST(DeepTwilight, FallsWithTheSunsDepression) {
  for (const double air : {4.5e-6, 1.216e-5, 3.2e-5}) {
    Atmosphere<double> a;
    set_scattering(a.at("rayleigh"), 550, air, 4.08);
    set_scattering(a.at("mie"), 550, 9e-5, 1.3);
    a.at("mie").phase = {PhaseType::kTwoLobe, 0, 0.8, 0.3, 0.6};
    for (const Transfer transfer : {Transfer::kVector, Transfer::kScalar})
      expect_falling(a, transfer);
  }
}

}  // namespace
}  // namespace skyfit
