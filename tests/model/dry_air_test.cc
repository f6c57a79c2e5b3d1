// SPDX-License-Identifier: Apache-2.0
// Dry air has the cross sections and optical depths that Bodhaine et al. 1999 print and fit, goes
// as its pressure, and keeps its optical depth whatever its scale height.
#include "model/atmosphere/dry_air.h"

#include <gtest/gtest.h>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/preset.h"

namespace skyfit {
namespace {

constexpr double kCo2 = 360;          // ppm, of the paper's tables
constexpr double kFiveDigits = 1e-4;  // of the printed figures
constexpr double kTheirFit = 2e-4;    // equations (29) and (30) follow the paper's own sums so well

// Equation (30): the optical depth at sea level, 1013.25 hPa and 45 deg; wavelength in um.
double fitted_depth(double um) {
  const double s = um * um;
  return 0.0021520 * (1.0455996 - 341.29061 / s - 0.90230850 * s) /
         (1 + 0.0027059889 / s - 85.968563 * s);
}

double depth(double nm, double pressure_hpa) {
  return pressure_hpa * air_column_per_hpa(kCo2) * rayleigh_cross_section_m2(nm, kCo2);
}

TEST(DryAir, HasThePrintedCrossSectionsAndOpticalDepths) {
  struct Row {
    double nm, cross_section_cm2, at_sea_level;
  };
  for (const Row& row :
       {Row{400, 1.6738e-26, 0.36022}, {405, 1.5895e-26, 0.34207}, {410, 1.5105e-26, 0.32506}}) {
    EXPECT_NEAR(1e4 * rayleigh_cross_section_m2(row.nm, kCo2) / row.cross_section_cm2, 1,
                kFiveDigits);
    EXPECT_NEAR(depth(row.nm, 1013.25) / row.at_sea_level, 1, kFiveDigits);
  }
}

TEST(DryAir, FollowsTheirFitOfTheOpticalDepth) {
  for (double nm = 300; nm <= 850; nm += 25)
    EXPECT_NEAR(depth(nm, 1013.25) / fitted_depth(1e-3 * nm), 1, kTheirFit) << nm;
}

// 1.0487 at 550 nm; rho = 6 (F - 1) / (3 + 7 F) solves F = (6 + 3 rho) / (6 - 7 rho).
TEST(DryAir, DepolarisationSolvesKingsFactor) {
  for (const double nm : {300.0, 550.0, 1000.0}) {
    const double factor = king_factor(nm, kCo2), rho = king_depolarisation(nm, kCo2);
    EXPECT_NEAR((6 + 3 * rho) / (6 - 7 * rho), factor, 1e-14);
  }
  EXPECT_NEAR(king_factor(550, kCo2), 1.0488, 1e-4);
  EXPECT_GT(king_factor(300, kCo2), king_factor(1000, kCo2));
}

TEST(DryAir, OpticalDepthGoesAsThePressureAndNotAsTheScaleHeight) {
  Atmosphere<double> a;
  a.constituents = {standard_air<double>()};
  Constituent<double>& air = a.constituents.front();
  air.co2_ppm = kCo2;
  const double standard = vertical_optical_depth(a, air, {400, 0});
  EXPECT_NEAR(standard / 0.36022, 1, kFiveDigits);
  air.profile.scale_height_m = 6500;
  EXPECT_NEAR(vertical_optical_depth(a, air, {400, 0}) / standard, 1, 1e-14);
  set_site_pressure(a, 506.625);
  EXPECT_NEAR(vertical_optical_depth(a, air, {400, 0}) / standard, 0.5, 1e-14);
}

TEST(DryAir, PresetKeepsIt) {
  Preset preset{"air", {}, {}, {}};
  preset.atmosphere.constituents = {standard_air<double>()};
  Constituent<double>& air = preset.atmosphere.constituents.front();
  air.amount = 719;
  air.co2_ppm = 420;
  set_king_depolarisation(air);
  const Atmosphere<double> again = parse_preset(preset_to_json(preset), "again").atmosphere;
  EXPECT_EQ(again, preset.atmosphere);
}

}  // namespace
}  // namespace skyfit
