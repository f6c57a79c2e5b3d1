// SPDX-License-Identifier: Apache-2.0
// The tables of `bruneton` hold what direct integration gives, and the model is near to truth and
// to the reference model from every height.
#include "model/literature/bruneton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/solver/reference_model.h"
#include "tests/model/truth.h"

namespace skyfit::truth {
namespace {

constexpr double kEdge = 1e-9;  // rad, so that a limit in degrees includes its own angle

std::unique_ptr<SkyModel> bruneton() {
  return make_sky_model("bruneton", refs::standard_spectral_data(), 2);
}
Atmosphere<double> earth_clear() {
  return parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear").atmosphere;
}

void expect_near_truth(bool haze, double rms, double worst) {
  const Errors e = errors(compare_monte_carlo(*bruneton(), haze), [](const SkyPoint& p) {
    return p.sun_zenith < 80 * kDegree + kEdge && p.view_zenith < 85 * kDegree + kEdge;
  });
  std::cout << "[ rms, worst ] " << 100 * e.rms << " %, " << 100 * e.worst << " %\n";
  ASSERT_GT(e.count, 0);
  EXPECT_LT(e.rms, rms);
  EXPECT_LT(e.worst, worst) << e.where;
}
TEST(Bruneton, IsNearMonteCarloInClearAir) { expect_near_truth(false, 0.02, 0.06); }
TEST(Bruneton, IsNearMonteCarloInHaze) { expect_near_truth(true, 0.02, 0.06); }

class BrunetonTable : public ::testing::Test {
 protected:
  Atmosphere<double> atmosphere_ = earth_clear();
  literature::BrunetonGeometry geometry_{atmosphere_};
  literature::ClearAir<0> air_ =
      literature::clear_air(geometry_.shells(), seeded<0>(atmosphere_, {}), {550, 0});
  literature::BrunetonTables<0> tables_{geometry_, air_, {}};
};

TEST_F(BrunetonTable, OpticalDepthFollowsTheColumns) {
  constexpr double kTable = 0.02;  // linear over 256 x 64 texels, exact at their centres
  for (const double height : {0.0, 700.0, 5e3, 30e3}) {
    for (const double mu : {1.0, 0.5, 0.1, 0.0}) {
      const double depth = air_.optical_depth(geometry_.shells().columns_to_top(height, mu)).v;
      EXPECT_NEAR(tables_.optical_depth(height, mu).v / depth, 1, kTable)
          << "height " << height << ", mu " << mu;
    }
  }
}

// In the limit of thin air only single scattering is left, which the reference integrates directly;
// at the texels of the ground's slice there is no interpolation but in nu and mu_s.
TEST_F(BrunetonTable, SingleScatteringIsTheIntegral) {
  Atmosphere<double> thin = atmosphere_;
  thin.at("rayleigh").amount *= 1e-4;
  thin.at("mie").amount *= 1e-4;
  thin.at("ozone").amount = 0;
  thin.ground_albedo = 0;
  std::vector<SkyPoint> points;
  for (const int texel : {64, 70, 90, 127}) {
    const double view = std::acos(geometry_.ray(0, texel).mu);
    for (const double sun : {0.0, 60.0, 85.0}) points.push_back({0, sun * kDegree, view, 1.2});
  }
  const WavelengthNode node{550, 0};
  const SkyValues exact = ReferenceModel({}).radiance(thin, {&node, 1}, points, {}),
                  table = bruneton()->radiance(thin, {&node, 1}, points, {});
  constexpr double kTable = 0.01;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(table.value[i] / exact.value[i], 1, kTable) << "point " << i;
}

TEST_F(BrunetonTable, SkyIrradianceIsTheIntegralOfItsRadiance) {
  const auto model = bruneton();
  const WavelengthNode node{550, 0};
  constexpr double kQuadrature = 0.02;  // 20 x 12 directions against 1 024
  for (const double sun : {0.0, 50.0, 80.0}) {
    const SkyValues e = model->irradiance(atmosphere_, {&node, 1}, 0, sun * kDegree, {});
    EXPECT_NEAR(tables_.sky_irradiance(0, std::cos(sun * kDegree)).v / e.at(kDiffuseHorizontal, 0),
                1, kQuadrature)
        << "sun " << sun;
  }
}

TEST(Bruneton, FollowsTheReferenceFromEveryHeight) {
  std::vector<SkyPoint> points;
  for (const double altitude : {0.0, 900.0, 11e3, 60e3, 400e3}) {
    for (const double sun : {15.0, 62.0, 81.0}) {
      for (const double view : {20.0, 70.0, 85.0, 107.0, 150.0, 173.0}) {
        for (const double azimuth : {10.0, 125.0, 300.0})
          points.push_back({altitude, sun * kDegree, view * kDegree, azimuth * kDegree});
      }
    }
  }
  const SpectralData& spectra = refs::standard_spectral_data();
  const std::vector<WavelengthNode> nodes = spectral_nodes(spectra, {550});
  const SkyValues expected = make_sky_model("reference", spectra, 2)
                                 ->radiance(earth_clear(), nodes, points, {}),
                  values = bruneton()->radiance(earth_clear(), nodes, points, {});
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (expected.value[i] <= 0) continue;
    const double error = values.value[i] / expected.value[i] - 1;
    sum += error * error;
    ++count;
    EXPECT_LT(std::abs(error), 0.25)  // at worst, along the limb
        << "altitude " << points[i].altitude_m << ", sun " << points[i].sun_zenith / kDegree
        << ", view " << points[i].view_zenith / kDegree << ", azimuth "
        << points[i].relative_azimuth / kDegree;
  }
  std::cout << "[ rms ] " << 100 * std::sqrt(sum / count) << " %\n";
  EXPECT_LT(std::sqrt(sum / count), 0.04);
}

// At midnight the planet is dark from space and from the ground.
// Where the path is many mean free paths long, the light is that of its first few, whose source
// hardly changes with the view; for every model of tables.
TEST(Bruneton, HorizonInHazeIsNotDark) {
  Atmosphere<double> haze = earth_clear();
  haze.at("mie").amount = 2e-3;
  const auto node = luminance_rule(refs::standard_spectral_data()).nodes.front();
  std::vector<SkyPoint> points;
  for (const double view : {80.0, 85.0, 88.0, 89.0, 89.7})
    points.push_back({2, 60 * kDegree, view * kDegree, 90 * kDegree});
  for (const char* name : {"bruneton", "bodare"}) {
    const auto model = make_sky_model(name, refs::standard_spectral_data(), 2);
    const SkyValues sky = model->radiance(haze, std::span(&node, 1), points, {});
    std::cout << name;
    for (int i = 0; i < sky.points; ++i) std::cout << ' ' << sky.at(i, 0);
    std::cout << '\n';
    for (int i = 1; i < sky.points; ++i) EXPECT_GT(sky.at(i, 0), 0.7 * sky.at(0, 0)) << name;
  }
}

TEST(Bruneton, NightIsDark) {
  const WavelengthNode node{550, 0};
  const std::vector<SkyPoint> points = {{400e3, 180 * kDegree, 108 * kDegree, 0},
                                        {0, 150 * kDegree, 0, 0}};
  for (const char* name : {"bruneton", "bodare"}) {
    const SkyValues night = make_sky_model(name, refs::standard_spectral_data(), 2)
                                ->radiance(earth_clear(), {&node, 1}, points, {});
    EXPECT_LT(night.value[0], 1e-12) << name;
    EXPECT_LT(night.value[1], 1e-12) << name;
  }
}

TEST(Bruneton, MappingsInvert) {
  Shared<double> shared;
  const double bottom = 6360e3, thickness = 100e3, lowest = -0.2;
  for (double x = 0; x <= 1; x += 0.125) {
    EXPECT_NEAR(shared.bruneton_unit_from_height(
                    shared.bruneton_height_from_unit(x, bottom, thickness), bottom, thickness),
                x, 1e-9);
    EXPECT_NEAR(
        shared.bruneton_unit_from_sun(shared.bruneton_sun_from_unit(x, lowest, bottom, thickness),
                                      lowest, bottom, thickness),
        x, 1e-9);
    EXPECT_NEAR(shared.bruneton_unit_from_nu(shared.bruneton_nu_from_unit(x)), x, 1e-15);
  }
}

// What is kept is looked up, and says the same.
TEST(Bruneton, PreparedTablesSayTheSame) {
  const auto fresh = bruneton(), prepared = bruneton();
  const WavelengthNode node{550, 0};
  const SkyPoint point{0, 0.7, 0.5, 1};
  const std::size_t bytes = prepared->prepare(earth_clear(), {&node, 1});
  EXPECT_GE(bytes, std::size_t{2} * 32 * 128 * 32 * 8 * sizeof(double));
  EXPECT_EQ(prepared->radiance(earth_clear(), {&node, 1}, {&point, 1}, {}).value,
            fresh->radiance(earth_clear(), {&node, 1}, {&point, 1}, {}).value);
}

TEST(Bruneton, SaysWhatItCannotDo) {
  const WavelengthNode node{550, 0};
  const SkyPoint below{-1, 0.5, 0.5, 0};
  EXPECT_THROW(bruneton()->radiance({}, {&node, 1}, {&below, 1}, {}), std::invalid_argument);
  EXPECT_THROW(make_sky_model("bruneton", refs::standard_spectral_data(), 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace skyfit::truth
