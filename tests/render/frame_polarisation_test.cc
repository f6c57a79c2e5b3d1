// SPDX-License-Identifier: Apache-2.0
// The polarisation of a frame's sky is that of the model in the direction of each pixel, inside the
// atmosphere and outside, on both sides of the sun, of two suns, the second of
// another colour, their sum.
#include "render/sky_map/frame_polarisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "model/registry.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kInterpolation = 0.001;  // of I

struct Light {
  double i = 0, q = 0, u = 0;
};

// Adds a sun's. The frame's azimuths count clockwise, the model's counter-clockwise.
void add_light(const SkyModel& model, const LuminanceRule& rule, double share,
               const std::vector<SkyPoint>& points, std::vector<Light>& sum) {
  sum.resize(points.size());
  const StokesValues values = model.stokes(earth_clear().atmosphere, rule.nodes, points, {});
  for (int p = 0; p < values.i.points; ++p) {
    for (int k = 0; k < values.i.wavelengths; ++k) {
      const double weight = share * rule.weight[static_cast<std::size_t>(k)];
      Light& light = sum[static_cast<std::size_t>(p)];
      light.i += weight * values.i.at(p, k);
      light.q += weight * values.q.at(p, k);
      light.u += weight * values.u.at(p, k);
    }
  }
}

double illuminance_of(const LuminanceRule& rule) {
  double sum = 0;
  for (const double weight : rule.weight) sum += weight;
  return sum;
}

struct Case {
  const char* view;
  std::optional<SecondSun> second_sun;
};
class FramePolarisationOf : public ::testing::TestWithParam<Case> {};

TEST_P(FramePolarisationOf, SkyIsThatOfTheModel) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const LuminanceRule rule = luminance_rule(refs::standard_spectral_data());
  const Atmosphere<double>& atmosphere = earth_clear().atmosphere;
  FrameOptions options = options_of(GetParam().view, 48, 32);
  options.camera.azimuth += 60 * kDegree;
  options.second_sun = GetParam().second_sun;
  Frame frame = renderer().draw(options);
  const double h = options.camera.altitude_m;
  add_polarisation(*model, atmosphere, rule, h, options, PolarisationAngle::kClockwise, frame);
  ASSERT_TRUE(frame.polarisation);
  const auto& [q, u, degree, angle_deg] = *frame.polarisation;
  std::vector<std::size_t> pixels;
  std::vector<SkyPoint> points, of_second;
  for (std::size_t i = 0; i < q.size(); i += 5) {
    if (!is_sky(frame, i)) {
      EXPECT_TRUE(std::isnan(q[i]) && std::isnan(u[i]) && std::isnan(degree[i]));
      continue;
    }
    const double zenith = frame.view_zenith_deg[i] * kDegree,
                 azimuth = frame.view_azimuth_deg[i] * kDegree;
    if (h > 1e5 && (atmosphere.bottom_radius_m + h) * std::sin(zenith) > atmosphere.top_radius_m) {
      EXPECT_EQ(degree[i], 0);  // space
      continue;
    }
    pixels.push_back(i);
    points.push_back({h, options.sun_zenith, zenith, -azimuth});
    if (const auto& second = options.second_sun)
      of_second.push_back({h, second->zenith, zenith, second->azimuth - azimuth});
  }
  ASSERT_GT(pixels.size(), 10u);
  std::vector<Light> expected;
  add_light(*model, rule, 1, points, expected);
  if (const auto& second = options.second_sun) {
    const LuminanceRule own = second->spectra ? luminance_rule(*second->spectra) : rule;
    const double share = second->irradiance * illuminance_of(rule) / illuminance_of(own);
    add_light(*model, own, share, of_second, expected);
  }
  double worst = 0, most_polarised = 0;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const std::size_t i = pixels[k];
    const Light& light = expected[k];
    worst = std::max({worst, std::abs(double{q[i]} - light.q) / light.i,
                      std::abs(double{u[i]} - light.u) / light.i,
                      std::abs(double{degree[i]} - std::hypot(light.q, light.u) / light.i)});
    most_polarised = std::max(most_polarised, double{degree[i]});
    const double angle = angle_deg[i] * kDegree;
    EXPECT_NEAR(std::cos(2 * angle) * double{degree[i]}, double{q[i]} / light.i,
                2 * kInterpolation);
    EXPECT_NEAR(std::sin(2 * angle) * double{degree[i]}, double{u[i]} / light.i,
                2 * kInterpolation);
  }
  std::printf("[ stokes ] %s: worst %.4f of I in %zu directions, degree to %.2f\n", GetParam().view,
              worst, pixels.size(), most_polarised);
  EXPECT_GT(most_polarised, 0.2);
  EXPECT_LT(worst, kInterpolation);
}

SecondSun red_sun() {
  Star star;
  star.spectrum = StarSpectrum::kBlackBody;
  star.temperature_k = 3000;
  return {
      .zenith = 1.2,
      .azimuth = 0.9,
      .irradiance = 0.4,
      .spectra = std::make_shared<const SpectralData>(under(refs::standard_spectral_data(), star))};
}

const SecondSun kSecond = {.zenith = 1.2, .azimuth = 0.9, .irradiance = 0.4};
INSTANTIATE_TEST_SUITE_P(Views, FramePolarisationOf,
                         ::testing::Values(Case{"ground", red_sun()}, Case{"10km", std::nullopt},
                                           Case{"limb", kSecond}));

}  // namespace
}  // namespace skyfit
