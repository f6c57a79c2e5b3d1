// SPDX-License-Identifier: Apache-2.0
// Pairs of oxygen molecules and nitrogen dioxide absorb as their published bands and columns say,
// follow pressure, temperature and the profile of the air, and have exact derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

Atmosphere<double> measured_air() {
  Atmosphere<double> a;
  a.at("rayleigh") = standard_air<double>();
  a.constituents.push_back(standard_oxygen_pairs<double>());
  a.constituents.push_back(standard_nitrogen_dioxide<double>());
  return a;
}

double depth(const Atmosphere<double>& a, std::string_view name, double nm) {
  return vertical_optical_depth(a, a.at(name), node_at(refs::standard_spectral_data(), nm));
}

// The peaks of Greenblatt et al. 1990 at 296 K, another laboratory; those at 273 K are higher by a
// few percent. Times the integral of the squared density of the tabulated U.S. Standard Atmosphere
// 1976, by trapezoids: 1.32e43 molecules^2 cm^-5.
TEST(GasAbsorption, OxygenPairsHaveTheirPublishedOpticalDepths) {
  constexpr double kLaboratories = 0.12;
  struct Level {
    double km, kelvin, hpa;
  };
  constexpr Level kStandard[] = {{0, 288.15, 1013.25}, {1, 281.65, 898.76},  {2, 275.15, 795.01},
                                 {3, 268.66, 701.21},  {4, 262.17, 616.60},  {5, 255.68, 540.48},
                                 {6, 249.19, 472.17},  {7, 242.70, 411.05},  {8, 236.22, 356.51},
                                 {10, 223.25, 264.99}, {12, 216.65, 193.99}, {15, 216.65, 121.11},
                                 {20, 216.65, 55.293}, {30, 226.51, 11.970}};
  double pairs = 0;  // cm^-5
  const auto squared = [](const Level& level) {
    const double oxygen = 0.20946 * 1e2 * level.hpa / (1.380649e-23 * level.kelvin) * 1e-6;
    return oxygen * oxygen;
  };
  for (std::size_t i = 0; i + 1 < std::size(kStandard); ++i)
    pairs += 0.5e5 * (squared(kStandard[i]) + squared(kStandard[i + 1])) *
             (kStandard[i + 1].km - kStandard[i].km);
  EXPECT_NEAR(oxygen_pair_column(1013.25, 288.15) * 1e-10 / pairs, 1, 0.01);
  struct Band {
    double nm, peak_cm5;
  };
  for (const Band& band : {Band{360.5, 4.1e-46},
                           {380.2, 2.4e-46},
                           {446.7, 0.57e-46},
                           {477.3, 6.3e-46},
                           {532.2, 1.0e-46},
                           {577.2, 11.0e-46},
                           {630.0, 7.2e-46}}) {
    EXPECT_NEAR(depth(measured_air(), "oxygen_pairs", band.nm) / (band.peak_cm5 * pairs), 1,
                kLaboratories)
        << band.nm;
  }
}

TEST(GasAbsorption, OxygenPairsGoAsPressureSquaredOverTemperature) {
  Atmosphere<double> a = measured_air();
  const double standard = depth(a, "oxygen_pairs", 577);
  a.at("rayleigh").profile.scale_height_m = 7000;
  EXPECT_NEAR(depth(a, "oxygen_pairs", 577) / standard, 1, 1e-14);
  set_site_pressure(a, 719);
  EXPECT_NEAR(depth(a, "oxygen_pairs", 577) / standard, std::pow(719 / 1013.25, 2), 1e-12);
  a.at("oxygen_pairs").temperature_k = 260;
  EXPECT_NEAR(depth(a, "oxygen_pairs", 577) / standard, std::pow(719 / 1013.25, 2) * 288.15 / 260,
              1e-12);
}

// 0.2 DU are 5.374e15 per cm^2; the mean of JPL 06-2 over 437.5 to 442.5 nm is 4.88e-19 cm^2.
TEST(GasAbsorption, NitrogenDioxideHasTheOpticalDepthOfItsColumn) {
  EXPECT_NEAR(depth(measured_air(), "nitrogen_dioxide", 440) / (0.2 * 2.687e16 * 4.88e-19), 1,
              1e-12);
  EXPECT_EQ(depth(measured_air(), "nitrogen_dioxide", 700), 0);
}

// The scale height of the air is also that of the pairs, halved.
TEST(GasAbsorption, DerivativesAreThoseOfDifferences) {
  constexpr double kDifference = 1e-5, kDegree = std::numbers::pi / 180;
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const std::vector<WavelengthNode> nodes =
      spectral_nodes(refs::standard_spectral_data(), {440, 477, 577});
  const std::vector<SkyPoint> points = {{0, 40 * kDegree, 0, 0},
                                        {0, 75 * kDegree, 80 * kDegree, 2}};
  const Atmosphere<double> a = measured_air();
  for (const Parameter& id : {Parameter::kRayleighPressure, Parameter::kRayleighScaleHeight,
                              Parameter{"oxygen_pairs", Quantity::kPressure},
                              Parameter{"nitrogen_dioxide", Quantity::kColumn}}) {
    ASSERT_TRUE(has_parameter(a, id)) << id.name();
    const SkyValues exact = model->radiance(a, nodes, points, {&id, 1});
    const double middle = get_parameter(a, id), step = 1e-3 * middle;
    const auto at = [&](double value) {
      Atmosphere<double> b = a;
      set_parameter(b, id, value);
      return model->radiance(b, nodes, points, {});
    };
    const SkyValues above = at(middle + step), below = at(middle - step);
    for (std::size_t i = 0; i < exact.value.size(); ++i) {
      const double difference = (above.value[i] - below.value[i]) / (2 * step);
      EXPECT_NE(exact.derivative[i], 0) << id.name();
      EXPECT_NEAR(exact.derivative[i], difference,
                  kDifference * std::max(std::abs(difference), exact.value[i] / middle))
          << id.name() << " at " << i;
    }
  }
}

// Of the sums over 5 nm, which read the bands as they are.
TEST(GasAbsorption, RulesTakeFromTheLightWhatTheirSumsTake) {
  constexpr double kRule = 2e-3, kDegree = std::numbers::pi / 180;
  const SpectralData& data = refs::standard_spectral_data();
  const auto model = make_sky_model("reference", data, 2);
  const Atmosphere<double> a = measured_air();
  std::vector<SkyPoint> points;
  for (const double sun : {20.0, 60.0, 85.0}) {
    for (const double view : {0.0, 60.0, 88.0})
      points.push_back({0, sun * kDegree, view * kDegree, 1});
  }
  const auto luminances = [&](const LuminanceRule& rule) {
    const SkyValues sky = model->radiance(a, rule.nodes, points, {});
    std::vector<double> sums(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        sums[i] += rule.weight[k] * sky.at(static_cast<int>(i), static_cast<int>(k));
    }
    return sums;
  };
  const std::vector<double> few = luminances(luminance_rule(data)),
                            many = luminances(luminance_sum_5nm(data));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(few[i] / many[i], 1, kRule) << i;
}

TEST(GasAbsorption, PresetKeepsThem) {
  const Preset preset{"gases", measured_air(), {}, {}};
  EXPECT_EQ(parse_preset(preset_to_json(preset), "again").atmosphere, preset.atmosphere);
}

TEST(GasAbsorption, SquareNeedsAnExponentialProfile) {
  Atmosphere<double> a = measured_air();
  a.at("oxygen_pairs").profile.of = "ozone";
  EXPECT_THROW(validate(a), std::invalid_argument);
}

}  // namespace
}  // namespace skyfit
