// SPDX-License-Identifier: Apache-2.0
// Every wrong option or reference is one line that names option, value and constraint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "fit/fit.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string message(const std::function<void(FitOptions&, refs::Reference&)>& spoil) {
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  refs::Reference reference = synthetic_reference(true_atmosphere(1), 0.02);
  spoil(options, reference);
  try {
    fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(OptionsTest, ValidOptionsAreAccepted) {
  EXPECT_EQ(message([](FitOptions&, refs::Reference&) {}), "no error");
}

TEST(OptionsTest, CountsAreChecked) {
  EXPECT_EQ(message([](FitOptions& o, refs::Reference&) { o.starts = 0; }),
            "fit.starts = 0: must be >= 1");
  EXPECT_EQ(message([](FitOptions& o, refs::Reference&) { o.max_iterations = -1; }),
            "fit.max_iterations = -1: must be >= 1");
  EXPECT_EQ(message([](FitOptions& o, refs::Reference&) { o.lobes = 3; }),
            "fit.lobes = 3: must be 1 or 2");
  EXPECT_EQ(message([](FitOptions& o, refs::Reference&) { o.threads = 0; }),
            "fit.threads = 0: must be >= 1");
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) { o.exclude_sun = -0.1; }),
              AllOf(HasSubstr("fit.exclude_sun_deg = -5.7"), HasSubstr("must be >= 0")));
}

TEST(OptionsTest, ParametersThatTheAtmosphereLacksAreRefused) {
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.free = std::vector<Parameter>{Parameter::kMiePhaseG1};
              }),
              AllOf(StartsWith("fit.free: mie.phase.g1: the atmosphere has no such parameter, "
                               "expected one of rayleigh.scattering, "),
                    HasSubstr(" mie.phase.g, ")));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.lobes = 2;
                o.fix[Parameter::kMiePhaseG] = 0.5;
              }),
              AllOf(StartsWith("fit.fix: mie.phase.g: the atmosphere has no such parameter, "),
                    HasSubstr(" mie.phase.g1, ")));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.priors[Parameter::kMiePhaseG2] = {0.2, 0.1};
              }),
              HasSubstr("fit.prior: mie.phase.g2"));
}

TEST(OptionsTest, ContradictionsAreRefused) {
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.free = std::vector<Parameter>{Parameter::kMiePhaseG};
                o.fix[Parameter::kMiePhaseG] = 0.5;
              }),
              HasSubstr("fit.free: mie.phase.g: also fixed"));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.priors[Parameter::kOzoneColumn] = {300, 30};
              }),
              HasSubstr("fit.prior: ozone.column: must be free"));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                for (const Parameter& id : standard_parameters()) {
                  if (has_parameter(true_atmosphere(1), id))
                    o.fix[id] = get_parameter(true_atmosphere(1), id);
                }
              }),
              HasSubstr("fit.free: nothing is free"));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) { o.scale = Scale::kFixed; }),
              HasSubstr("fit.scale = fixed: must be profiled for a relative luminance"));
}

TEST(OptionsTest, BoundsAreThoseOfFreeParametersAndHoldTheFit) {
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.bounds[Parameter::kOzoneColumn] = {200, 400};
              }),
              HasSubstr("fit.bounds: ozone.column: must be free to have bounds"));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.bounds[Parameter::kGroundAlbedo] = {0.3, 0.3};
              }),
              HasSubstr("fit.bounds: ground.albedo = 0.3:0.3: must be finite, the lower below"));
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  options.bounds[Parameter::kMiePhaseG] = {0.65, 0.8};  // the truth is 0.6
  const Result result = fit_atmosphere(synthetic_reference(true_atmosphere(1), 0.02),
                                       refs::standard_spectral_data(), ToySky(), options);
  EXPECT_NEAR(result.unknown("mie.phase.g").fitted, 0.65, 1e-6);
  EXPECT_TRUE(result.unknown("mie.phase.g").at_bound);
}

TEST(OptionsTest, ValuesAreChecked) {
  EXPECT_THAT(
      message([](FitOptions& o, refs::Reference&) { o.fix[Parameter::kMieScattering] = -1; }),
      AllOf(HasSubstr("fit.fix: "), HasSubstr("-1"), Not(HasSubstr("\n"))));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.priors[Parameter::kMiePhaseG] = {0.5, 0};
              }),
              HasSubstr("fit.prior: mie.phase.g = 0.5:0: must be a finite mean and a sigma > 0"));
  EXPECT_THAT(message([](FitOptions& o, refs::Reference&) {
                o.start = Preset{"thick", true_atmosphere(1), {}};
                o.start->atmosphere.at("mie").amount = 0.1;
              }),
              AllOf(HasSubstr("fit.start: mie.scattering = 0.1 1/m"), HasSubstr("1e-07 .. 0.002")));
}

