// SPDX-License-Identifier: Apache-2.0
// The models without tables say what their published formulas say, worked out by hand, and refuse
// what they cannot do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "data_refs/spectra.h"
#include "model/atmosphere/slant_column.h"
#include "model/literature/nielsen.h"
#include "model/literature/turbidity_sky.h"
#include "model/photometry/photometry.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDigits = 1e-9;  // of the figures worked out by hand
constexpr WavelengthNode kGreen{550, 0};
constexpr SkyPoint kSide{0, 40 * kDegree, 60 * kDegree, 90 * kDegree};

std::unique_ptr<SkyModel> model_named(std::string_view name) {
  return make_sky_model(name, refs::standard_spectral_data(), 2);
}
double radiance(std::string_view name, const Atmosphere<double>& a, const SkyPoint& point) {
  return model_named(name)->radiance(a, {&kGreen, 1}, {&point, 1}, {}).at(0, 0);
}

// beta_R 1.216e-5, beta_M 2.2e-5 1/m, scale heights 8 and 1.2 km, g 0.76: airmass 1.99276.
TEST(HoffmanPreetham, SkyByHand) {
  EXPECT_NEAR(radiance("hoffman-preetham", {}, kSide) / 0.007233582169220366, 1, kDigits);
}

// A path of length d to a black ground scatters (beta P) / beta E (1 - exp(-beta d)).
TEST(HoffmanPreetham, GroundByHand) {
  Atmosphere<double> a;
  a.at("mie").amount = 0;
  a.ground_albedo = 0;
  const SkyPoint down{500, 0, std::numbers::pi, 0};
  const double beta = 1.216e-5,
               sun = std::exp(-beta * 8000 * Shared<double>{}.relative_air_mass(1));
  EXPECT_NEAR(radiance("hoffman-preetham", a, down),
              sun * 3 / (8 * std::numbers::pi) * -std::expm1(-beta * 500), 1e-12);
}

TEST(HoffmanPreetham, RefusesTwilightAndHeight) {
  EXPECT_THROW(radiance("hoffman-preetham", {}, {0, 90 * kDegree, 0, 0}), std::invalid_argument);
  EXPECT_THROW(radiance("hoffman-preetham", {}, {11e3, 0, 0, 0}), std::invalid_argument);
}

// From 3 km, whose horizon has the cosine -0.030698: 0.5 above it is 0.514892 above a level one.
// Haze 0.35 of the way from the clear asymmetry 0.4264 to g = 0.76: 0.54305.
TEST(Nielsen, SkyByHand) {
  SkyPoint high = kSide;
  high.altitude_m = 3000;
  EXPECT_NEAR(radiance("nielsen:sun-through-sky", {}, high) / 0.019026993519271933, 1, kDigits);
}

// From any height the sky runs from the zenith to the horizon that is seen, over which the air is
// as deep as over a level one: light scattered by air alone is P (1 - exp(-beta 1.05 * 190 km)).
TEST(Nielsen, SkyEndsAtTheHorizonThatIsSeen) {
  Atmosphere<double> a;
  a.at("mie").amount = 0;
  constexpr double kBeta = 1.216e-5, kAirPhase = 3 / (16 * std::numbers::pi) * 2;
  for (const double altitude : {0.0, 3e3, 30e3}) {
    const double dip = std::acos(a.bottom_radius_m / (a.bottom_radius_m + altitude));
    const auto light = [&](double above_horizon) {
      return radiance("nielsen", a, {altitude, 0, 0.5 * std::numbers::pi + dip - above_horizon, 0});
    };
    // At mu = 0 the depth falls as mu^0.2.
    constexpr double kBeside = 1e-12, kRoot = 0.01;
    const double nu = std::cos(0.5 * std::numbers::pi + dip - kBeside);
    EXPECT_NEAR(light(kBeside), kAirPhase * (1 + 0.25 * nu * nu) * -std::expm1(-kBeta * 199500),
                kRoot * kAirPhase)
        << altitude;
    // No part of the sky below the level is flat.
    for (double above = 0.1 * dip; above < dip; above += 0.1 * dip)
      EXPECT_GT(light(above), 1.001 * light(above + 0.1 * dip)) << altitude << ", " << above;
  }
}

