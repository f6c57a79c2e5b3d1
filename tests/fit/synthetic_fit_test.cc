// SPDX-License-Identifier: Apache-2.0
// A fit of a sky that the model itself made returns the parameters that made it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/fit.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

const UnknownRow& row_of(const Result& result, Parameter id) { return result.unknown(id.name()); }

Result fit_toy(const refs::Reference& reference, const FitOptions& options) {
  return fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
}

// The toy cannot tell scale heights from coefficients: they are fixed at the truth.
FitOptions determined(int lobes) {
  FitOptions options;
  options.lobes = lobes;
  options.use_priors = false;
  options.fix = {{Parameter::kRayleighScaleHeight, 8000}, {Parameter::kMieScaleHeight, 1200}};
  return options;
}

class SyntheticFitTest : public testing::TestWithParam<int> {};

// Without noise and priors the residuals vanish and the parameters are the true ones.
TEST_P(SyntheticFitTest, NoiseFreeSkyReturnsItsParameters) {
  const Atmosphere<double> truth = true_atmosphere(GetParam());
  const Result result = fit_toy(synthetic_reference(truth, 0), determined(GetParam()));
  constexpr double kSolverTolerance = 1e-3;  // percent; function_tolerance 1e-7 of a cost near 0
  EXPECT_LT(result.errors.rms_log, kSolverTolerance);
  EXPECT_TRUE(result.converged);
  for (const UnknownRow& row : result.unknowns) {
    const double expected = get_parameter(truth, std::get<Parameter>(row.unknown.what));
    EXPECT_NEAR(row.fitted / expected, 1, 1e-2) << row.unknown.name();
  }
}

// With 2 % noise: the residuals are the noise, and every parameter lies within three sigma.
TEST_P(SyntheticFitTest, NoisySkyReturnsItsParametersWithinThreeSigma) {
  const Atmosphere<double> truth = true_atmosphere(GetParam());
  FitOptions options = determined(GetParam());
  options.fix[Parameter::kMieSingleScatteringAlbedo] =
      0.93;  // else at its bound, and the sigmas conditional
  const Result result = fit_toy(synthetic_reference(truth, 0.02), options);
  // 128 samples less 11 unknowns: 2 sqrt(117 / 128) = 1.91, known to 6 %.
  EXPECT_NEAR(result.errors.rms_log, 1.91, 3 * 0.12);
  EXPECT_NEAR(result.sigma_percent, 2, 0.6);
  for (const UnknownRow& row : result.unknowns) {
    if (row.at_bound) continue;
    EXPECT_GT(row.sigma, 0) << row.unknown.name();
    EXPECT_NEAR(row.fitted, get_parameter(truth, std::get<Parameter>(row.unknown.what)),
                3 * row.sigma)
        << row.unknown.name();
  }
}

// All defaults: priors hold what the toy cannot say, and what it can is still found.
TEST_P(SyntheticFitTest, DefaultPriorsHoldWhatTheSkyCannotSay) {
  const Atmosphere<double> truth = true_atmosphere(GetParam());
  FitOptions options;
  options.lobes = GetParam();
  const Result result = fit_toy(synthetic_reference(truth, 0.01), options);
  EXPECT_LT(result.errors.rms_log, 1.1);
  EXPECT_FALSE(row_of(result, Parameter::kMieScaleHeight).identifiable);
  EXPECT_NEAR(row_of(result, Parameter::kMieScaleHeight).sigma, 500, 50);
  EXPECT_TRUE(row_of(result, GetParam() == 2 ? Parameter::kMiePhaseG1 : Parameter::kMiePhaseG)
                  .identifiable);
  for (const UnknownRow& row : result.unknowns) {
    if (row.at_bound) continue;
    EXPECT_NEAR(row.fitted, get_parameter(truth, std::get<Parameter>(row.unknown.what)),
                3 * row.sigma)
        << row.unknown.name();
  }
}

