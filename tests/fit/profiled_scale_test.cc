// SPDX-License-Identifier: Apache-2.0
// The luminance scale of a scan is profiled out exactly.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fit/fit.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

double scale_of(const Result& result, std::size_t scan) {
  return result.scans[scan].instrument[static_cast<std::size_t>(Instrument::kScale)];
}

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
  const Result before = fit(reference), after = fit(scaled);
  constexpr double kRounding = 1e-6;  // of log(7 value), through a solver that stops at 1e-7
  EXPECT_NEAR(after.errors.rms_log, before.errors.rms_log, kRounding);
  for (std::size_t i = 0; i < before.unknowns.size(); ++i) {
    EXPECT_NEAR(after.unknowns[i].fitted / before.unknowns[i].fitted, 1, kRounding);
  }
  for (std::size_t scan = 0; scan < before.scans.size(); ++scan) {
    const double factor = scan == 2 ? 7 : 1;
    EXPECT_NEAR(scale_of(after, scan) / scale_of(before, scan), factor, factor * kRounding);
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
  options.link = Link::kLog;
  options.scale = Scale::kProfiled;
  options.pointing = Pointing::kStated;
  options.start = Preset{"truth", true_atmosphere(1), {}};
  options.start->atmosphere.at("mie").phase.g = 0.5;
  const Result result =
      fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
  for (std::size_t i = 0; i < reference.samples.size(); ++i)
    EXPECT_NEAR(result.model[i] / reference.samples[i].value, 1, 1e-4);
  for (std::size_t scan = 0; scan < result.scans.size(); ++scan)
    EXPECT_NEAR(scale_of(result, scan), 0.5, 1e-5);
}

}  // namespace
}  // namespace skyfit::fit