TEST(Nielsen, BothEndsOfATerrainPathAreHalved) {
  EXPECT_DOUBLE_EQ(Shared<double>{}.nielsen_terrain_depth(0, 0, 1000, 15e3), 1000);
  EXPECT_DOUBLE_EQ(Shared<double>{}.nielsen_terrain_depth(15e3, 0, 2, 15e3), 1 + std::exp(-1.0));
}

TEST(Nielsen, TheOtherMeanIsTheDensityAtTheMeanHeight) {
  EXPECT_DOUBLE_EQ(Shared<double>{}.nielsen_mean_height_depth(30e3, 0, 2, 15e3),
                   2 * std::exp(-1.0));
  const SkyPoint down{4e3, 30 * kDegree, 150 * kDegree, 1};
  const auto light = [&](NielsenMean mean) {
    return NielsenModel({.mean = mean}).radiance({}, {&kGreen, 1}, {&down, 1}, {}).at(0, 0);
  };
  // exp is convex: more air by the mean of the ends.
  EXPECT_GT(light(NielsenMean::kOfDensities), light(NielsenMean::kOfHeights));
}

TEST(Nielsen, RefusesTwilightAndSpace) {
  EXPECT_THROW(radiance("nielsen", {}, {0, 91 * kDegree, 0, 0}), std::invalid_argument);
  EXPECT_THROW(radiance("nielsen", {}, {1e5, 0, 3, 0}), std::invalid_argument);
}

// Turbidity 3, sun at 40 deg, a direction at 60 deg across: xyY of the published formulas.
TEST(Preetham, ColourByHand) {
  Atmosphere<double> a;
  a.at("mie").amount = 2 * 1.216e-5 * 8000 / 1200 * a.at("mie").single_scattering_albedo;
  ASSERT_NEAR(literature::turbidity_of(a), 3, 1e-12);
  const XyzRule sum = xyz_sum_5nm(refs::standard_spectral_data());
  const SkyValues sky = model_named("preetham")->radiance(a, sum.nodes, {&kSide, 1}, {});
  double xyz[3] = {};
  for (std::size_t k = 0; k < sum.nodes.size(); ++k) {
    EXPECT_GT(sky.value[k], 0) << sum.nodes[k].wavelength_nm << " nm";
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += sum.weight[c][k] * sky.value[k];
  }
  const double all = xyz[0] + xyz[1] + xyz[2];
  EXPECT_NEAR(xyz[1] / 7587.880614498681, 1, kDigits);
  EXPECT_NEAR(xyz[0] / all, 0.2502905191845233, kDigits);
  EXPECT_NEAR(xyz[1] / all, 0.2621909539184473, kDigits);
}

// Turbidity is of extinction: a single scattering albedo from a table counts as the number does.
TEST(Preetham, TurbidityKnowsTheAlbedoOfATable) {
  Atmosphere<double> number, table;
  number.at("mie").amount = table.at("mie").amount = 1e-4;
  number.at("mie").single_scattering_albedo = 0.8;
  table.at("mie").single_scattering_albedo = 1;
  table.at("mie").albedo_spectrum = std::make_shared<const SpectrumTable>(
      TwoColumns{{450, 550, 650}, {0.7, 0.8, 0.9}}, kAlbedoFormat);
  EXPECT_NEAR(literature::turbidity_of(table) / literature::turbidity_of(number), 1, 1e-12);
}

// The rules of few wavelengths give the model's luminance and colour back.
TEST(Preetham, FewWavelengthsHoldItsLuminance) {
  Atmosphere<double> a;
  a.at("mie").amount = 1.5e-4;
  const SpectralData& spectra = refs::standard_spectral_data();
  const auto luminance = [&](const LuminanceRule& rule) {
    const SkyValues sky = model_named("preetham")->radiance(a, rule.nodes, {&kSide, 1}, {});
    double sum = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) sum += rule.weight[k] * sky.value[k];
    return sum;
  };
  constexpr double kRule = 1e-4;
  EXPECT_NEAR(luminance(luminance_rule(spectra)) / luminance(luminance_sum_5nm(spectra)), 1, kRule);
}