INSTANTIATE_TEST_SUITE_P(Lobes, SyntheticFitTest, testing::Values(1, 2));

// A start with the labels exchanged ends with g1 > g2 and the weight of g1.
TEST(LabelTest, ForwardLobeIsTheFirst) {
  const Atmosphere<double> truth = true_atmosphere(2);
  FitOptions options = determined(2);
  options.starts = 1;
  options.start = Preset{"exchanged", truth, {}};
  PhaseFunction<double>& phase = options.start->atmosphere.at("mie").phase;
  std::swap(phase.g1, phase.g2);
  phase.weight = 1 - phase.weight;
  const Result result = fit_toy(synthetic_reference(truth, 0), options);
  EXPECT_NEAR(row_of(result, Parameter::kMiePhaseG1).fitted, 0.75, 1e-3);
  EXPECT_NEAR(row_of(result, Parameter::kMiePhaseG2).fitted, 0.3, 1e-3);
  EXPECT_NEAR(row_of(result, Parameter::kMiePhaseWeight).fitted, 0.4, 1e-3);
  EXPECT_EQ(row_of(result, Parameter::kMiePhaseG1).start, 0.3);
}

// An albedo below 0 would fit best: the fit stops at the bound, says so, and gives it no sigma.
TEST(BoundTest, FitStopsAtTheBound) {
  const Atmosphere<double> truth = true_atmosphere(1);
  refs::Reference reference = synthetic_reference(truth, 0);
  Atmosphere<double> without_ground = truth;
  without_ground.ground_albedo = 0;
  const refs::Reference dark = synthetic_reference(without_ground, 0);
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    reference.samples[i].value = 1.5 * dark.samples[i].value - 0.5 * reference.samples[i].value;
  }
  FitOptions options = determined(1);
  options.free = std::vector<Parameter>{Parameter::kGroundAlbedo, Parameter::kMiePhaseG};
  options.fix[Parameter::kMieScattering] = 1.2e-4;
  options.fix[Parameter::kRayleighScattering] = 1.25e-5;
  const Result result = fit_toy(reference, options);
  const UnknownRow& albedo = row_of(result, Parameter::kGroundAlbedo);
  EXPECT_EQ(albedo.fitted, 0);
  EXPECT_TRUE(albedo.at_bound);
  EXPECT_TRUE(std::isnan(albedo.sigma));
  ASSERT_EQ(result.covariance_unknowns.size(), 1u);
  EXPECT_EQ(result.unknowns[static_cast<std::size_t>(result.covariance_unknowns[0])].unknown.name(),
            "mie.phase.g");
  EXPECT_GT(row_of(result, Parameter::kMiePhaseG).sigma, 0);
}

// Derivatives are evaluated at most once per iteration and nothing is evaluated twice at one point.
TEST(EconomyTest, ModelIsPreparedOncePerStep) {
  const ToySky model;
  FitOptions options = determined(2);
  const Result result = fit_atmosphere(synthetic_reference(true_atmosphere(2), 0.02),
                                       refs::standard_spectral_data(), model, options);
  EXPECT_EQ(model.value_calls, result.model_evaluations);
  EXPECT_EQ(model.derivative_calls, result.derivative_evaluations);
  const int solves = static_cast<int>(result.starts.size()) + 4;
  EXPECT_LE(model.derivative_calls, result.iterations + 2 * solves);
}

// The result does not depend on how many starts are solved at once.
TEST(ThreadTest, ResultDoesNotDependOnThreads) {
  const refs::Reference reference = synthetic_reference(true_atmosphere(2), 0.02);
  FitOptions options = determined(2);
  options.threads = 1;
  const Result one = fit_toy(reference, options);
  options.threads = 3;
  const Result three = fit_toy(reference, options);
  for (std::size_t i = 0; i < one.unknowns.size(); ++i) {
    EXPECT_EQ(one.unknowns[i].fitted, three.unknowns[i].fitted);
  }
}

}  // namespace
}  // namespace skyfit::fit
