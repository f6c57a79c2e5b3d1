// SPDX-License-Identifier: Apache-2.0
// A fit of irradiances: their values are those of the model, their derivatives are exact, and what
// made them is found again.
#include <gmock/gmock.h>

#include <cmath>

#include "data_refs/gas_absorption.h"
#include "data_refs/irradiance.h"
#include "fit/fit.h"
#include "fit/problem/free_parameters.h"
#include "fit/problem/problem.h"
#include "model/photometry/broadband.h"
#include "model/registry.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRounding = 1e-12;
// Central differences with a step of 1e-4 of the value: truncation 1e-8, rounding 1e-11.
constexpr double kDifference = 1e-6;

refs::Reference reference_of(std::string_view text) {
  return refs::irradiance_reference(text, 40 * kDegree, {});
}

Eigen::VectorXd values_of(const refs::Reference& reference, const Atmosphere<double>& atmosphere) {
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {});
  return sky_values(ToySky(), data, start_state(atmosphere, 1), {}).value;
}

const Parameter kOpticalDepth("mie", Quantity::kOpticalDepth);

std::unique_ptr<SkyModel> scalar_reference() {
  return make_sky_model("reference", refs::standard_spectral_data(), 2, Transfer::kScalar);
}

const char* const kLux = "direct=80000lx,direct_horizontal=60000lx,diffuse=15000lx,global=75000lx";
const char* const kWatts =
    "direct=800W/m2,direct_horizontal=600W/m2,diffuse=100W/m2,global=700W/m2,"
    "precipitable_water=14mm";

TEST(IrradianceFit, ThatCannotBeUsedSaysWhy) {
  refs::Reference reference = reference_of(kLux);
  for (refs::Sample& sample : reference.samples) {
    sample.weight = 0;
    sample.zero_weight_reason = "not positive";
  }
  EXPECT_THAT([&] { fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), {}); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("none of its 4 samples can be used, the first is \"not positive\"")));
}

TEST(IrradianceFit, ValuesAreTheWeightedSumsOfTheModelsIrradiances) {
  const SpectralData& spectra = refs::standard_spectral_data();
  const Atmosphere<double> atmosphere = true_atmosphere(2);
  for (const char* const text : {kLux, kWatts}) {
    const bool lux = text == kLux;
    const LuminanceRule luminance = luminance_rule(spectra);
    const BroadbandRule broadband =
        broadband_rule(spectra, refs::standard_gas_absorption(), 40 * kDegree, 14);
    const auto& nodes = lux ? luminance.nodes : broadband.nodes;
    const auto& weight = lux ? luminance.weight : broadband.weight;
    const SkyValues light = ToySky().irradiance(atmosphere, nodes, 0, 40 * kDegree, {});
    const Eigen::VectorXd values = values_of(reference_of(text), atmosphere);
    ASSERT_EQ(values.size(), kIrradianceCount);
    for (int i = 0; i < kIrradianceCount; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        sum += weight[k] * light.at(i, static_cast<int>(k));
      EXPECT_NEAR(values(i) / sum, 1, kRounding) << text << " " << kIrradianceNames[i];
    }
    EXPECT_NEAR(values(kDirectHorizontal), values(kDirectNormal) * std::cos(40 * kDegree),
                kRounding * values(kDirectNormal));
    EXPECT_NEAR(values(kGlobalHorizontal), values(kDirectHorizontal) + values(kDiffuseHorizontal),
                kRounding * values(kGlobalHorizontal));
  }
}

TEST(IrradianceFit, DerivativesEqualCentralDifferences) {
  const refs::Reference reference = reference_of(kWatts);
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {});
  const Atmosphere<double> centre = true_atmosphere(2);
  for (const Parameter& id : {Parameter::kMieScattering, Parameter::kMieSingleScatteringAlbedo,
                              Parameter::kGroundAlbedo, Parameter::kOzoneColumn}) {
    const auto at = [&](double value) {
      Atmosphere<double> atmosphere = centre;
      set_parameter(atmosphere, id, value);
      return values_of(reference, atmosphere);
    };
    const double value = get_parameter(centre, id), step = 1e-4 * value;
    const Eigen::VectorXd difference = (at(value + step) - at(value - step)) / (2 * step);
    const Eigen::VectorXd exact =
        sky_values(ToySky(), data, start_state(centre, 1),
                   {{free_parameter(id, parameter_info(id), {}), id, kAllScans}})
            .derivative.col(0);
    EXPECT_LT((exact - difference).cwiseAbs().maxCoeff(),
              kDifference * exact.cwiseAbs().maxCoeff() + kRounding)
        << id.name();
  }
}

