// SPDX-License-Identifier: Apache-2.0
// The luminance scale of a scan is profiled out exactly.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fit/fit.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// Multiplying a scan by 7 changes its scale by 7 and nothing else.
TEST(ProfiledScaleTest, FactorOnAScanChangesNothingButItsScale) {
  const refs::Reference reference = synthetic_reference(true_atmosphere(1), 0.02);
  refs::Reference scaled = reference;
  for (refs::Sample& sample : scaled.samples) {
    if (sample.scan == 2) sample.value *= 7;
  }
  FitOptions options;
  options.lobes = 1;
  const auto fit = [&](const refs::Reference& which) {
    return fit_atmosphere(which, refs::standard_spectral_data(), ToySky(), options);
  };
  const FitResult before = fit(reference), after = fit(scaled);
  constexpr double kRounding = 1e-6;  // of log(7 value), through a solver that stops at 1e-7
  EXPECT_NEAR(after.rms_log_percent, before.rms_log_percent, kRounding);
  for (std::size_t i = 0; i < before.parameters.size(); ++i) {
    EXPECT_NEAR(after.parameters[i].fitted / before.parameters[i].fitted, 1, kRounding);
  }
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    const double factor = reference.samples[i].scan == 2 ? 7 : 1;
    EXPECT_NEAR(after.scale[i] / before.scale[i], factor, factor * kRounding);
  }
}

// Profiling equals a least-squares solution with the log scales as explicit unknowns.
TEST(ProfiledScaleTest, EqualsExplicitScales) {
  const std::vector<int> scan = {0, 1, 0, 1, 1};
  const Eigen::VectorXd weight = Eigen::VectorXd::LinSpaced(5, 0.5, 2.5);
  Eigen::MatrixXd columns(5, 1);
  columns << 1, 4, -2, 0.5, 3;
  Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(5, 2);
  for (int i = 0; i < 5; ++i) indicator(i, scan[i]) = 1;
  const Eigen::MatrixXd weighted = weight.asDiagonal() * indicator;
  const Eigen::VectorXd explicit_means =
      (indicator.transpose() * weighted).ldlt().solve(weighted.transpose() * columns.col(0));
  const Eigen::VectorXd expected = columns.col(0) - indicator * explicit_means;
  const Eigen::MatrixXd means = subtract_scan_means(scan, 2, weight, columns);
  EXPECT_LT((means.col(0) - explicit_means).norm(), 1e-14);
  EXPECT_LT((columns.col(0) - expected).norm(), 1e-14);
}

// An absolute reference made by the model has scales of 1; halved, of 0.5 (reference / model).
TEST(ProfiledScaleTest, ScaleIsReferenceOverModel) {
  refs::Reference reference = synthetic_reference(true_atmosphere(1), 0);
  reference.quantity = refs::Quantity::kLuminance;
  for (refs::Sample& sample : reference.samples) sample.value *= 0.5;
  FitOptions options;
  options.lobes = 1;
  options.use_priors = false;
  options.free = std::vector<Parameter>{Parameter::kMiePhaseG};
  options.start = Preset{"truth", true_atmosphere(1), {}};
  options.start->atmosphere.at("mie").phase.g = 0.5;
  const FitResult result =
      fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    EXPECT_NEAR(result.scale[i], 0.5, 1e-5);
    EXPECT_NEAR(result.scale[i] * result.fitted_model[i] / reference.samples[i].value, 1, 1e-4);
  }
  for (const RmsOfSun& sun : result.per_sun) EXPECT_NEAR(sun.scale, 0.5, 1e-5);
}

}  // namespace
}  // namespace skyfit::fit
