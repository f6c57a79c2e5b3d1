// SPDX-License-Identifier: Apache-2.0
// The air of a measured sky has the pressure of its site, with a prior of half a percent, and the
// gases that absorb; a fit that pulls the pressure away says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit.h"
#include "fit/problem/problem.h"
#include "fit/result/report.h"
#include "model/atmosphere/derived.h"
#include "model/registry.h"
#include "tests/fit/scans.h"
#include "tests/fit/toy_sky.h"

namespace skyfit::fit {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

refs::Reference scans() { return synthetic_scans(ToySky(), Atmosphere<double>{}, {}); }

Problem problem_of(const refs::Reference& reference, const FitOptions& options) {
  static const ToySky model;
  return make_problem(reference, refs::standard_spectral_data(), model, options);
}

const Unknown* unknown(const Problem& problem, const std::string& name) {
  const auto found = std::ranges::find(problem.unknowns, name, &Unknown::name);
  return found == problem.unknowns.end() ? nullptr : &*found;
}

void expect_pressure(const Problem& problem, double pressure_hpa) {
  const Unknown* const air = unknown(problem, "rayleigh.pressure");
  ASSERT_NE(air, nullptr);
  ASSERT_TRUE(air->prior);
  EXPECT_NEAR(air->prior->mean, pressure_hpa, 1e-9);
  EXPECT_NEAR(air->prior->sigma, 0.005 * pressure_hpa, 1e-9);
  const Atmosphere<double>& start = problem.start.atmosphere.front();
  EXPECT_EQ(start.at("rayleigh").amount, start.at("oxygen_pairs").amount);
  EXPECT_NE(start.find("nitrogen_dioxide"), nullptr);
}

TEST(MeasuredAir, HasThePressureOfItsSite) {
  FitOptions options;
  options.site_pressure_hpa = 719;
  expect_pressure(problem_of(scans(), options), 719);
  refs::Reference high = scans();
  for (refs::Scan& scan : high.scans) scan.elevation_m = 1000;
  const Problem problem = problem_of(high, {});
  expect_pressure(problem, standard_pressure_hpa(1000));
  EXPECT_THAT(problem.assumptions, IsEmpty());
}

TEST(MeasuredAir, OfASiteWithoutElevationIsThatOfTheSeaAndSaidToBe) {
  const Problem problem = problem_of(scans(), {});
  expect_pressure(problem, kStandardPressureHpa);
  ASSERT_EQ(problem.assumptions.size(), 1u);
  EXPECT_THAT(problem.assumptions.front(), HasSubstr("1013.25 hPa"));
}

TEST(MeasuredAir, IsNotThatOfRelativeLuminancesAndPresets) {
  FitOptions options;
  options.start = power_law_air();
  EXPECT_EQ(unknown(problem_of(scans(), options), "rayleigh.pressure"), nullptr);
  refs::Reference relative = scans();
  relative.quantity = refs::Quantity::kRelativeLuminance;
  for (refs::Sample& sample : relative.samples) sample.wavelength_nm = 0;
  EXPECT_NE(unknown(problem_of(relative, {}), "rayleigh.scattering"), nullptr);
}

// By default parameters of `mie` are free; an aerosol of another name stays, and that is said.
TEST(MeasuredAir, AnAerosolOfAnotherNameThatStaysIsSaid) {
  FitOptions options;
  options.lobes = 1;
  options.start = power_law_air();
  EXPECT_THAT(problem_of(scans(), options).assumptions, IsEmpty());
  options.start->atmosphere.at("mie").name = "dust";
  const Problem problem = problem_of(scans(), options);
  EXPECT_EQ(unknown(problem, "dust.scattering"), nullptr);
  EXPECT_THAT(problem.assumptions,
              ElementsAre(AllOf(HasSubstr("the aerosol dust stays"), HasSubstr("--free names"),
                                HasSubstr("dust.scattering"))));
  options.free = std::vector{Parameter::kGroundAlbedo};
  EXPECT_THAT(problem_of(scans(), options).assumptions, IsEmpty()) << "asked for";
  options.free.reset();
  options.fix[{"dust", Quantity::kScattering}] = 1e-5;
  EXPECT_THAT(problem_of(scans(), options).assumptions, IsEmpty()) << "asked for";
}

// Air of 950 hPa, noise of a thousandth, and a site that states 1000 hPa: the sky tells it well.
TEST(MeasuredAir, ThatIsPulledFromItsPressureIsSaid) {
  const auto model =
      make_sky_model("reference", refs::standard_spectral_data(), 1, Transfer::kScalar);
  Atmosphere<double> truth;
  truth.at("rayleigh") = standard_air<double>();
  truth.constituents.push_back(standard_oxygen_pairs<double>());
  truth.constituents.push_back(standard_nitrogen_dioxide<double>());
  SyntheticScans how;
  how.sun_zenith_deg = {40, 60};
  how.azimuths = 3;
  how.wavelength_nm = {420, 600};
  how.sun_distance_au = 1;
  FitOptions options;
  options.lobes = 1;
  options.free = std::vector{Parameter::kRayleighPressure};
  options.pointing = Pointing::kStated;
  options.noise = NoiseModel{0.001, 0};
  options.site_pressure_hpa = 1000;
  const auto report = [&](double pressure_hpa) {
    set_site_pressure(truth, pressure_hpa);
    truth.at("oxygen_pairs").amount = 1000;
    return full_report(fit_atmosphere(synthetic_scans(*model, truth, how),
                                      refs::standard_spectral_data(), *model, options),
                       {});
  };
  EXPECT_THAT(report(950), HasSubstr("rayleigh.pressure is -"));
  EXPECT_THAT(report(1000), Not(HasSubstr("rayleigh.pressure is ")));
}

FitOptions options_knowing(const refs::AerosolKnowledge& known) {
  FitOptions options;
  options.aerosol = known;
  return options;
}

TEST(MeasuredAir, AKnownAerosolIsStartAndPrior) {
  const FitOptions options =
      options_knowing({Prior{0.2, 0.01}, Prior{1.4, 0.1}, Prior{0.95, 0.03}, {"prior: by a test"}});
  const Problem problem = problem_of(scans(), options);
  EXPECT_EQ(unknown(problem, "mie.scattering"), nullptr);
  for (const auto& [name, prior] : {std::pair{"mie.optical_depth", Prior{0.2, 0.01}},
                                    std::pair{"mie.angstrom_exponent", Prior{1.4, 0.1}},
                                    std::pair{"mie.single_scattering_albedo", Prior{0.95, 0.03}}}) {
    const Unknown* const known = unknown(problem, name);
    ASSERT_NE(known, nullptr) << name;
    ASSERT_TRUE(known->prior) << name;
    EXPECT_EQ(known->prior->mean, prior.mean) << name;
    EXPECT_EQ(known->prior->sigma, prior.sigma) << name;
  }
  const Atmosphere<double>& start = problem.start.atmosphere.front();
  EXPECT_NEAR(aerosol_optical_depth(start), 0.2, 1e-12);
  EXPECT_NEAR(vertical_optical_depth(start, start.at("mie"), {440, 0}),
              0.2 * std::pow(440 / 550.0, -1.4), 1e-12);
  EXPECT_EQ(problem.assumptions.front(), "prior: by a test");
}

// Not the words of a prior that nobody asked for.
TEST(MeasuredAir, AKnownAerosolThatTheModelDoesNotFitIsNamed) {
  refs::AerosolKnowledge known;
  known.single_scattering_albedo = Prior{0.95, 0.03};
  const FitOptions options = options_knowing(known);
  const auto model = make_sky_model("oneil", refs::standard_spectral_data(), 1);
  EXPECT_THAT([&] { fit_atmosphere(scans(), refs::standard_spectral_data(), *model, options); },
              ::testing::ThrowsMessage<std::invalid_argument>(HasSubstr(
                  "AERONET tells mie.single_scattering_albedo, which the oneil model does "
                  "not fit: expected --fix mie.single_scattering_albedo=VALUE")));
}

TEST(MeasuredAir, WhatIsFixedOfAKnownAerosolHasNoPrior) {
  refs::AerosolKnowledge known;
  known.optical_depth = Prior{0.2, 0.01};
  known.angstrom_exponent = Prior{1.4, 0.1};
  FitOptions options = options_knowing(known);
  options.fix[{"mie", Quantity::kAngstromExponent}] = 1;
  const Problem problem = problem_of(scans(), options);
  EXPECT_EQ(unknown(problem, "mie.angstrom_exponent"), nullptr);
  EXPECT_NE(unknown(problem, "mie.optical_depth"), nullptr);
  EXPECT_EQ(problem.start.atmosphere.front().at("mie").angstrom_exponent, 1);
}

}  // namespace
}  // namespace skyfit::fit