// The defaults: the logarithm, a known noise of 5 %, optical depth and single scattering albedo.
TEST(IrradianceFit, BeamAndSkyGiveBackOpticalDepthAndSingleScatteringAlbedo) {
  const auto model = scalar_reference();
  FitOptions options;
  options.use_priors = false;
  refs::Reference reference = reference_of("direct=80000lx,diffuse=15000lx");
  const Problem problem = make_problem(reference, refs::standard_spectral_data(), *model,
                                       without_sun_exclusion(options));
  ASSERT_EQ(problem.unknowns.size(), 2u);
  EXPECT_EQ(problem.unknowns[0].name(), "mie.optical_depth");
  EXPECT_EQ(problem.unknowns[1].name(), "mie.single_scattering_albedo");
  EXPECT_EQ(problem.likelihood.link, Link::kLog);
  EXPECT_EQ(problem.likelihood.scale, Scale::kFixed);
  EXPECT_TRUE(problem.likelihood.noise_is_known);
  SkyState truth = problem.start;
  set_parameter(truth.atmosphere[0], kOpticalDepth, 0.31);
  set_parameter(truth.atmosphere[0], Parameter::kMieSingleScatteringAlbedo, 0.88);
  const Eigen::VectorXd values = sky_values(*model, problem.fitted, truth, {}).value;
  for (std::size_t i = 0; i < 2; ++i)
    reference.samples[i].value = values(static_cast<Eigen::Index>(i));
  const Result result = fit_atmosphere(reference, refs::standard_spectral_data(), *model, options);
  constexpr double kSolver = 1e-4;  // of a fit without noise
  EXPECT_NEAR(result.unknown("mie.optical_depth").fitted, 0.31, kSolver);
  EXPECT_NEAR(result.unknown("mie.single_scattering_albedo").fitted, 0.88, kSolver);
  EXPECT_TRUE(result.unknown("mie.optical_depth").identifiable);
  EXPECT_LT(result.errors.luminance, 0.01);
  // A beam with 5 % of noise: one sigma of the optical depth is 5 % over the air mass; that of the
  // light's mean wavelength is within a tenth of that at 550 nm.
  const double sigma = 0.05 * std::cos(40 * kDegree);
  EXPECT_NEAR(result.unknown("mie.optical_depth").sigma / sigma, 1, 0.1);
}

// ASTM G173-03: direct and circumsolar light of air mass 1.5, optical depth 0.084 at 500 nm (rural
// aerosol), ozone 343.8 DU, precipitable water 14.16 mm: 900.1 W/m^2.
TEST(IrradianceFit, TheBeamOfTheStandardSpectrumComesOutWithinTwoPercent) {
  constexpr double kTable = 900.1, kRuralExponent = 1.14;
  const auto model = scalar_reference();
  FitOptions options;
  options.fix = {{Parameter::kOzoneColumn, 343.8},
                 {Parameter::kMieAngstromExponent, kRuralExponent}};
  const refs::Reference reference = refs::irradiance_reference(
      "direct=900.1W/m2,precipitable_water=14.16mm", std::acos(1 / 1.5), {});
  const Problem problem = make_problem(reference, refs::standard_spectral_data(), *model,
                                       without_sun_exclusion(options));
  SkyState state = problem.start;
  set_parameter(state.atmosphere[0], kOpticalDepth, 0.084 * std::pow(550.0 / 500, -kRuralExponent));
  const double beam = sky_values(*model, problem.fitted, state, {}).value(0);
  EXPECT_NEAR(beam / kTable, 1, 0.02);
}

TEST(IrradianceFit, TheBeamAloneTellsTheOpticalDepthAlone) {
  const ToySky model;
  const Problem problem =
      make_problem(reference_of("direct=80000lx,direct_horizontal=61000lx"),
                   refs::standard_spectral_data(), model, without_sun_exclusion({}));
  ASSERT_EQ(problem.unknowns.size(), 1u);
  EXPECT_EQ(problem.unknowns[0].name(), "mie.optical_depth");
}

TEST(IrradianceFit, IrradiancesHaveNoPointing) {
  FitOptions options;
  options.pointing = Pointing::kAzimuth;
  EXPECT_THAT(
      [&] {
        make_problem(reference_of("direct=80000lx"), refs::standard_spectral_data(), ToySky(),
                     options);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("fit.pointing = azimuth: must be stated")));
}

// Two values that no atmosphere has, with a known noise of 1 %: what is at a bound leaves a degree
// of freedom, and chi^2 says that they contradict each other.
TEST(IrradianceFit, ContradictingValuesShowInChiSquare) {
  const Result result = fit_atmosphere(reference_of("direct=80000:800lx,diffuse=30000:300lx"),
                                       refs::standard_spectral_data(), *scalar_reference(), {});
  EXPECT_TRUE(result.unknown("mie.single_scattering_albedo").at_bound);
  EXPECT_GT(result.chi_square_per_dof, 10);
}

}  // namespace
}  // namespace skyfit::fit
