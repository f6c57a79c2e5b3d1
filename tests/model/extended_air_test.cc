// SPDX-License-Identifier: Apache-2.0
// An atmosphere that is high against its planet's radius, as Titan's: much of its light runs along
// the limb, and the diffuse field must know enough rays there. Against the Monte Carlo yardstick.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "data_refs/spectra.h"
#include "model/solver/reference_model.h"
#include "tests/model/monte_carlo.h"
#include "tests/model/truth.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Titan's size, gas and optical depth of haze, of one exponential profile.
Atmosphere<double> hazy_moon() {
  Atmosphere<double> a;
  a.bottom_radius_m = 2575e3;
  a.top_radius_m = a.bottom_radius_m + 500e3;
  set_scattering(a.at("rayleigh"), 550, 5e-5, 4);
  a.at("rayleigh").profile.scale_height_m = 21e3;
  Constituent<double>& haze = a.at("mie");
  set_scattering(haze, 550, 8e-5, 2);
  haze.profile.scale_height_m = 55e3;
  haze.single_scattering_albedo = 0.93;
  haze.phase.g = 0.6;
  a.at("ozone").amount = 0;
  a.ground_albedo = 0.1;
  return a;
}

TEST(ExtendedAir, IsThatOfMonteCarlo) {
  constexpr long kHistories = 120000;
  constexpr double kSigmas = 3.5;
  const Atmosphere<double> a = hazy_moon();
  const std::vector<WavelengthNode> node = spectral_nodes(refs::standard_spectral_data(), {550});
  const truth::MonteCarlo monte_carlo(a, node.front());
  const ReferenceModel model({.transfer = Transfer::kScalar});
  struct Stated {
    SkyPoint point;
    double error;  // docs/accuracy.md
  };
  std::uint64_t seed = 0;
  for (const auto& [point, error] :
       {Stated{{0, 60 * kDegree, 10 * kDegree, 0}, 0.01},
        Stated{{0, 85 * kDegree, 60 * kDegree, 90 * kDegree}, 0.05},
        Stated{{0, 92 * kDegree, 75 * kDegree, 0}, 0.05},
        Stated{{100e3, 70 * kDegree, 60 * kDegree, 180 * kDegree}, 0.01},
        Stated{{100e3, 88 * kDegree, 80 * kDegree, 60 * kDegree}, 0.04}}) {
    const truth::MonteCarloResult truth = monte_carlo.radiance(point, kHistories, ++seed);
    const double value = model.radiance(a, node, {&point, 1}, {}).value[0],
                 expected = truth.single + truth.multiple, off = value / expected - 1,
                 noise = truth.stderr_multiple / expected;
    std::printf("height %.0f m, sun %.0f deg: %.3g 1/sr, %+.2f %%, noise %.2f %%\n",
                point.altitude_m, point.sun_zenith / kDegree, expected, 100 * off, 100 * noise);
    EXPECT_LT(std::abs(off), error + kSigmas * noise);
  }
}

}  // namespace
}  // namespace skyfit
