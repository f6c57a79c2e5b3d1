// SPDX-License-Identifier: Apache-2.0
// The Jacobian of the profiled, whitened logarithmic residuals equals central differences.
#include <gtest/gtest.h>

#include "fit/problem/free_parameters.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// Central differences with a step of 1e-5 of the value: truncation 1e-10, rounding 1e-11, relative
// to residuals of order 1 that are differentiated by parameters of any size.
constexpr double kDifference = 1e-6;

class JacobianTest : public testing::TestWithParam<int> {};

TEST_P(JacobianTest, EqualsCentralDifferences) {
  const int lobes = GetParam();
  const ToySky model;
  const LuminanceRule rule = luminance_rule(refs::standard_spectral_data());
  refs::Reference reference = synthetic_reference(true_atmosphere(lobes), 0.1);
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    reference.samples[i].weight = 1 + 0.1 * static_cast<double>(i % 7);
    reference.samples[i].sigma =
        reference.samples[i].value * (0.02 + 0.01 * static_cast<double>(i % 3));
  }
  const Observations observations = observe(reference, 3 * kDegree);
  const Atmosphere<double> centre = true_atmosphere(lobes);
  for (const Parameter& id : standard_parameters()) {
    if (!has_parameter(centre, id)) continue;
    const std::vector<Parameter> one = {id};
    const auto residuals_at = [&](double value, const std::vector<Parameter>& wanted) {
      Atmosphere<double> atmosphere = centre;
      set_parameter(atmosphere, id, value);
      return log_residuals(observations,
                           model_luminance(model, rule, atmosphere, observations.points, wanted));
    };
    const double value = get_parameter(centre, id), step = 1e-5 * value;
    const Eigen::VectorXd difference =
        (residuals_at(value + step, {}).residual - residuals_at(value - step, {}).residual) /
        (2 * step);
    const Eigen::VectorXd exact = residuals_at(value, one).jacobian.col(0);
    const double size = std::max(1e-3 / value, exact.cwiseAbs().maxCoeff());
    EXPECT_LT((exact - difference).cwiseAbs().maxCoeff(), kDifference * size) << id.name();
  }
}

INSTANTIATE_TEST_SUITE_P(Lobes, JacobianTest, testing::Values(1, 2));

TEST(FreeParameterTest, ScalingIsUndoneByItsInverseAndDifferentiated) {
  const FreeParameter logarithmic{{1e-7, 2e-3, true, std::nullopt}, Parameter::kMieScattering};
  const FreeParameter linear{{-0.6, 0.98, false, std::nullopt}, Parameter::kMiePhaseG};
  for (const FreeParameter& parameter : {logarithmic, linear}) {
    for (const double scaled : {0.01, 0.3, 0.99}) {
      EXPECT_NEAR(parameter.scaled(parameter.value(scaled)), scaled, 1e-14);
      const double step = 1e-6;
      const double difference =
          (parameter.value(scaled + step) - parameter.value(scaled - step)) / (2 * step);
      EXPECT_NEAR(parameter.value_per_scaled(scaled) / difference, 1, 1e-8);
    }
    EXPECT_EQ(parameter.value(0), parameter.lower);
    EXPECT_EQ(parameter.value(1), parameter.upper);
  }
}

}  // namespace
}  // namespace skyfit::fit
