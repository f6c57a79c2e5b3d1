// SPDX-License-Identifier: Apache-2.0
// What radiative transfer demands of any solver.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/profile.h"
#include "model/atmosphere/slant_column.h"
#include "model/numerics/gauss.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
const WavelengthNode kGreen{550, 0};

double radiance(const Atmosphere<double>& a, const SkyPoint& point) {
  return make_sky_model("reference", refs::standard_spectral_data(), 1)
      ->radiance(a, {&kGreen, 1}, {&point, 1}, {})
      .at(0, 0);
}

Atmosphere<double> without_ozone() {
  Atmosphere<double> a;
  a.at("ozone").amount = 0;
  return a;
}

// Columns by brute force: the density summed along the ray by Gauss's rule in 2000 pieces.
template <class Density>
double column_by_sum(double bottom, double height, double mu, double top, Density density) {
  Shared<double> shared;
  const double length = shared.distance_to_outer_sphere(bottom, height, mu, top);
  const GaussRule rule = gauss_legendre(4);
  constexpr int kPieces = 2000;
  double sum = 0;
  for (int i = 0; i < kPieces; ++i) {
    for (int k = 0; k < 4; ++k) {
      const double s = length * (i + rule.node[k]) / kPieces;
      sum +=
          rule.weight[k] * length / kPieces * density(shared.height_after(bottom, height, mu, s));
    }
  }
  return sum;
}

TEST(SlantColumn, EqualsTheSumAlongTheRay) {
  constexpr double kExpansion = 3e-7;  // of Chapman's function in H / r
  for (const double scale : {300.0, 1200.0, 8000.0, 12000.0}) {
    for (const double height : {0.0, 2e3, 3e4}) {
      for (const double mu : {1.0, 0.5, 0.1, 0.01, 0.0, -0.01}) {
        if (height == 0 && mu < 0) continue;
        const double expected = column_by_sum(6360e3, height, mu, 100e3,
                                              [&](double h) { return std::exp(-h / scale); });
        EXPECT_NEAR(exponential_column(6360e3, height, mu, 100e3, scale).value, expected,
                    kExpansion * expected)
            << scale << " " << height << " " << mu;
      }
    }
  }
}

TEST(SlantColumn, TentEqualsTheSumAlongTheRay) {
  constexpr double kCorners = 2e-6;  // of the brute sum at the tent's corners
  for (const double height : {0.0, 12e3, 30e3}) {
    for (const double mu : {1.0, 0.2, 0.0, -0.03}) {
      if (height == 0 && mu < 0) continue;
      const double expected = column_by_sum(6360e3, height, mu, 100e3, [&](double h) {
        return std::max(std::min((h - 10e3) / 15e3, (40e3 - h) / 15e3), 0.0);
      });
      EXPECT_NEAR(linear_column(Profile(standard_ozone<double>().profile).table(), 6360e3, height,
                                mu, 100e3),
                  expected, kCorners * expected)
          << height << " " << mu;
    }
  }
}

TEST(PhaseFunctions, IntegrateToOneAndHaveTheirMoments) {
  const GaussRule rule = gauss_legendre(400);
  for (const PhaseType type :
       {PhaseType::kCornetteShanks, PhaseType::kHenyeyGreenstein, PhaseType::kTwoLobe}) {
    for (const PhaseType lobe : {PhaseType::kCornetteShanks, PhaseType::kHenyeyGreenstein}) {
      const PhaseFunction<double> phase{type, 0.7, 0.8, -0.2, 0.3, lobe};
      const std::vector<double> chi = phase_moments(phase, 6);
      for (int l = 0; l < 6; ++l) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.node.size(); ++i) {
          const double nu = 2 * rule.node[i] - 1;
          sum += 4 * kPi * rule.weight[i] * phase_value(phase, nu) *
                 std::legendre(static_cast<unsigned>(l), nu);
        }
        EXPECT_NEAR(sum, chi[l], 1e-10) << l;
      }
    }
  }
}

TEST(Reference, MirroredAzimuthGivesTheSameValue) {
  const Atmosphere<double> a;
  for (const double azimuth : {0.3, 1.7, 3.0}) {
    EXPECT_DOUBLE_EQ(radiance(a, {0, 1.0, 1.2, azimuth}), radiance(a, {0, 1.0, 1.2, -azimuth}));
  }
}

// A thin atmosphere over a black ground: radiance = P(nu) tau_sca / mu, plane-parallel.
TEST(Reference, SingleScatteringLimitOfAThinAtmosphere) {
  Atmosphere<double> a = without_ozone();
  a.bottom_radius_m = 1e9;
  a.top_radius_m = 1e9 + 100e3;
  a.ground_albedo = 0;
  a.at("rayleigh").amount = 1e-10;
  a.at("mie").amount = 0;
  Shared<double> shared;
  const double mu = std::cos(0.8),
               nu = std::cos(0.8) * std::cos(0.5) + std::sin(0.8) * std::sin(0.5) * std::cos(2.0);
  const double depth = 1e-10 * 8000 * (1 - std::exp(-100.0 / 8));
  constexpr double kThin = 1e-5;  // tau (1 / mu + 1 / mu_s) and the second order
  const double expected = shared.rayleigh_phase(0.0, nu) * depth / mu;
  EXPECT_NEAR(radiance(a, {0, 0.5, 0.8, 2.0}) / expected, 1, kThin);
}

