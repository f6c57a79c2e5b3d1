// SPDX-License-Identifier: Apache-2.0
// The tables of `bodare` hold what direct integration gives; an update over frames takes as many
// frames as published and never shows a table that is not finished.
#include "model/literature/bodare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/literature/bodare_update.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "tests/model/truth.h"

namespace skyfit::truth {
namespace {

using literature::BodareSizes;
constexpr double kPi = std::numbers::pi;
constexpr WavelengthNode kGreen{550, 0};

Atmosphere<double> haze(double albedo = 0.2) {
  Atmosphere<double> a = monte_carlo_earth(true);
  a.ground_albedo = albedo;
  return a;
}

// As published: 1.12, not 1.
TEST(Bodare, ElekPhaseIntegratesAsPublished) {
  double sum = 0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    const double nu = -1 + 2 * (i + 0.5) / kSteps;
    sum += 2 * kPi * (2.0 / kSteps) * Shared<double>{}.elek_rayleigh_phase(nu);
  }
  EXPECT_NEAR(sum, 1.12, 1e-12);
}

TEST(Bodare, MappingsInvert) {
  Shared<double> shared;
  const double horizon = shared.bodare_horizon(3e3, 6360e3);
  for (double x = 0; x <= 1; x += 0.125) {
    EXPECT_NEAR(shared.bodare_unit_from_height(shared.bodare_height_from_unit(x, 1e5), 1e5), x,
                1e-12);
    EXPECT_NEAR(
        shared.bodare_unit_from_sky_view(shared.bodare_sky_view_from_unit(x, horizon), horizon), x,
        1e-3);  // the fifth root of a rounding, at the horizon
    EXPECT_NEAR(shared.bodare_unit_from_ground_view(shared.bodare_ground_view_from_unit(x, horizon),
                                                    horizon),
                x, 1e-3);
    EXPECT_NEAR(shared.bodare_unit_from_sun(shared.bodare_sun_from_unit(0.001 + 0.999 * x)),
                0.001 + 0.999 * x, 1e-9);
  }
}

// Aerosol alone, so thin that it scatters once: in the sun's plane, on the sun's side, the table's
// one plane is the truth, but for the interpolation.
TEST(Bodare, SingleScatteringIsTheIntegral) {
  Atmosphere<double> thin = haze(0);
  thin.at("rayleigh").amount = 1e-12;
  thin.at("mie").amount = 1e-8;
  std::vector<SkyPoint> points;
  for (const double sun : {20.0, 60.0, 80.0}) {
    for (const double view : {10.0, 45.0, 75.0})
      points.push_back({0, sun * kDegree, view * kDegree, 0});
  }
  const SpectralData& spectra = refs::standard_spectral_data();
  const SkyValues
      exact = make_sky_model("reference", spectra, 2)->radiance(thin, {&kGreen, 1}, points, {}),
      table = make_sky_model("bodare", spectra, 2)->radiance(thin, {&kGreen, 1}, points, {});
  constexpr double kTable = 0.02;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(table.value[i] / exact.value[i], 1, kTable) << "point " << i;
}

// What a renderer reads holds the rays to the sky, texel by texel.
TEST(Bodare, SkyRaysAreTheRaysToTheSky) {
  const Atmosphere<double> a = haze();
  const literature::BodareGeometry geometry(a);
  const literature::BodareTables<0> tables(
      geometry, literature::clear_air(geometry.shells(), seeded<0>(a, {}), kGreen), {});
  const literature::SkyRayTexels sky = tables.sky_rays();
  ASSERT_EQ(sky.air.values.size(), std::size_t{32} * 64 * 32);
  Shared<double> shared;
  for (const auto& [height, view, sun] : {std::tuple{0, 10, 20}, {5, 63, 31}, {20, 1, 12}}) {
    const double h = geometry.height(height),
                 mu = shared.bodare_sky_view_from_unit(literature::unit_of(view, sky.air.height),
                                                       shared.bodare_horizon(h, a.bottom_radius_m));
    const auto expected = tables.in_scatter(h, mu, literature::BodareGeometry::sun(sun), false);
    const std::size_t texel = (static_cast<std::size_t>(height) * 64 + view) * 32 + sun;
    constexpr double kFloat = 1e-4;  // and the fifth root that finds the texel again
    EXPECT_NEAR(sky.air.values[texel] / expected.air.v, 1, kFloat) << "view " << view;
    EXPECT_NEAR(sky.aerosol.values[texel] / expected.aerosol.v, 1, kFloat) << "view " << view;
  }
}

// The light on the ground is the integral of what the model sends there.
TEST(Bodare, GroundIrradianceIsTheIntegralOfTheSky) {
  const Atmosphere<double> a = haze();
  const literature::BodareGeometry geometry(a);
  const literature::BodareTables<0> tables(
      geometry, literature::clear_air(geometry.shells(), seeded<0>(a, {}), kGreen), {});
  const auto model = make_sky_model("bodare", refs::standard_spectral_data(), 2);
  constexpr double kQuadrature = 0.02;
  for (const double sun : {10.0, 50.0, 75.0}) {
    const SkyValues e = model->irradiance(a, {&kGreen, 1}, 0, sun * kDegree, {});
    EXPECT_NEAR(tables.ground_irradiance(std::cos(sun * kDegree)).v / e.at(kDiffuseHorizontal, 0),
                1, kQuadrature)
        << "sun " << sun;
  }
}

// Equation 19 leaves red as it is, and every wavelength where the air is so thin that light is
// proportional to the coefficients; in haze the approximation is seen in blue, and is a good one by
// day: figure 11.
TEST(Bodare, MieFromRayleighIsItselfInRedAndInThinAir) {
  const auto tables_of = [](const literature::BodareGeometry& geometry, const Atmosphere<double>& a,
                            double nm) {
    const auto air = literature::clear_air(geometry.shells(), seeded<0>(a, {}), {nm, 0});
    return literature::BodareTables<0>(geometry, air, {});
  };
  // Of the aerosol at an angle: formed from air over its own.
  const auto ratios = [&](const Atmosphere<double>& a, double nm) {
    const literature::BodareGeometry geometry(a);
    const auto own = tables_of(geometry, a, nm), red = tables_of(geometry, a, 650);
    auto formed = own, formed_red = red;
    formed.take_aerosol_from_air(red);
    formed_red.take_aerosol_from_air(red);
    const double mu = std::cos(70 * kDegree), mu_s = std::cos(50 * kDegree);
    const auto aerosol = [&](const literature::BodareTables<0>& tables) {
      return tables.in_scatter(0, mu, mu_s, false).aerosol.v;
    };
    return std::pair(aerosol(formed_red) / aerosol(red), aerosol(formed) / aerosol(own));
  };
  constexpr double kRounding = 1e-12, kThin = 1e-3;
  const auto [red_in_haze, blue_in_haze] = ratios(haze(), 450);
  EXPECT_NEAR(red_in_haze, 1, kRounding);
  EXPECT_GT(std::abs(blue_in_haze - 1), 1e-3);
  EXPECT_NEAR(blue_in_haze, 1, 0.15);
  Atmosphere<double> thin = haze(0);
  for (Constituent<double>& c : thin.constituents) c.amount *= 1e-4;
  EXPECT_NEAR(ratios(thin, 450).second, 1, kThin);
}

TEST(BodareUpdate, TakesThePublishedNumberOfFrames) {
  for (const auto& [orders, slices, frames] :
       {std::tuple{1, 2, 1}, {2, 2, 4}, {4, 8, 31}, {5, 32, 148}}) {
    const BodareUpdate update(haze(), {kGreen}, {orders, slices});
    EXPECT_EQ(update.frames_of_update(), frames) << orders << " orders, " << slices << " slices";
  }
}

// After its frames the update equals the tables made at once; until then the picture moves from the
// older finished set to the newer, and neither changes.
TEST(BodareUpdate, NeverShowsAHalfBuiltTable) {
  const Atmosphere<double> before = haze();
  Atmosphere<double> after = haze();
  after.at("mie").amount *= 0.3;
  const SkyPoint point{0, 50 * kDegree, 60 * kDegree, 1};
  const SpectralData& spectra = refs::standard_spectral_data();
  const auto direct = [&](const Atmosphere<double>& a) {
    return make_sky_model("bodare", spectra, 2)
        ->radiance(a, {&kGreen, 1}, {&point, 1}, {})
        .at(0, 0);
  };
  const double first = direct(before), second = direct(after);
  BodareUpdate update(before, {kGreen}, {5, 4});
  const int frames = update.frames_of_update(), ramp = 4 * 4 + 3;  // the orders before the last
  EXPECT_EQ(frames, ramp + 1 + 2);
  const auto blend = [&](int frame) { return std::min(1.0, frame / static_cast<double>(ramp)); };
  for (int frame = 0; frame < frames; ++frame) {
    EXPECT_DOUBLE_EQ(update.blend(), blend(frame));
    EXPECT_NEAR(update.radiance(point)[0] / first, 1, 1e-12) << "frame " << frame;
    update.advance(after);
  }
  for (int frame = 0; frame < frames; ++frame) {  // older is the first, newer the second
    const double expected = first + (second - first) * blend(frame);
    EXPECT_NEAR(update.radiance(point)[0] / expected, 1, 1e-12) << "frame " << frame;
    update.advance(after);
  }
  EXPECT_NEAR(update.radiance(point)[0] / second, 1, 1e-12);
}

TEST(BodareUpdate, RefusesOtherSlices) {
  EXPECT_THROW(BodareUpdate(haze(), {kGreen}, {5, 3}), std::invalid_argument);
  EXPECT_THROW(BodareUpdate(haze(), {kGreen}, {0, 4}), std::invalid_argument);
}

}  // namespace
}  // namespace skyfit::truth
