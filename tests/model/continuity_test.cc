// SPDX-License-Identifier: Apache-2.0
// Nothing steps when the sun crosses the horizon, the view crosses it, or the observer rises out of
// the atmosphere; and an eye on the ground that looks down sees the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const WavelengthNode kGreen{550, 0};

Atmosphere<double> haze(double aerosol_per_m = 1.5e-4) {
  Atmosphere<double> a;
  a.at("ozone").amount = 0;
  set_scattering(a.at("mie"), 550, aerosol_per_m, 1.0);
  a.at("mie").phase.g = 0.65;
  return a;
}

// The largest difference between a logarithmic step and the mean of the steps before and after.
double worst_kink(const std::vector<SkyPoint>& points) {
  const SkyValues sky = make_sky_model("reference", refs::standard_spectral_data(), 2)
                            ->radiance(haze(), {&kGreen, 1}, points, {});
  std::vector<double> step;
  for (std::size_t i = 1; i < points.size(); ++i)
    step.push_back(std::log(sky.value[i] / sky.value[i - 1]));
  double worst = 0;
  for (std::size_t i = 1; i + 1 < step.size(); ++i)
    worst = std::max(worst, std::abs(step[i] - 0.5 * (step[i - 1] + step[i + 1])));
  return worst;
}

TEST(Continuity, OfTheSunThroughTheHorizon) {
  for (const double view : {0.0, 60.0, 85.0, 89.0}) {
    for (const double azimuth : {0.0, 120.0, 180.0}) {
      std::vector<SkyPoint> points;
      for (double sun = 80; sun <= 94; sun += 0.1)
        points.push_back({0, sun * kDegree, view * kDegree, azimuth * kDegree});
      constexpr double kOfTheGrid = 5e-3;  // cubics meet at the grid's suns
      EXPECT_LT(worst_kink(points), kOfTheGrid) << "view " << view << " azimuth " << azimuth;
    }
  }
}

// In haze the horizon itself is soft from above.
TEST(Continuity, OfTheViewThroughTheHorizon) {
  for (const double altitude : {2e3, 10e3}) {
    std::vector<SkyPoint> points;
    for (double view = 85; view <= 100; view += 0.05)
      points.push_back({altitude, 50 * kDegree, view * kDegree, 1});
    // The horizon is a kink within the width of a step, softened by some 10 to 60 km of haze.
    constexpr double kSoftHorizon = 0.01;
    EXPECT_LT(worst_kink(points), kSoftHorizon) << altitude;
  }
}

// In thick haze the light comes from one mean free path: a ray that stays in it all the way sees no
// less than one a little higher.
TEST(Continuity, OfTheViewAlongThickHaze) {
  std::vector<SkyPoint> points;
  for (double view = 88; view <= 91; view += 0.1)
    points.push_back({500, 62 * kDegree, view * kDegree, 1.7});
  for (const double aerosol_per_m : {6e-4, 2e-3}) {
    const SkyValues sky = make_sky_model("reference", refs::standard_spectral_data(), 2)
                              ->radiance(haze(aerosol_per_m), {&kGreen, 1}, points, {});
    double most = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      most = std::max(most, std::abs(std::log(sky.value[i] / sky.value[i - 1])));
    std::printf("[ haze   ] %g / m: %.2f %% from step to step\n", aerosol_per_m, 100 * most);
    constexpr double kStep = 0.02;  // of 0.1 deg
    EXPECT_LT(most, kStep) << aerosol_per_m;
  }
}

// The same from above the ground's haze, where it is deep: at every altitude, and through the
// horizon.
TEST(Continuity, OfTheViewAlongDeepHaze) {
  Atmosphere<double> deep = haze(6e-4);
  deep.at("mie").profile.scale_height_m = 5000;
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  for (const double altitude : {3e3, 4.9e3, 5.1e3, 7e3}) {
    std::vector<SkyPoint> points;
    for (double view = 89; view <= 92; view += 0.1)
      points.push_back({altitude, 62 * kDegree, view * kDegree, 1.7});
    const SkyValues sky = model->radiance(deep, {&kGreen, 1}, points, {});
    for (std::size_t i = 1; i < points.size(); ++i) {
      constexpr double kStep = 0.02;  // of 0.1 deg, as above
      EXPECT_LT(std::abs(std::log(sky.value[i] / sky.value[i - 1])), kStep)
          << altitude << " m, view " << points[i].view_zenith / kDegree;
    }
  }
}

TEST(Continuity, OfTheObserverThroughTheTop) {
  const double top = haze().top_radius_m - haze().bottom_radius_m;
  for (const double view : {95.0, 120.0, 180.0}) {
    std::vector<SkyPoint> points;
    for (double h = top - 100; h <= top + 100; h += 4)
      points.push_back({h, 50 * kDegree, view * kDegree, 1});
    constexpr double kLastAir = 1e-5;  // the air ends at 4e-6 of its density: a kink, no step
    EXPECT_LT(worst_kink(points), kLastAir) << view;
  }
}

TEST(Continuity, AnEyeOnTheGroundSeesTheGround) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  const Atmosphere<double> a = haze();
  for (const double sun : {0.0, 60.0, 88.0}) {
    const SkyPoint down{0, sun * kDegree, 2.0, 0.5};
    const double ground = model->radiance(a, {&kGreen, 1}, {&down, 1}, {}).at(0, 0);
    const SkyValues light = model->irradiance(a, {&kGreen, 1}, 0, sun * kDegree, {});
    constexpr double kQuadratures = 3e-3;  // of the irradiance: 8 rays there, fine rings here
    const double expected = a.ground_albedo / std::numbers::pi * light.at(kGlobalHorizontal, 0);
    EXPECT_NEAR(ground, expected, kQuadratures * expected) << sun;
  }
}

}  // namespace
}  // namespace skyfit
