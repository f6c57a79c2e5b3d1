// SPDX-License-Identifier: Apache-2.0
// The mean density of a vertical path: its integral, and what `nielsen` takes for it.
#include <gtest/gtest.h>

#include <cmath>

#include "render/plot/mean_density.h"

namespace skyfit::plot {
namespace {

// With H: over a path of x H the integral is (1 - exp(-x)) / x of the density below, the mean of
// the ends (1 + exp(-x)) / 2, the density at the mean height exp(-x / 2); the second is the
// largest, the third the least and, as the source says, the nearer: to second order x^2 / 12 above
// against x^2 / 24 below.
TEST(MeanDensity, OfAnExponential) {
  constexpr double kScale = 5e3, kGround = 1500;
  const double below = std::exp(-kGround / kScale);
  for (const double x : {-0.1, 0.0, 0.02, 1.0, 5.7}) {
    const MeanDensity mean = mean_density(kGround, kGround + x * kScale, kScale);
    EXPECT_NEAR(mean.of_ends / below, 0.5 * (1 + std::exp(-x)), 1e-12) << x;
    EXPECT_NEAR(mean.at_mean_height / below, std::exp(-0.5 * x), 1e-12) << x;
    EXPECT_NEAR(mean.exact / below, x == 0 ? 1 : (1 - std::exp(-x)) / x, 1e-12) << x;
    if (x == 0) continue;
    EXPECT_GT(mean.of_ends, mean.exact) << x;
    EXPECT_LT(mean.at_mean_height, mean.exact) << x;
    EXPECT_LT(mean.exact - mean.at_mean_height, mean.of_ends - mean.exact) << x;
  }
  const MeanDensity thin = mean_density(0, 0.01 * kScale, kScale);
  EXPECT_NEAR((thin.of_ends - thin.exact) / (thin.exact - thin.at_mean_height), 2, 1e-3);
}

TEST(MeanDensity, FigureHasACurveForEach) {
  const std::string body = mean_density_figure().body;
  for (const char* curve :
       {"\"integral\"", "\"mean of the densities\"", "\"density at the mean height\"",
        "air: scale height 15 km", "aerosol: scale height 5 km"})
    EXPECT_NE(body.find(curve), std::string::npos) << curve;
}

}  // namespace
}  // namespace skyfit::plot
