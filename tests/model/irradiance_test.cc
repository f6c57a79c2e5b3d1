// SPDX-License-Identifier: Apache-2.0
// Irradiances are the integral of the radiance that the model itself has, and their derivatives are
// those of that integral and of the beam.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/numerics/gauss.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;

Atmosphere<double> atmosphere(double scattering, double g1) {
  Atmosphere<double> a;
  a.at("mie").amount = scattering;
  a.at("mie").phase = {PhaseType::kTwoLobe, 0, g1, 0.2, 0.6};
  return a;
}

// Gauss's rule of 6 nodes between each two of the breaks.
GaussRule composite(const std::vector<double>& breaks) {
  const GaussRule unit = gauss_legendre(6);
  GaussRule rule;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    for (std::size_t k = 0; width > 0 && k < unit.node.size(); ++k) {
      rule.node.push_back(breaks[i] + width * unit.node[k]);
      rule.weight.push_back(width * unit.weight[k]);
    }
  }
  return rule;
}

// In polar coordinates about the sun, unlike the model: angles from it by panels that widen, parted
// where a circle about the sun begins to dip below the horizon or to rise above it, and the arc of
// the circle above the horizon.
double integral_of_radiance(const SkyModel& model, const Atmosphere<double>& a,
                            const WavelengthNode& node, double altitude, double sun) {
  std::vector<double> breaks = {0,
                                0.005,
                                0.02,
                                0.06,
                                0.15,
                                0.4,
                                0.8,
                                1.2,
                                1.6,
                                2.0,
                                2.4,
                                2.8,
                                kPi,
                                std::abs(kPi / 2 - sun),
                                std::min(kPi / 2 + sun, kPi)};
  std::sort(breaks.begin(), breaks.end());
  const GaussRule polar = composite(breaks),
                  turn = composite({0, 0.02, 0.1, 0.3, 0.6, 0.8, 0.9, 0.97, 1});
  std::vector<SkyPoint> points;
  std::vector<double> weights;
  const double cs = std::cos(sun), ss = std::sin(sun);
  for (std::size_t i = 0; i < polar.node.size(); ++i) {
    const double c = std::cos(polar.node[i]), s = std::sin(polar.node[i]);
    // cos zenith = c cs + s ss cos(turn) is that of a direction above the horizon up to the arc.
    const double arc = std::acos(std::clamp(-c * cs / (s * ss + 1e-300), -1.0, 1.0));
    for (std::size_t k = 0; arc > 0 && k < turn.node.size(); ++k) {
      const double t = arc * turn.node[k];
      const double mu = std::clamp(c * cs + s * ss * std::cos(t), 0.0, 1.0);
      points.push_back({altitude, sun, std::acos(mu),
                        std::atan2(s * std::sin(t), c * ss - s * cs * std::cos(t))});
      weights.push_back(2 * arc * turn.weight[k] * polar.weight[i] * s * mu);
    }
  }
  const SkyValues sky = model.radiance(a, {&node, 1}, points, {});
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * sky.value[i];
  return sum;
}

void expect_integral(const Atmosphere<double>& a, double altitude, double sun_deg) {
  constexpr double kAgreement = 5e-4;  // of 32 rings of 32 directions
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const WavelengthNode node = spectral_nodes(refs::standard_spectral_data(), {480}).front();
  const double sun = sun_deg * kDegree;
  const SkyValues light = model->irradiance(a, {&node, 1}, altitude, sun, {});
  const double diffuse = light.at(kDiffuseHorizontal, 0);
  EXPECT_NEAR(diffuse / integral_of_radiance(*model, a, node, altitude, sun), 1, kAgreement)
      << "aerosol " << a.at("mie").amount << ", altitude " << altitude << ", sun " << sun_deg;
}

TEST(Irradiance, IsTheIntegralOfRadiance) {
  for (const double sun : {0.0, 40.0, 80.0, 92.0}) {
    expect_integral(atmosphere(1.5e-4, 0.95), 0, sun);
  }
  for (const double sun : {30.0, 88.0, 92.0}) expect_integral(atmosphere(1.5e-4, 0.8), 10e3, sun);
  expect_integral(atmosphere(6e-4, 0.8), 0, 85);
  expect_integral(atmosphere(1e-6, 0.8), 0, 60);
}

TEST(Irradiance, IsTheSunsAndTheSkys) {
  Atmosphere<double> a;
  a.at("ozone").amount = 0;
  const WavelengthNode green{550, 0};
  const double sun = 40 * kDegree;
  const SkyValues e = make_sky_model("reference", refs::standard_spectral_data(), 1)
                          ->irradiance(a, {&green, 1}, 0, sun, {});
  EXPECT_DOUBLE_EQ(e.at(kDirectHorizontal, 0), e.at(kDirectNormal, 0) * std::cos(sun));
  EXPECT_DOUBLE_EQ(e.at(kGlobalHorizontal, 0),
                   e.at(kDirectHorizontal, 0) + e.at(kDiffuseHorizontal, 0));
  const double depth = (1.216e-5 * 8000 + 2.2e-5 / 0.9 * 1200) / std::cos(sun);
  constexpr double kCurvature = 1e-3;
  EXPECT_NEAR(e.at(kDirectNormal, 0), std::exp(-depth), kCurvature);
}

TEST(Irradiance, TheSunBelowTheHorizonShinesFromNowhereButOnHighPlaces) {
  const Atmosphere<double> a;
  const WavelengthNode green{550, 0};
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  const double sun = 91 * kDegree;
  EXPECT_EQ(model->irradiance(a, {&green, 1}, 0, sun, {}).at(kDirectNormal, 0), 0);
  const SkyValues high = model->irradiance(a, {&green, 1}, 10e3, sun, {});
  EXPECT_GT(high.at(kDirectNormal, 0), 0);
  EXPECT_EQ(high.at(kDirectHorizontal, 0), 0);
}

// Every derivative equals the central difference.
TEST(Irradiance, DerivativesEqualDifferences) {
  constexpr double kDifference = 1e-5;  // as in derivatives_test.cc
  const Atmosphere<double> a = atmosphere(1.5e-4, 0.8);
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const WavelengthNode node = spectral_nodes(refs::standard_spectral_data(), {560}).front();
  const double sun = 70 * kDegree;
  std::vector<Parameter> parameters;
  for (const Parameter& id : standard_parameters()) {
    if (has_parameter(a, id)) parameters.push_back(id);
  }
  const SkyValues exact = model->irradiance(a, {&node, 1}, 0, sun, parameters);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double middle = get_parameter(a, parameters[p]), step = 2e-5 * middle;
    const auto at = [&](double value) {
      Atmosphere<double> b = a;
      set_parameter(b, parameters[p], value);
      return model->irradiance(b, {&node, 1}, 0, sun, {});
    };
    const SkyValues high = at(middle + step), low = at(middle - step);
    for (int i = 0; i < kIrradianceCount; ++i) {
      EXPECT_NEAR(exact.derivative_at(static_cast<int>(p), i, 0),
                  (high.at(i, 0) - low.at(i, 0)) / (2 * step),
                  kDifference * exact.at(i, 0) / middle)
          << parameters[p].name() << " " << i;
    }
  }
}

}  // namespace
}  // namespace skyfit
