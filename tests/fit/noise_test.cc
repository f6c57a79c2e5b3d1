// SPDX-License-Identifier: Apache-2.0
// Independent residuals count fully; residuals that agree with their neighbours count as few.
#include "fit/uncertainty/noise.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

Dataset data() {
  return dataset(synthetic_reference(true_atmosphere(1), 0), refs::standard_spectral_data(), {});
}

// Of logarithms: sigma of a sample, as the factor says it.
constexpr Likelihood kLog{Link::kLog, Scale::kProfiled, {}, false, Loss::kNone, 3};
double sigma_log(const Noise& noise) { return noise.factor * kLog.noise.relative; }

Eigen::VectorXd whitened(const Eigen::VectorXd& residual) { return residual / kLog.noise.relative; }

TEST(NoiseTest, WhiteNoiseCountsFully) {
  const Dataset observed = data();
  const auto count = static_cast<Eigen::Index>(observed.samples.size());
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 0.03);
  Eigen::VectorXd residual(count);
  for (double& value : residual) value = normal(generator);
  const Noise noise =
      estimate_noise(observed, kLog, whitened(residual), Eigen::VectorXd::Ones(residual.size()), 9);
  // 132 samples: the neighbours' correlation is known to 1 / sqrt(132) = 0.09, the count to 0.2.
  EXPECT_NEAR(noise.effective_samples / static_cast<double>(count), 1, 0.25);
  EXPECT_NEAR(sigma_log(noise), 0.03, 0.006);
}

TEST(NoiseTest, SmoothMisfitCountsAsFewSamples) {
  const Dataset observed = data();
  const auto count = static_cast<Eigen::Index>(observed.samples.size());
  Eigen::VectorXd residual(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    residual(i) =
        0.03 * std::sqrt(2.0) *
        std::sin(3 * observed.lines_of_sight[static_cast<std::size_t>(i)].stated.view_zenith);
  }
  const Noise noise =
      estimate_noise(observed, kLog, whitened(residual), Eigen::VectorXd::Ones(residual.size()), 9);
  EXPECT_LT(noise.effective_samples, 0.15 * static_cast<double>(count));
  EXPECT_GT(noise.effective_samples, observed.scans.size());
  EXPECT_GT(sigma_log(noise), 2 * 0.03);
}

TEST(NoiseTest, VanishingResidualsStopAtTheFloor) {
  const Dataset observed = data();
  const auto count = static_cast<Eigen::Index>(observed.samples.size());
  const Noise noise =
      estimate_noise(observed, kLog, Eigen::VectorXd::Zero(count), Eigen::VectorXd::Ones(count), 9);
  EXPECT_DOUBLE_EQ(sigma_log(noise), kSmallestSigma);
  EXPECT_NEAR(noise.effective_samples, static_cast<double>(count), 1e-9);
}

// Outliers to which a loss leaves nothing are as if they were not there.
TEST(NoiseTest, SamplesWithoutWeightDoNotCount) {
  const Dataset observed = data();
  const auto count = static_cast<Eigen::Index>(observed.samples.size());
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 0.03);
  Eigen::VectorXd residual(count), weights = Eigen::VectorXd::Ones(count);
  for (double& value : residual) value = normal(generator);
  double squares = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (i % 10 == 0) {
      residual(i) = 5;
      weights(i) = 0;
    }
    squares += weights(i) * residual(i) * residual(i);
  }
  const Noise noise = estimate_noise(observed, kLog, whitened(residual), weights, 9);
  EXPECT_NEAR(noise.independent_factor * kLog.noise.relative,
              std::sqrt(squares / (weights.sum() - 9)), 1e-12);
}

}  // namespace
}  // namespace skyfit::fit
