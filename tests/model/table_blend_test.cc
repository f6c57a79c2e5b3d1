// SPDX-License-Identifier: Apache-2.0
// Tables between two others: at the ends they are those, and halfway the light is that of the
// atmosphere halfway.
#include "model/tables/table_blend.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/tables/table_lookup.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180;
constexpr TableSizes kSmall = {64, 32, 16, 8, 16, 16, 24, 16, 8, 24, 16, 8};

constexpr TableSizes kTiny = {32, 16, 12, 4, 12, 6, 16, 16, 6, 4, 4, 4};

Atmosphere<double> shipped(const char* name) {
  return parse_preset(refs::shipped_preset_json(name), name).atmosphere;
}

AtmosphereTables tables_of(const Atmosphere<double>& atmosphere) {
  return compute_tables(atmosphere, color_rule(refs::standard_spectral_data()), kSmall, 2, {});
}

// A clear sky and one with a quarter more aerosol over brighter ground: the most that one step of
// the timeline changes (render/sequence/timeline.h).
struct Timeline {
  AtmosphereTables clear, hazy;
};
const Timeline& timeline() {
  static const Timeline made = [] {
    const Atmosphere<double> clear = shipped("earth-clear");
    Atmosphere<double> hazy = clear;
    hazy.at("mie").amount *= 1.25;
    hazy.ground_albedo += 0.05;
    return Timeline{tables_of(clear), tables_of(hazy)};
  }();
  return made;
}

void expect_same_light(const AtmosphereTables& tables, const AtmosphereTables& others,
                       double altitude_m, std::initializer_list<double> suns, double tolerance) {
  for (const double sun : suns) {
    for (const double view : {0.0, 45.0, 80.0, 88.0}) {
      for (const double azimuth : {0.0, 90.0, 180.0}) {
        const double mu = std::cos(view * kDegree), mu_s = std::cos(sun * kDegree);
        const double nu = mu * mu_s + std::sin(view * kDegree) * std::sin(sun * kDegree) *
                                          std::cos(azimuth * kDegree);
        const NodeValues expected = lookup_radiance(others, altitude_m, mu, mu_s, nu, false),
                         found = lookup_radiance(tables, altitude_m, mu, mu_s, nu, false);
        for (std::size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(found[k] / expected[k], 1, tolerance)
              << "altitude " << altitude_m << ", sun " << sun << ", view " << view << ", azimuth "
              << azimuth << ", node " << k;
      }
    }
  }
}

TEST(TableBlend, TheEndsAreTheTables) {
  const AtmosphereTables start = interpolated_tables(timeline().clear, timeline().hazy, 0),
                         end = interpolated_tables(timeline().clear, timeline().hazy, 1);
  EXPECT_EQ(start.atmosphere, timeline().clear.atmosphere);
  EXPECT_EQ(start.rayleigh_like.rgba, timeline().clear.rayleigh_like.rgba);
  EXPECT_EQ(start.sky_rays.air.rgba, timeline().clear.sky_rays.air.rgba);
  EXPECT_EQ(start.optical_depth.rgba, timeline().clear.optical_depth.rgba);
  EXPECT_EQ(end.atmosphere, timeline().hazy.atmosphere);
  EXPECT_EQ(end.single.rgba, timeline().hazy.single.rgba);
  EXPECT_EQ(end.sky_rays.aerosol.rgba, timeline().hazy.sky_rays.aerosol.rgba);
  EXPECT_EQ(end.irradiance.rgba, timeline().hazy.irradiance.rgba);
}

TEST(TableBlend, HalfwayIsTheAtmosphereHalfway) {
  const AtmosphereTables blended = interpolated_tables(timeline().clear, timeline().hazy, 0.5);
  constexpr double kOfLogarithms = 0.01;  // (ln 1.25)^2 / 8, for light linear in the parameter
  expect_same_light(blended, tables_of(blended.atmosphere), 2, {10, 60, 85}, kOfLogarithms);
}

TEST(TableBlend, ParametersAreLinearWhateverTheirWavelength) {
  const Atmosphere<double> a = shipped("earth-clear");
  Atmosphere<double> b = a;
  // The same aerosol, stated at 680 nm, and twice as much of it.
  set_scattering(b.at("mie"), 680,
                 2 * a.at("mie").amount *
                     std::pow(680 / a.at("mie").wavelength_nm, -a.at("mie").angstrom_exponent),
                 a.at("mie").angstrom_exponent);
  b.at("ozone").amount = a.at("ozone").amount + 40;
  const Atmosphere<double> between = interpolated_atmosphere(a, b, 0.25);
  EXPECT_NEAR(between.at("mie").amount / a.at("mie").amount, 1.25, 1e-12);
  EXPECT_NEAR(between.at("ozone").amount, a.at("ozone").amount + 10, 1e-9);
}

// Cloud that sinks and becomes thicker by a quarter: the heights of the tables go with it.
TEST(SlowTableBlend, HalfwayALayerIsHalfway) {
  Atmosphere<double> before = shipped("overcast");
  Constituent<double>& cloud = before.at("cloud");
  cloud.amount_type = AmountType::kOpticalDepth;
  cloud.amount = 4;
  cloud.profile.base_m = 2500;
  cloud.profile.top_m = 3000;
  Atmosphere<double> after = before;
  after.at("cloud").amount = 5;
  after.at("cloud").profile.base_m = 2000;
  after.at("cloud").profile.top_m = 2400;
  const std::vector<Shells> shells = {shells_of(before, Keep::kAll), shells_of(after, Keep::kAll)};
  const std::vector<HeightAxis> axes = height_axes(shells, kTiny.scattering_r);
  const auto tables = [](const Atmosphere<double>& a, const std::optional<HeightAxis>& axis) {
    return compute_tables(a, color_rule(refs::standard_spectral_data()), kTiny, 2, {}, {}, axis);
  };
  const AtmosphereTables blended =
      interpolated_tables(tables(before, axes[0]), tables(after, axes[1]), 0.5);
  const AtmosphereTables computed = tables(blended.atmosphere, {});
  // 12 % in the cloud's upper part, elsewhere 10; toward a sun at 85 deg it is 29 there.
  constexpr double kOfOneStep = 0.13;
  for (const double altitude : {2.0, 2000.0, 2300.0, 2600.0, 3000.0})
    expect_same_light(blended, computed, altitude, {10, 60}, kOfOneStep);
}

TEST(TableBlend, RefusesWhatHasNothingBetween) {
  const Atmosphere<double> a = shipped("earth-clear");
  Atmosphere<double> b = a;
  b.top_radius_m += 1e3;
  EXPECT_THAT([&] { interpolated_atmosphere(a, b, 0.5); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("planet.top_radius_m: differs")));
  b = a;
  b.at("mie").phase.type = a.at("mie").phase.type == PhaseType::kTwoLobe
                               ? PhaseType::kHenyeyGreenstein
                               : PhaseType::kTwoLobe;
  EXPECT_THAT([&] { interpolated_atmosphere(a, b, 0.5); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("mie.phase.type: differs")));
}

}  // namespace
}  // namespace skyfit