// Helmholtz: on a flat planet radiance / mu_s is the same when sun and view trade places at the
// top, looking down. Here for light that a plane-parallel atmosphere over a Lambert ground sends
// back to space.
TEST(Reference, ReciprocityOfReflectedLight) {
  Atmosphere<double> a = without_ozone();
  a.bottom_radius_m = 1e9;
  a.top_radius_m = 1e9 + 100e3;
  a.at("mie").amount = 1e-4;
  const double first = 25 * kDegree, second = 65 * kDegree;
  const double there = radiance(a, {100e3, first, kPi - second, 0.7}) / std::cos(first);
  const double back = radiance(a, {100e3, second, kPi - first, 0.7}) / std::cos(second);
  constexpr double kLevels = 1e-3;  // the source is linear in optical depth between 32 levels
  EXPECT_NEAR(there / back, 1, kLevels);
}

// A conservative atmosphere over a white ground sends back all that it gets.
TEST(Reference, ConservativeAtmosphereOverWhiteGroundLosesNothing) {
  Atmosphere<double> a = without_ozone();
  a.bottom_radius_m = 1e9;
  a.top_radius_m = 1e9 + 100e3;
  a.at("mie").single_scattering_albedo = 1;
  a.at("mie").amount = 1e-4;
  a.ground_albedo = 1;
  const double sun = 50 * kDegree;
  const GaussRule zenith = gauss_legendre(20), azimuth = gauss_legendre(20);
  std::vector<SkyPoint> points;
  std::vector<double> weights;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k) {
      const double mu = zenith.node[i];
      points.push_back({100e3, sun, kPi - std::acos(mu), kPi * azimuth.node[k]});
      weights.push_back(2 * kPi * mu * zenith.weight[i] * azimuth.weight[k]);
    }
  }
  const SkyValues up = make_sky_model("reference", refs::standard_spectral_data(), 2)
                           ->radiance(a, {&kGreen, 1}, points, {});
  double flux = 0;
  for (std::size_t i = 0; i < points.size(); ++i) flux += weights[i] * up.value[i];
  EXPECT_NEAR(flux / std::cos(sun), 1, 0.002);
}

TEST(Reference, ThreadsDoNotChangeTheNumbers) {
  const Atmosphere<double> a;
  std::vector<SkyPoint> points;
  for (int i = 0; i < 40; ++i) points.push_back({0, 0.2 + 0.03 * i, 0.035 * i, 0.1 * i});
  const SkyValues one = make_sky_model("reference", refs::standard_spectral_data(), 1)
                            ->radiance(a, {&kGreen, 1}, points, {});
  const SkyValues two = make_sky_model("reference", refs::standard_spectral_data(), 2)
                            ->radiance(a, {&kGreen, 1}, points, {});
  EXPECT_EQ(one.value, two.value);
}

// What is asked beside a point does not change its answer.
TEST(Reference, APointDoesNotDependOnItsCompany) {
  const Atmosphere<double> a;
  const std::vector<SkyPoint> many = {{0, 0.1, 0.2, 0.3}, {0, 1.2, 0.9, 2.0}, {5e3, 1.5, 1.7, 1.0}};
  const SkyValues all = make_sky_model("reference", refs::standard_spectral_data(), 1)
                            ->radiance(a, {&kGreen, 1}, many, {});
  constexpr double kEndOfOrders = 1e-5;  // the sum over orders ends when the slowest sun is done
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(radiance(a, many[i]) / all.at(i, 0), 1, kEndOfOrders);
}

TEST(Reference, NoAtmosphereIsBlackSkyAndLambertGround) {
  Atmosphere<double> a = without_ozone();
  a.at("rayleigh").amount = 0;
  a.at("mie").amount = 0;
  a.ground_albedo = 0.3;
  EXPECT_EQ(radiance(a, {0, 0.5, 0.5, 1}), 0);
  EXPECT_NEAR(radiance(a, {1000, 0.5, kPi, 0}), 0.3 / kPi * std::cos(0.5), 1e-6);
}

TEST(Reference, RefusesWhatItCannotDo) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  const SkyPoint below{-1, 0, 0, 0};
  EXPECT_THROW(model->radiance({}, {&kGreen, 1}, {&below, 1}, {}), std::invalid_argument);
  const SkyPoint point{};
  const Parameter lobe = Parameter::kMiePhaseG1;
  EXPECT_THROW(model->radiance({}, {&kGreen, 1}, {&point, 1}, {&lobe, 1}), std::invalid_argument);
  EXPECT_THROW(make_sky_model("nonsense", refs::standard_spectral_data(), 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace skyfit