TEST(Preetham, RefusesWhatItHasNoFormulaFor) {
  Atmosphere<double> clear;
  clear.at("mie").amount = 1e-6;
  EXPECT_THROW(radiance("preetham", clear, kSide), std::domain_error);
  EXPECT_THROW(radiance("preetham", {}, {1e6, 0, 3, 0}), std::invalid_argument);    // space
  EXPECT_THROW(radiance("preetham", {}, {0, 0.5, 2, 0}), std::invalid_argument);    // ground
  EXPECT_THROW(radiance("preetham", {}, {0, 1.6, 0.5, 0}), std::invalid_argument);  // twilight
}

// An atmosphere of O'Neil's geometry.
Atmosphere<double> oneil_earth() {
  Atmosphere<double> a;
  a.top_radius_m = 1.025 * a.bottom_radius_m;
  const double scale_height = 0.25 * 0.025 * a.bottom_radius_m;
  a.at("rayleigh").profile.scale_height_m = a.at("mie").profile.scale_height_m = scale_height;
  a.at("rayleigh").amount = 2e-6;
  a.at("mie").amount = 1e-6;
  a.ground_albedo = 0;
  return a;
}

// The polynomial follows the columns that it was fitted to.
TEST(ONeil, PolynomialFollowsTheColumns) {
  const Atmosphere<double> a = oneil_earth();
  const double bottom = a.bottom_radius_m, top = a.top_radius_m - bottom,
               scale_height = a.at("rayleigh").profile.scale_height_m;
  constexpr double kFit = 0.10;  // at worst, near the horizon
  for (double mu = 1; mu > 0.05; mu -= 0.1) {
    const double column =
        exponential_column(bottom, 0, mu, 10 * top, scale_height).value / scale_height;
    EXPECT_NEAR(Shared<double>{}.oneil_slant(mu) / column, 1, kFit) << "mu = " << mu;
  }
}

// Toward the zenith under a zenith sun: five samples h_i of equal length,
// L = (beta_R P_R + beta_M P_M) ds sum rho exp(-(beta_R + beta_M) H slant).
TEST(ONeil, ZenithByHand) {
  const Atmosphere<double> a = oneil_earth();
  const double top = a.top_radius_m - a.bottom_radius_m,
               h0 = a.at("rayleigh").profile.scale_height_m;
  const double beta_r = 2e-6, beta_m = 1e-6, slant = std::exp(-0.00287);
  double sum = 0;
  for (int i = 0; i < 5; ++i) {
    const double rho = std::exp(-(i + 0.5) * top / 5 / h0);
    // down from the sample to the eye, and from the sun to the sample
    const double column = h0 * slant * ((1 - rho) + rho);
    sum += rho * top / 5 * std::exp(-(beta_r + beta_m) * column);
  }
  const double expected = sum * (beta_r * Shared<double>{}.rayleigh_phase(0, 1) +
                                 beta_m * Shared<double>{}.cornette_shanks_phase(0.76, 1));
  EXPECT_NEAR(radiance("oneil", a, {0, 0, 0, 0}) / expected, 1, 1e-9);
}

// There the transmittance is the same at every sample, so that the light is the midpoint rule of an
// exponential: N samples give (x / 2) / sinh(x / 2) of the integral, x = top / (H N). It converges
// as 1 - x^2 / 24.
TEST(ONeil, SamplesConvergeToTheIntegral) {
  const Atmosphere<double> a = oneil_earth();
  const double h0 = a.at("rayleigh").profile.scale_height_m,
               top = a.top_radius_m - a.bottom_radius_m,
               scattered =
                   h0 * -std::expm1(-top / h0) * std::exp(-(2e-6 + 1e-6) * h0 * std::exp(-0.00287));
  const auto integral = [&](double air_phase) {
    return scattered * (2e-6 * air_phase + 1e-6 * Shared<double>{}.cornette_shanks_phase(0.76, 1));
  };
  const auto share = [&](int samples) {
    const double half = 0.5 * top / (h0 * samples);
    return half / std::sinh(half);
  };
  const SkyPoint zenith{0, 0, 0, 0};
  const double air_phase = Shared<double>{}.rayleigh_phase(0, 1);
  for (const int samples : {1, 3, 5, 50, 1000}) {
    EXPECT_NEAR(radiance("oneil:samples=" + std::to_string(samples), a, zenith) /
                    (integral(air_phase) * share(samples)),
                1, 1e-9)
        << samples << " samples";
  }
  EXPECT_NEAR(radiance("oneil:samples=1000", a, zenith) / integral(air_phase), 1, 1e-6);
  EXPECT_NEAR(radiance("oneil:isotropic-air:samples=3", a, zenith) /
                  (integral(0.25 / std::numbers::pi) * share(3)),
              1, 1e-9);
}