// Bounds and priors of the Earth are not those of other planets.
TEST(OptionsTest, AnotherPlanetStartsWhereItIs) {
  Atmosphere<double> mars = true_atmosphere(1);
  mars.at("rayleigh").amount = 2.55e-7;
  mars.at("rayleigh").profile.scale_height_m = 10800;
  const ParameterInfo air = parameter_info(Parameter::kRayleighScattering, mars),
                      height = parameter_info(Parameter::kRayleighScaleHeight, mars);
  EXPECT_EQ(air.lower, 0.5 * 2.55e-7);
  EXPECT_EQ(air.upper, 2 * 2.55e-7);
  EXPECT_NEAR(air.prior->sigma, 0.05 * 2.55e-7, 1e-12);
  EXPECT_EQ(height.prior->mean, 10800);
  EXPECT_EQ(parameter_info(Parameter::kMieScattering, mars).upper, 2e-3);
  EXPECT_EQ(message([&](FitOptions& o, refs::Reference&) {
              o.start = Preset{"mars", mars, {}};
              o.max_iterations = 1;
            }),
            "no error");
}

TEST(OptionsTest, ReferencesThatCannotBeFittedAreRefused) {
  EXPECT_THAT(message([](FitOptions&, refs::Reference& r) { r.samples.clear(); }),
              HasSubstr("synthetic: no sample"));
  EXPECT_THAT(message([](FitOptions&, refs::Reference& r) { r.samples.resize(7); }),
              AllOf(HasSubstr("synthetic: 7 samples for"), HasSubstr("1 profiled scales")));
  EXPECT_THAT(message([](FitOptions&, refs::Reference& r) { r.samples[4].value = 0; }),
              HasSubstr("synthetic: sample 5: value = 0: must be"));
  EXPECT_THAT(message([](FitOptions&, refs::Reference& r) {
                r.samples[7].weight = std::numeric_limits<double>::quiet_NaN();
              }),
              HasSubstr("sample 8: weight"));
  EXPECT_THAT(message([](FitOptions&, refs::Reference& r) { r.samples[3].sigma = 0.1; }),
              HasSubstr("must be all or none"));
}

// A coefficient stated at another wavelength is moved to 550 nm before its bounds are asked.
TEST(OptionsTest, StartAtAnotherWavelengthIsTheSameAtmosphere) {
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  const refs::Reference reference = synthetic_reference(true_atmosphere(1), 0.02);
  options.start = Preset{"at 550", true_atmosphere(1), {}};
  const Result at_550 =
      fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  Constituent<double>& air = options.start->atmosphere.at("rayleigh");
  air.amount *= std::pow(440.0 / 550, -air.angstrom_exponent);
  air.wavelength_nm = 440;
  const Result at_440 =
      fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  EXPECT_NEAR(at_440.preset.atmosphere.at("rayleigh").amount /
                  at_550.preset.atmosphere.at("rayleigh").amount,
              1, 1e-9);
}

// A preset's one lobe stays where no parameter of two is free; its asymmetry may be named. Where
// they are free two are fitted, and the report says so.
TEST(OptionsTest, OneLobeOfAPresetStaysUnlessTwoAreFitted) {
  const refs::Reference reference = synthetic_reference(true_atmosphere(1), 0.02);
  const auto result = [&](std::vector<Parameter> free, std::map<Parameter, double> fix) {
    FitOptions options;
    options.starts = 1;
    options.start = Preset{"one lobe", true_atmosphere(1), {}};
    options.free = std::move(free);
    options.fix = std::move(fix);
    return fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  };
  const Result amount = result({Parameter::kMieScattering}, {});
  EXPECT_EQ(amount.preset.atmosphere.at("mie").phase.type, PhaseType::kCornetteShanks);
  EXPECT_EQ(amount.preset.atmosphere.at("mie").phase.g, 0.6);
  const Result named = result({Parameter::kMieScattering}, {{Parameter::kMiePhaseG, 0.5}});
  EXPECT_EQ(named.preset.atmosphere.at("mie").phase.g, 0.5);
  const Result two = result({Parameter::kMieScattering, Parameter::kMiePhaseG1}, {});
  EXPECT_EQ(two.preset.atmosphere.at("mie").phase.type, PhaseType::kTwoLobe);
  EXPECT_THAT(two.reference.notes, testing::Contains(HasSubstr("two lobes in place of the one")));
}

}  // namespace
}  // namespace skyfit::fit
