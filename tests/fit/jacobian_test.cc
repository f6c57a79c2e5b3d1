// SPDX-License-Identifier: Apache-2.0
// The Jacobian of whitened residuals equals central differences under every link and scale; an
// unknown scale is the one of scan_derivatives_test.
#include <gtest/gtest.h>

#include "fit/problem/free_parameters.h"
#include "fit/problem/likelihood.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// Central differences with a step of 1e-5 of the value: truncation 1e-10, rounding 1e-11, relative
// to residuals of order 1 that are differentiated by parameters of any size.
constexpr double kDifference = 1e-6;

using Setting = std::tuple<int, Link, Scale>;  // lobes
class JacobianTest : public testing::TestWithParam<Setting> {};

TEST_P(JacobianTest, EqualsCentralDifferences) {
  const auto [lobes, link, scale] = GetParam();
  const ToySky model;
  const Likelihood likelihood{link, scale, {}, true, Loss::kNone, 3};
  refs::Reference reference = synthetic_reference(true_atmosphere(lobes), 0.1);
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    reference.samples[i].weight = 1 + 0.1 * static_cast<double>(i % 7);
    reference.samples[i].sigma =
        reference.samples[i].value * (0.02 + 0.01 * static_cast<double>(i % 3));
  }
  const Dataset data =
      dataset(reference, refs::standard_spectral_data(), {false, 3 * kDegree, {}, 0});
  const Atmosphere<double> centre = true_atmosphere(lobes);
  for (const Parameter& id : standard_parameters()) {
    if (!has_parameter(centre, id)) continue;
    const auto white_at = [&](double value, const std::vector<Unknown>& unknowns) {
      Atmosphere<double> atmosphere = centre;
      set_parameter(atmosphere, id, value);
      return whiten(data, likelihood, sky_values(model, data, start_state(atmosphere, 4), unknowns),
                    2);
    };
    const double value = get_parameter(centre, id), step = 1e-5 * value;
    const Eigen::VectorXd difference =
        (white_at(value + step, {}).residual - white_at(value - step, {}).residual) / (2 * step);
    const Eigen::VectorXd exact =
        white_at(value, {{free_parameter(id, parameter_info(id), {}), id, kAllScans}})
            .jacobian_per_unit.col(0);
    const double size = std::max(1e-3 / value, exact.cwiseAbs().maxCoeff());
    EXPECT_LT((exact - difference).cwiseAbs().maxCoeff(), kDifference * size) << id.name();
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, JacobianTest,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(Link::kLog, Link::kLinear),
                                          testing::Values(Scale::kFixed, Scale::kProfiled)));

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
