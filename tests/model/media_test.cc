// SPDX-License-Identifier: Apache-2.0
// Phase functions and profiles, in closed form or from tables: integrals, moments, columns, and the
// same sky from a table as from the formula that it was made of.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "data_refs/spectra.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/profile.h"
#include "model/numerics/gauss.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
const WavelengthNode kGreen{550, 3e-25};

double radiance(const Atmosphere<double>& a, const SkyPoint& point) {
  return make_sky_model("reference", refs::standard_spectral_data(), 1)
      ->radiance(a, {&kGreen, 1}, {&point, 1}, {})
      .at(0, 0);
}

// 2 pi integral f(nu) P_l(nu) dnu
template <class F>
double legendre_integral(int l, F f) {
  const GaussRule rule = gauss_legendre(200);
  double sum = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double nu = 2 * rule.node[i] - 1;
    sum += 4 * kPi * rule.weight[i] * f(nu) * std::legendre(static_cast<unsigned>(l), nu);
  }
  return sum;
}

TwoColumns phase_columns(double step_deg, double factor, const PhaseFunction<double>& phase) {
  TwoColumns table;
  const int steps = static_cast<int>(std::lround(180 / step_deg));
  for (int i = 0; i <= steps; ++i) {
    table.x.push_back(180.0 * i / steps);
    table.y.push_back(factor * phase_value(phase, std::cos(kPi * i / steps)));
  }
  return table;
}

PhaseFunction<double> tabulated(TwoColumns table) {
  PhaseFunction<double> phase{PhaseType::kTabulated};
  phase.table = std::make_shared<const TabulatedPhase>(std::move(table));
  return phase;
}

// exp(-h / H) at heights that are denser below.
TabulatedProfile exponential_table(double scale_height, double top, int steps) {
  TwoColumns table;
  for (int i = 0; i <= steps; ++i) {
    const double x = static_cast<double>(i) / steps;
    table.x.push_back(top * x * x);
    table.y.push_back(std::exp(-table.x.back() / scale_height));
  }
  return std::make_shared<const LinearProfile>(std::move(table));
}

constexpr double kRounding = 1e-12;

TEST(RayleighPhase, IntegratesToOneAndHasItsMomentForEveryDepolarisation) {
  Shared<double> shared;
  EXPECT_NEAR(rayleigh_moments(0)[2], 0.1, kRounding);
  EXPECT_NEAR(shared.rayleigh_phase(0.0, 0.3), 3 / (16 * kPi) * 1.09, kRounding);
  EXPECT_NEAR(shared.rayleigh_phase(1.0, 0.3), 1 / (4 * kPi), kRounding);
  for (const double rho : {0.0, 0.0279, 0.3, 1.0}) {
    for (int l = 0; l < 3; ++l) {
      const auto phase = [&](double nu) { return shared.rayleigh_phase(rho, nu); };
      EXPECT_NEAR(legendre_integral(l, phase), rayleigh_moments(rho)[static_cast<std::size_t>(l)],
                  kRounding);
    }
  }
}

TEST(TabulatedPhase, MomentsAreThoseOfHenyeyAndGreenstein) {
  constexpr double kFineSteps = 1e-6;  // of 0.02 deg
  const PhaseFunction<double> exact{PhaseType::kHenyeyGreenstein, 0.8};
  const PhaseFunction<double> table = tabulated(phase_columns(0.02, 1, exact));
  const auto chi = phase_moments(table, 65), expected = phase_moments(exact, 65);
  for (std::size_t l = 0; l < chi.size(); ++l) EXPECT_NEAR(chi[l], expected[l], kFineSteps) << l;
}

TEST(TabulatedPhase, MomentsOfTwoRowsAreExact) {
  // exp(a - b angle) with b = 2: 2 pi integral of sin = 2 pi (1 + e^(-2 pi)) / 5 exp(a).
  const double at_zero = 5 / (2 * kPi * (1 + std::exp(-2 * kPi)));
  const TabulatedPhase phase({{0, 180}, {at_zero, at_zero * std::exp(-2 * kPi)}});
  EXPECT_NEAR(phase.phase(0), at_zero, kRounding);
  // cos: integral e^(-2 x) sin(2 x) / 2 = (1 - e^(-2 pi)) / 8.
  EXPECT_NEAR(phase.moments(2)[1], 2 * kPi * at_zero * (1 - std::exp(-2 * kPi)) / 8, kRounding);
  const auto chi = phase.moments(65);
  for (int l = 0; l < 65; l += 16) {
    // Gauss's 200 nodes in nu meet the root of the slope at both ends.
    constexpr double kEnds = 1e-6;
    EXPECT_NEAR(legendre_integral(l, [&](double nu) { return phase.phase(std::acos(nu)); }),
                chi[static_cast<std::size_t>(l)], kEnds);
  }
}