// His polynomial stands in for the planet's shadow: by day there is none, in the depth of night it
// lets nothing through, and without it nothing may stand in.
TEST(ONeil, WithoutTheTestOfTheShadow) {
  const Atmosphere<double> a = oneil_earth();
  const SkyPoint day{0, 40 * kDegree, 60 * kDegree, 1}, night{0, 150 * kDegree, 60 * kDegree, 1},
      twilight{0, 95 * kDegree, 80 * kDegree, 0};
  EXPECT_EQ(radiance("oneil:no-shadow", a, day), radiance("oneil", a, day));
  EXPECT_LT(radiance("oneil:no-shadow", a, night), 1e-12 * radiance("oneil", a, day));
  EXPECT_GT(radiance("oneil:no-shadow", a, twilight), radiance("oneil", a, twilight));
  EXPECT_THROW(radiance("oneil:no-shadow", {}, day), std::invalid_argument);
}

// From space and from inside: where the ray begins makes no difference to the air that it crosses.
TEST(ONeil, SpaceSeesWhatTheTopSees) {
  Atmosphere<double> a = oneil_earth();
  a.ground_albedo = 0.3;
  const double top = a.top_radius_m - a.bottom_radius_m;
  const double inside = radiance("oneil", a, {top, 30 * kDegree, std::numbers::pi, 0}),
               outside = radiance("oneil", a, {5e6, 30 * kDegree, std::numbers::pi, 0});
  EXPECT_NEAR(outside / inside, 1, 1e-9);
  EXPECT_EQ(radiance("oneil", a, {5e6, 30 * kDegree, 0, 0}), 0);  // away from the planet
}

// A ray along the limb goes down and up again: the polynomial's columns stay positive, so that the
// light is that of the closed form in a geometry that differs by a hair.
TEST(ONeil, LimbsFollowTheClosedForm) {
  const Atmosphere<double> polynomial = oneil_earth();
  Atmosphere<double> closed = polynomial;
  closed.at("rayleigh").profile.scale_height_m *= 1.002;  // beyond what counts as his geometry
  constexpr double kFit = 0.15;
  for (const double view : {95.0, 97.0, 100.0}) {
    const SkyPoint limb{60e3, 40 * kDegree, view * kDegree, 1};
    EXPECT_NEAR(radiance("oneil", polynomial, limb) / radiance("oneil", closed, limb), 1, kFit)
        << "view " << view;
  }
}

// No air and no aerosol scatter nothing.
TEST(ClosedForms, OfNoAirAreDark) {
  Atmosphere<double> none;
  none.at("rayleigh").amount = none.at("mie").amount = 0;
  EXPECT_EQ(radiance("hoffman-preetham", none, kSide), 0);
  EXPECT_EQ(radiance("nielsen", none, kSide), 0);
}

TEST(Models, HaveNamesThatMakeThem) {
  for (const SkyModelEntry& entry : sky_models())
    EXPECT_EQ(model_named(entry.name)->name(), entry.name);
  for (const char* name :
       {"nielsen:mean-height", "nielsen:mean-height:rayleigh-phase:sun-through-sky",
        "oneil:samples=3:isotropic-air:no-shadow", "bodare:mie-from-rayleigh",
        "bruneton:half-transmittance:half-inscatter:mie-from-rayleigh"})
    EXPECT_EQ(model_named(name)->name(), name);
  for (const char* wrong : {"nonsense", "nielsen:nonsense", "nielsen:", "oneil:mean-height",
                            "oneil:samples", "oneil:samples=", "oneil:samples=N", "oneil:samples=0",
                            "oneil:samples=1001", "oneil:samples=2.5"})
    EXPECT_THROW(model_named(wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace skyfit
