// SPDX-License-Identifier: Apache-2.0
// Covariance, condition number and identifiability, against closed forms; singular cases included.
#include "fit/uncertainty/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "fit/fit.h"
#include "fit/result/report.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// Where the variables stand: nowhere near a bound. Sigma of the data does not depend on it.
const Eigen::VectorXd kMiddle = Eigen::VectorXd::Constant(3, 0.5);

// Two parameters with r = A p: the covariance is the inverse of A^T A + the prior's information.
TEST(UncertaintyTest, EqualsTheInverseOfTheNormalMatrix) {
  const std::vector<Variable> variables = {{1e-7, 2e-3, true, std::nullopt},
                                           {0, 1, false, Prior{0.15, 0.1}}};
  Eigen::MatrixXd jacobian(3, 2);
  jacobian << 1e6, 20, -2e6, 10, 3e5, -7;
  Eigen::Matrix2d normal = jacobian.transpose() * jacobian;
  normal(1, 1) += 1 / (0.1 * 0.1);
  const Eigen::Matrix2d expected = normal.inverse();
  const Uncertainty result = uncertainty(variables, kMiddle, jacobian);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(result.sigma[i] / std::sqrt(expected(i, i)), 1, 1e-10);
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(result.covariance(i, j) / expected(i, j), 1, 1e-9);
    }
  }
  const double correlation = normal(0, 1) / std::sqrt(normal(0, 0) * normal(1, 1));
  EXPECT_NEAR(result.correlation(0, 1), -correlation, 1e-10);
  EXPECT_NEAR(result.condition_number, (1 + std::abs(correlation)) / (1 - std::abs(correlation)),
              1e-9);
}

// Data that say exactly as much as the prior leave sigma at 1 / sqrt(2) = 0.707 of it; just more
// makes the parameter identifiable.
TEST(UncertaintyTest, IdentifiableWhenTheDataSayMoreThanThePrior) {
  const std::vector<Variable> variables = {{0, 1, false, Prior{0.15, 0.1}}};
  const Eigen::MatrixXd weak = Eigen::MatrixXd::Constant(1, 1, 0.95 / 0.1);
  const Eigen::MatrixXd strong = Eigen::MatrixXd::Constant(1, 1, 1.1 / 0.1);
  EXPECT_FALSE(uncertainty(variables, kMiddle, weak).identifiable[0]);
  EXPECT_TRUE(uncertainty(variables, kMiddle, strong).identifiable[0]);
}

// Of one variable a / (a + b), with a and b the data's and the prior's inverse variances; at a
// bound none.
TEST(UncertaintyTest, CountsWhatTheDataDetermine) {
  constexpr double kData = 12, kPrior = 4;
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Constant(1, 1, std::sqrt(kData));
  const auto determined = [&](std::optional<Prior> prior, double scaled) {
    return uncertainty({{0, 1, false, prior}}, Eigen::VectorXd::Constant(1, scaled), jacobian)
        .determined;
  };
  EXPECT_NEAR(determined(Prior{0.3, 1 / std::sqrt(kPrior)}, 0.5), kData / (kData + kPrior), 1e-12);
  EXPECT_NEAR(determined(std::nullopt, 0.5), 1, 1e-12);
  EXPECT_EQ(determined(std::nullopt, 1), 0);
}

// Two equal columns without prior: both open, the third parameter keeps its sigma, no matrix.
TEST(UncertaintyTest, SingularDirectionIsReported) {
  const std::vector<Variable> variables = {{5000, 12000, true, std::nullopt},
                                           {0, 1, false, std::nullopt},
                                           {-0.6, 0.98, false, std::nullopt}};
  Eigen::MatrixXd jacobian(4, 3);
  jacobian << 1e-3, 2, 5, 2e-3, 4, -3, -1e-3, -2, 40, 0.5e-3, 1, 1;
  const Uncertainty result = uncertainty(variables, kMiddle, jacobian);
  EXPECT_TRUE(std::isinf(result.condition_number));
  EXPECT_EQ(result.covariance.size(), 0);
  EXPECT_TRUE(std::isnan(result.sigma[0]));
  EXPECT_TRUE(std::isnan(result.sigma[1]));
  EXPECT_FALSE(result.identifiable[0]);
  EXPECT_FALSE(result.identifiable[1]);
  EXPECT_GT(result.sigma[2], 0);
  EXPECT_TRUE(result.identifiable[2]);
}

TEST(UncertaintyTest, ParameterWithoutEffectIsReported) {
  const std::vector<Variable> variables = {{0, 1, false, std::nullopt},
                                           {-0.6, 0.98, false, std::nullopt}};
  Eigen::MatrixXd jacobian(2, 2);
  jacobian << 0, 30, 0, 10;
  const Uncertainty result = uncertainty(variables, kMiddle, jacobian);
  EXPECT_TRUE(std::isinf(result.condition_number));
  EXPECT_TRUE(std::isnan(result.sigma[0]));
  EXPECT_FALSE(result.identifiable[0]);
  EXPECT_NEAR(result.sigma[1], 1 / std::sqrt(1000.0), 1e-12);
}

// Everything free and no priors: scale heights and coefficients are one in the toy sky.
TEST(UncertaintyTest, FitOfEverythingWithoutPriorsReportsTheSingularCovariance) {
  FitOptions options;
  options.use_priors = false;
  options.free.emplace();
  for (const Parameter& id : standard_parameters()) {
    if (has_parameter(true_atmosphere(2), id)) options.free->push_back(id);
  }
  const Result result = fit_atmosphere(synthetic_reference(true_atmosphere(2), 0.02),
                                       refs::standard_spectral_data(), ToySky(), options);
  EXPECT_EQ(result.covariance.size(), 0);
  EXPECT_TRUE(std::isinf(result.condition_number));
  EXPECT_NE(full_report(result).find("The covariance is singular"), std::string::npos);
  EXPECT_TRUE(report_json(result)["condition_number"].is_null());
}

// A prior alone: the answer is the prior's, and the report says so.
TEST(UncertaintyTest, PriorAloneIsNotIdentifiable) {
  FitOptions options;
  options.free.emplace({Parameter::kOzoneColumn, Parameter::kMiePhaseG1});
  options.priors = {{Parameter::kOzoneColumn, {280, 30}}};
  const Result result = fit_atmosphere(synthetic_reference(true_atmosphere(2), 0.02),
                                       refs::standard_spectral_data(), ToySky(), options);
  EXPECT_FALSE(result.unknown("ozone.column").identifiable);
  EXPECT_NEAR(result.unknown("ozone.column").sigma, 30, 3);
  EXPECT_NE(full_report(result).find("not identifiable"), std::string::npos);
}

}  // namespace
}  // namespace skyfit::fit