TEST(TabulatedPhase, IsNormalisedWithinFivePercentOnly) {
  const PhaseFunction<double> exact{PhaseType::kCornetteShanks, 0.6};
  const TabulatedPhase phase(phase_columns(0.1, 1.04, exact));
  constexpr double kSteps = 1e-6;  // of 0.1 deg
  EXPECT_NEAR(phase.moments(1)[0], 1, kRounding);
  EXPECT_NEAR(phase.phase(1.0) / phase_value(exact, std::cos(1.0)), 1, kSteps);
  EXPECT_THROW(TabulatedPhase(phase_columns(0.1, 1.06, exact)), std::invalid_argument);
}

// A uniform shell ends where the ray meets its sphere; on small planets the pieces are split.
TEST(LinearProfile, ColumnOfAUniformShellIsTheDistance) {
  constexpr double kSplit = 1e-8;
  Shared<double> shared;
  const LinearProfile uniform({{0, 3e3, 20e3}, {1, 1, 1}});
  for (const double bottom : {1e3, 50e3, 6360e3, 1e9}) {
    for (const double height : {0.0, 2e3, 10e3}) {
      for (const double mu : {1.0, 0.3, 0.01, 0.0}) {
        const double expected = shared.distance_to_outer_sphere(bottom, height, mu, 20e3);
        EXPECT_NEAR(linear_column(uniform, bottom, height, mu, 100e3) / expected, 1, kSplit);
        const double cut = shared.distance_to_outer_sphere(bottom, height, mu, 15e3);
        EXPECT_NEAR(linear_column(uniform, bottom, height, mu, 15e3) / cut, 1, kSplit);
      }
    }
  }
}

// integral of r - R over the path t = t0 .. t1, r^2 = p^2 + t^2: (t r + p^2 asinh(t / p)) / 2 - R
// t.
TEST(LinearProfile, ColumnOfALinearDensityIsItsIntegral) {
  constexpr double kSplit = 1e-8;
  for (const double bottom : {1e3, 50e3}) {
    for (const double mu : {0.9, 0.3, 0.01}) {
      const double top = 20e3, p = bottom * std::sqrt(1 - mu * mu);
      const LinearProfile rising({{0, top}, {0, top}});
      const auto integral = [&](double r) {
        const double t = std::sqrt(r * r - p * p);
        return 0.5 * (t * r + p * p * std::asinh(t / p)) - bottom * t;
      };
      const double expected = integral(bottom + top) - integral(bottom);
      EXPECT_NEAR(linear_column(rising, bottom, 0, mu, 100e3) / expected, 1, kSplit)
          << bottom << ' ' << mu;
    }
  }
}

TEST(LinearProfile, ColumnsOfATabulatedExponentialAreChapmans) {
  constexpr double kSteps = 3e-4;  // of 400 pieces
  const TabulatedProfile table = exponential_table(8000, 100e3, 400);
  EXPECT_NEAR(table->vertical_column() / (8000 * (1 - std::exp(-12.5))), 1, kSteps);
  for (const double height : {0.0, 5e3, 20e3}) {
    for (const double mu : {1.0, 0.2, 0.0, -0.02}) {
      if (height == 0 && mu < 0) continue;
      const double expected = exponential_column(6360e3, height, mu, 100e3, 8000).value;
      EXPECT_NEAR(linear_column(*table, 6360e3, height, mu, 100e3) / expected, 1, kSteps)
          << height << ' ' << mu;
    }
  }
}

