// SPDX-License-Identifier: Apache-2.0
// The CIE skies equal their closed forms.
#include "data_refs/cie_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kRounding = 1e-14;

TEST(CieSky, ThereAreTypes1To15) {
  ASSERT_EQ(cie_skies().size(), 15u);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(cie_skies()[i].type, i + 1);
}

TEST(CieSky, ZenithIsOneForEverySun) {
  for (const CieSky& sky : cie_skies()) {
    for (double sun = 0; sun < 90; sun += 7.5) {
      EXPECT_NEAR(cie_relative_luminance(sky, sun * kDegree, 0, sun * kDegree), 1.0, kRounding)
          << sky.type;
    }
  }
}

TEST(CieSky, GradationIsOneAtTheHorizonAndContinuousThere) {
  for (const CieSky& sky : cie_skies()) {
    EXPECT_EQ(cie_gradation(sky, kPi / 2), 1.0);
    EXPECT_NEAR(cie_gradation(sky, kPi / 2 - 1e-3), 1.0, 1e-12) << sky.type;
  }
}

TEST(CieSky, IndicatrixIsOneAcrossTheSun) {
  for (const CieSky& sky : cie_skies())
    EXPECT_NEAR(cie_indicatrix(sky, kPi / 2), 1.0, kRounding) << sky.type;
}

TEST(CieSky, Type5IsUniform) {
  for (double view = 0; view <= 90; view += 15) {
    EXPECT_NEAR(cie_relative_luminance(cie_skies()[4], 0.3, view * kDegree, 1.1), 1.0, kRounding);
  }
}

TEST(CieSky, Type1IsThreeTimesBrighterAtTheZenithThanAtTheHorizon) {
  // phi(pi/2) / phi(0) = 1 / (1 + 4 exp(-0.7)): the standard's approximation of 1/3.
  EXPECT_NEAR(cie_relative_luminance(cie_skies()[0], 0.5, kPi / 2, 1.0),
              1.0 / (1.0 + 4.0 * std::exp(-0.7)), kRounding);
  EXPECT_NEAR(cie_relative_luminance(cie_skies()[0], 0.5, kPi / 2, 1.0), 1.0 / 3, 2e-3);
}

TEST(CieSky, Type12AtTheSunIsTheFormulaByHand) {
  // Sun and view at 60 deg: f(0) (1 - exp(-0.64)) / (f(pi/3) (1 - exp(-0.32))).
  const double f_sun = 1 + 10 * (1 - std::exp(-1.5 * kPi)) + 0.45;
  const double f_zenith = 1 + 10 * (std::exp(-kPi) - std::exp(-1.5 * kPi)) + 0.45 * 0.25;
  const double expected = f_sun * (1 - std::exp(-0.64)) / (f_zenith * (1 - std::exp(-0.32)));
  EXPECT_NEAR(cie_relative_luminance(cie_skies()[11], kPi / 3, kPi / 3, 0), expected, 1e-12);
}

TEST(CieSky, TraditionalOvercastFallsToAThird) {
  EXPECT_EQ(traditional_overcast_relative_luminance(0), 1.0);
  EXPECT_NEAR(traditional_overcast_relative_luminance(kPi / 2), 1.0 / 3, kRounding);
  EXPECT_NEAR(traditional_overcast_relative_luminance(kPi / 3), 2.0 / 3, kRounding);
}

}  // namespace
}  // namespace skyfit::refs
