// SPDX-License-Identifier: Apache-2.0
// Clouds of any optical depth are as bright as closed forms and adding-doubling say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <utility>

#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/solver/reference_model.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A layer of 1 to 3 km without absorption over a black ground, on a planet that is next to flat.
Atmosphere<double> flat_cloud(double optical_depth, double g, double rayleigh) {
  return parse_preset(fmt::format(R"({{"skyfit_preset": 2, "name": "cloud",
      "planet": {{"bottom_radius_m": 1e9, "top_radius_m": 1.0001e9}}, "ground": {{"albedo": {}}},
      "constituents": [
        {{"name": "rayleigh", "optical_depth": {{"wavelength_nm": 550, "value": {}, "exponent": 4.08}},
          "profile": {{"type": "exponential", "scale_height_m": 8000}},
          "phase": {{"type": "rayleigh"}}}},
        {{"name": "cloud", "optical_depth": {{"wavelength_nm": 550, "value": {}, "exponent": 0}},
          "single_scattering_albedo": 1,
          "profile": {{"type": "layer", "base_m": 1000, "top_m": 3000}},
          "phase": {{"type": "henyey-greenstein", "g": {}}}}}]}})",
                                  rayleigh > 0 ? 0.2 : 0.0, rayleigh, optical_depth, g),
                      "a test")
      .atmosphere;
}

// What a thick layer sends up after two isotropic scatterings, per irradiance:
// 1 / (8 pi) mu0 / (mu + mu0) [mu ln(1 + 1/mu) + mu0 ln(1 + 1/mu0)], from the series of
// Chandrasekhar's H. It knows nothing of the layer's optical depth.
TEST(Layers, LightOfTwoScatteringsIsTheSameFromEveryThickLayer) {
  ReferenceOptions options;
  options.transfer = Transfer::kScalar;
  options.order = 2;
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  double worst = 0;
  for (const double depth : {5.0, 20.0, 40.0, 100.0}) {
    for (const double sun : {30.0, 60.0, 75.0}) {
      for (const double view : {0.0, 30.0, 60.0, 75.0}) {
        const std::vector<SkyPoint> point = {
            {100e3, sun * kDegree, std::numbers::pi - view * kDegree, 1}};
        const double found =
            ReferenceModel(options).radiance(flat_cloud(depth, 0, 0), nodes, point, {}).value[0];
        const double mu = std::cos(view * kDegree), mu0 = std::cos(sun * kDegree);
        const double expected = 1 / (8 * std::numbers::pi) * mu0 / (mu + mu0) *
                                (mu * std::log1p(1 / mu) + mu0 * std::log1p(1 / mu0));
        worst = std::max(worst, std::abs(found / expected - 1));
      }
    }
  }
  std::cout << "[ worst ] " << 100 * worst << " %\n";
  EXPECT_LT(worst, 0.005);
}

// Radiance over irradiance under and above clouds with g = 0.85, in air of the optical depth 0.0973
// over a ground of 0.2, by adding-doubling with 28 Gauss points in a hemisphere.
TEST(Layers, OfAnyDepthAreAsAddingDoublingHasThem) {
  struct Row {
    double depth, sun, view, azimuth, up, down;
  };
  constexpr Row kRows[] = {
      {20, 75, 75, 0, 0.27931, 0.01337},    {20, 75, 75, 180, 0.07165, 0.01333},
      {20, 75, 0, 0, 0.04652, 0.02256},     {20, 60, 60, 0, 0.18910, 0.04251},
      {20, 60, 60, 180, 0.10575, 0.04227},  {20, 30, 30, 0, 0.19810, 0.12526},
      {40, 75, 75, 0, 0.28330, 0.00825},    {40, 75, 75, 180, 0.07528, 0.00825},
      {40, 75, 0, 0, 0.05370, 0.01395},     {40, 60, 60, 0, 0.20182, 0.02621},
      {40, 60, 60, 180, 0.11818, 0.02621},  {40, 30, 30, 0, 0.23731, 0.07711},
      {100, 75, 75, 0, 0.28667, 0.00385},   {100, 75, 75, 180, 0.07844, 0.00385},
      {100, 75, 0, 0, 0.05991, 0.00650},    {100, 60, 60, 0, 0.21277, 0.01222},
      {100, 60, 60, 180, 0.12896, 0.01222}, {100, 30, 30, 0, 0.27120, 0.03596},
  };
  ReferenceOptions options;
  options.transfer = Transfer::kScalar;
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  double worst = 0;
  for (const Row& row : kRows) {
    const std::vector<SkyPoint> both = {
        {100e3, row.sun * kDegree, std::numbers::pi - row.view * kDegree, row.azimuth * kDegree},
        {0, row.sun * kDegree, row.view * kDegree, row.azimuth * kDegree}};
    const SkyValues found =
        ReferenceModel(options).radiance(flat_cloud(row.depth, 0.85, 0.0973), nodes, both, {});
    for (const auto& [value, expected] :
         {std::pair{found.value[0], row.up}, {found.value[1], row.down}}) {
      EXPECT_NEAR(value / expected, 1, 0.015) << row.depth << ", sun " << row.sun << ", view "
                                              << row.view << ", azimuth " << row.azimuth;
      worst = std::max(worst, std::abs(value / expected - 1));
    }
  }
  std::cout << "[ worst ] " << 100 * worst << " %\n";
}

}  // namespace
}  // namespace skyfit