TEST(Profile, HeightsOfTheQuadratureLieAtTheSameSharesOfTheColumn) {
  const std::vector<double> exact =
      Profile(VerticalProfile<double>{.scale_height_m = 1200}).quadrature_heights();
  const std::vector<double> table =
      Profile(tabulated_profile(exponential_table(1200, 30e3, 300))).quadrature_heights();
  ASSERT_EQ(table.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(table[i], exact[i], 2);
}

TEST(Profile, DensityIsZeroAboveTheTableAndLinearWithin) {
  const Profile profile(tabulated_profile(
      std::make_shared<const LinearProfile>(TwoColumns{{0, 1e3, 3e3}, {1, 2, 0}})));
  EXPECT_DOUBLE_EQ(profile.density(0).value, 1);
  EXPECT_DOUBLE_EQ(profile.density(500).value, 1.5);
  EXPECT_DOUBLE_EQ(profile.density(2e3).value, 1);
  EXPECT_EQ(profile.density(3001).value, 0);
  EXPECT_EQ(profile.shapes(), 0u);
  EXPECT_DOUBLE_EQ(profile.vertical_column().value, 3500);
}

Atmosphere<double> hazy() {
  Atmosphere<double> a;
  a.at("mie").amount = 1e-4;
  a.at("mie").phase = {PhaseType::kHenyeyGreenstein, 0.7};
  return a;
}

const std::vector<SkyPoint> kPoints = {
    {0, 0.5, 0.8, 0.3}, {0, 1.3, 1.45, 0}, {0, 1.3, 1.2, kPi}, {8e3, 1.0, 2.0, 1.0}};

// Kinds of corner_profiles(): each has a column, is 0 at its end and says what is wrong by field.
struct Corners {
  const char* kind;
  ProfileNumbers numbers;
  double column, inside, outside;  // heights of density 1 and 0
  ProfileNumbers wrong;
  std::size_t wrong_number;
};
class EveryCornerProfile : public ::testing::TestWithParam<Corners> {};

TEST_P(EveryCornerProfile, HasItsClosedForm) {
  const Corners& c = GetParam();
  VerticalProfile<double> given;
  given.type = ProfileType::kCorners;
  given.corners = corner_profile_named(c.kind);
  given.numbers = c.numbers;
  const Profile profile(given);
  EXPECT_NEAR(profile.vertical_column().value, c.column, 1e-9 * c.column);
  EXPECT_NEAR(profile.density(c.inside).value, 1, 1e-12);
  EXPECT_EQ(profile.density(c.outside).value, 0);
  const CornerProfile& kind = corner_profiles()[given.corners];
  EXPECT_FALSE(kind.problem(c.numbers));
  ASSERT_TRUE(kind.problem(c.wrong));
  EXPECT_EQ(kind.problem(c.wrong)->number, c.wrong_number);
}

TEST(CornerProfiles, AreAllTested) { EXPECT_EQ(corner_profiles().size(), 2u); }

INSTANTIATE_TEST_SUITE_P(
    All, EveryCornerProfile,
    ::testing::Values(Corners{"tent", {25e3, 15e3}, 15e3, 25e3, 40.1e3, {25e3, 26e3}, 0},
                      Corners{
                          "mixed-layer", {1200, 2000}, 1200 + 400, 600, 2001, {1200, 1200}, 1}));

TEST(TabulatedSky, IsThatOfTheFormulasTheTableWasMadeOf) {
  constexpr double kPhaseSteps = 5e-5;      // of 0.25 deg
  constexpr double kProfileSteps = 1.5e-3;  // of 300 pieces, 6e-4 of the column
  Atmosphere<double> phase = hazy();
  phase.at("mie").phase = tabulated(phase_columns(0.25, 1, phase.at("mie").phase));
  Atmosphere<double> profiles = hazy();
  profiles.at("rayleigh").profile = tabulated_profile(exponential_table(8000, 100e3, 300));
  profiles.at("mie").profile = tabulated_profile(exponential_table(1200, 30e3, 300));
  profiles.at("ozone").profile = tabulated_profile(
      std::make_shared<const LinearProfile>(TwoColumns{{0, 10e3, 25e3, 40e3}, {0, 0, 7, 0}}));
  for (const SkyPoint& point : kPoints) {
    const double expected = radiance(hazy(), point);
    EXPECT_NEAR(radiance(phase, point) / expected, 1, kPhaseSteps);
    EXPECT_NEAR(radiance(profiles, point) / expected, 1, kProfileSteps);
  }
}

TEST(SitePressure, MultipliesTheCoefficient) {
  Atmosphere<double> low = hazy(), thin = hazy();
  low.at("rayleigh").site_pressure_hpa = kStandardPressureHpa / 2;
  thin.at("rayleigh").amount /= 2;
  EXPECT_DOUBLE_EQ(radiance(low, kPoints[0]), radiance(thin, kPoints[0]));
}

TEST(Depolarisation, MakesTheSkyAtARightAngleToTheSunBrighter) {
  Atmosphere<double> real = hazy();
  real.at("mie").amount = 0;
  Atmosphere<double> spheres = real;
  real.at("rayleigh").phase.depolarisation = 0.0279;
  const SkyPoint right_angle{0, kPi / 4, kPi / 4, kPi};
  const double ratio = radiance(real, right_angle) / radiance(spheres, right_angle);
  // (1 + rho) 2 / (2 + rho) of single scattering, less of what was scattered before
  EXPECT_GT(ratio, 1.005);
  EXPECT_LT(ratio, 1.0279 * 2 / 2.0279);
}

TEST(Tables, HaveNoParametersOfTheFormulasTheyReplace) {
  Atmosphere<double> a = hazy();
  a.at("mie").phase = tabulated(phase_columns(1, 1, a.at("mie").phase));
  a.at("rayleigh").profile = tabulated_profile(exponential_table(8000, 100e3, 100));
  for (const Parameter p : {Parameter::kMiePhaseG, Parameter::kMiePhaseG1, Parameter::kMiePhaseG2,
                            Parameter::kMiePhaseWeight, Parameter::kRayleighScaleHeight}) {
    EXPECT_FALSE(has_parameter(a, p)) << p.name();
  }
  EXPECT_TRUE(has_parameter(a, Parameter::kMieScaleHeight));
  a.at("mie").profile = a.at("rayleigh").profile;
  EXPECT_FALSE(has_parameter(a, Parameter::kMieScaleHeight));
}

}  // namespace
}  // namespace skyfit
