// SPDX-License-Identifier: Apache-2.0
// A light of another spectrum has the star's illuminance and the colour of its own 5 nm sum; the
// moon's disc has a mean brightness of 1, and its light falls with the phase as was measured.
#include "model/photometry/second_light.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/shared/moon.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-12;
constexpr double kFourNodes = 0.004,
                 kFourNodesColor = 0.004;  // Y, and x and y: what a ColorRule promises
constexpr double kQuadrature = 1e-3;       // of the grid over the disc below

struct Xyz {
  double x = 0, y = 0, z = 0;
};

template <class Weights>
Xyz sum_of(const Weights& weights, const SkyValues& values, int point) {
  Xyz sum;
  for (int k = 0; k < values.wavelengths; ++k) {
    const auto node = static_cast<std::size_t>(k);
    sum.x += weights[0][node] * values.at(point, k);
    sum.y += weights[1][node] * values.at(point, k);
    sum.z += weights[2][node] * values.at(point, k);
  }
  return sum;
}

SpectralData black_body(double kelvins) {
  Star star;
  star.spectrum = StarSpectrum::kBlackBody;
  star.temperature_k = kelvins;
  return under(refs::standard_spectral_data(), star);
}

double illuminance(const std::vector<double>& weights) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  return sum;
}

TEST(SecondLight, HasTheColorOfItsOwnStar) {
  const SpectralData& sun = refs::standard_spectral_data();
  const auto model = make_sky_model("reference", sun, 2);
  const Atmosphere<double> atmosphere;
  const std::vector<SkyPoint> points = {{0, 40 * kDegree, 20 * kDegree, 1},
                                        {0, 80 * kDegree, 85 * kDegree, 0},
                                        {0, 80 * kDegree, 10 * kDegree, 2}};
  const ColorRule first = color_rule(sun);
  const std::vector<WavelengthNode> nodes(first.nodes.begin(), first.nodes.end());
  const SkyValues few = model->radiance(atmosphere, nodes, points, {});
  const SkyValues many = model->radiance(atmosphere, luminance_sum_5nm(sun).nodes, points, {});
  for (const double kelvins : {2800.0, 3500.0, 5772.0, 12000.0}) {
    const SpectralData other = black_body(kelvins);
    const ColorRule rule = color_rule_under(other, first);
    const XyzRule all = xyz_sum_5nm(other);
    const double share = illuminance(luminance_rule(sun).weight) / illuminance(all.weight[1]);
    for (int p = 0; p < few.points; ++p) {
      const Xyz a = sum_of(rule.xyz_from_nodes, few, p), b = sum_of(all.weight, many, p);
      const double whole_a = a.x + a.y + a.z, whole_b = b.x + b.y + b.z;
      std::printf("[ second ] %g K: Y %.3f %% off, x %.4f, y %.4f\n", kelvins,
                  100 * (a.y / (share * b.y) - 1), a.x / whole_a - b.x / whole_b,
                  a.y / whole_a - b.y / whole_b);
      EXPECT_NEAR(a.y / (share * b.y), 1, kFourNodes);
      EXPECT_NEAR(a.x / whole_a, b.x / whole_b, kFourNodesColor);
      EXPECT_NEAR(a.y / whole_a, b.y / whole_b, kFourNodesColor);
    }
  }
}

TEST(SecondLight, HasTheIlluminanceOfTheStar) {
  const SpectralData& sun = refs::standard_spectral_data();
  const LuminanceRule first = luminance_rule(sun);
  const double expected = illuminance(first.weight);
  EXPECT_NEAR(illuminance(luminance_rule_under(black_body(3500), first).weight) / expected, 1,
              kRounding);
  EXPECT_NEAR(illuminance(moonlight_luminance_rule(first).weight) / expected, 1, kRounding);
  SpectralData dark = sun;
  for (double& value : dark.solar_irradiance.value) value = 0;
  EXPECT_THROW(luminance_rule_under(dark, first), std::invalid_argument);
}

TEST(Moonlight, IsRedderThanSunlight) {
  const ColorRule sun = color_rule(refs::standard_spectral_data()),
                  moon = moonlight_color_rule(sun);
  const auto x_of = [](const ColorRule& rule) {
    std::array<double, 3> xyz{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (const double weight : rule.xyz_from_nodes[c]) xyz[c] += weight;
    }
    return xyz[0] / (xyz[0] + xyz[1] + xyz[2]);
  };
  std::printf("[ moon   ] x %.4f of the sun, %.4f of the moon\n", x_of(sun), x_of(moon));
  EXPECT_GT(x_of(moon), x_of(sun) + 0.01);
  EXPECT_GT(moon_reflectance(700), 1.3 * moon_reflectance(450));
  EXPECT_THROW(moon_reflectance(900), std::out_of_range);
}

TEST(Moonlight, FallsByAMagnitudeInFortyDegreesAndToATenthAtHalfMoon) {
  EXPECT_NEAR(moon_illuminance_share(0), std::pow(10, -0.4 * (26.76 - 12.73)), 1e-18);
  EXPECT_NEAR(moon_illuminance_share(90 * kDegree) / moon_illuminance_share(0), 0.1, 0.015);
  for (int a = 0; a < 180; ++a)
    EXPECT_GT(moon_illuminance_share(a * kDegree), moon_illuminance_share((a + 1) * kDegree));
}

TEST(Moonlight, DiscHasAMeanBrightnessOfOne) {
  SharedMoon<double> moon;
  constexpr int kSide = 1200;
  for (const double phase : {0.0, 20.0, 60.0, 90.0, 120.0, 150.0}) {
    const double sine = std::sin(phase * kDegree), cosine = std::cos(phase * kDegree);
    double sum = 0;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const double x = (2 * i + 1.0) / kSide - 1, y = (2 * j + 1.0) / kSide - 1;
        if (x * x + y * y >= 1) continue;
        const double mu = std::sqrt(1 - x * x - y * y);
        sum += moon.moon_brightness(mu, x * sine + mu * cosine, phase * kDegree);
      }
    }
    EXPECT_NEAR(sum * 4 / (kSide * kSide) / std::numbers::pi, 1, kQuadrature) << phase;
  }
  EXPECT_NEAR(moon.moon_brightness(0.1, 0.1, 0), 1, kQuadrature);  // a full moon's limb
}

}  // namespace
}  // namespace skyfit
