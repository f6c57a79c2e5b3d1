// SPDX-License-Identifier: Apache-2.0
// Independent residuals count fully; residuals that agree with their neighbours count as few.
#include "fit/uncertainty/noise.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

Observations observations() { return observe(synthetic_reference(true_atmosphere(1), 0), 0); }

TEST(NoiseTest, WhiteNoiseCountsFully) {
  const Observations observed = observations();
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 0.03);
  Eigen::VectorXd residual(observed.count());
  for (double& value : residual) value = normal(generator);
  const Noise noise = estimate_noise(observed, residual, 5);
  // 132 samples: the neighbours' correlation is known to 1 / sqrt(132) = 0.09, the count to 0.2.
  EXPECT_NEAR(noise.effective_samples / observed.count(), 1, 0.25);
  EXPECT_NEAR(noise.sigma_log, 0.03, 0.006);
}

TEST(NoiseTest, SmoothMisfitCountsAsFewSamples) {
  const Observations observed = observations();
  Eigen::VectorXd residual(observed.count());
  for (int i = 0; i < observed.count(); ++i) {
    residual(i) = 0.03 * std::sqrt(2.0) * std::sin(3 * observed.points[i].view_zenith);
  }
  const Noise noise = estimate_noise(observed, residual, 5);
  EXPECT_LT(noise.effective_samples, 0.15 * observed.count());
  EXPECT_GT(noise.effective_samples, observed.scans);
  EXPECT_GT(noise.sigma_log, 2 * 0.03);
}

TEST(NoiseTest, VanishingResidualsStopAtTheFloor) {
  const Observations observed = observations();
  const Noise noise = estimate_noise(observed, Eigen::VectorXd::Zero(observed.count()), 5);
  EXPECT_EQ(noise.sigma_log, kSmallestSigmaLog);
  EXPECT_NEAR(noise.effective_samples, observed.count(), 1e-9);
}

}  // namespace
}  // namespace skyfit::fit
