// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace skyfit::fit {
namespace {

constexpr double kBoundRim = 1e-6;   // of the range; the solver lands on bounds exactly
constexpr double kSingular = 1e-12;  // eigenvalue over the largest: 1e-6 in the Jacobian
constexpr double kTakesPart = 1e-3;  // component in a direction that nothing holds
constexpr double kLargestShareOfPrior = 0.7;
const double kUniformSigma = 1 / std::sqrt(12.0);

// The normal matrix with unit diagonal; a zero column stays zero.
struct Normalised {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd scale;   // square roots of the former diagonal
  Eigen::VectorXd priors;  // their part of the diagonal, 0 .. 1
};

Normalised normal_matrix(const std::vector<Variable>& variables, const std::vector<int>& inside,
                         const Eigen::VectorXd& scaled, const Eigen::MatrixXd& jacobian) {
  const Eigen::Index count = static_cast<Eigen::Index>(inside.size());
  Eigen::MatrixXd columns(jacobian.rows(), count);
  Eigen::VectorXd prior = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Variable& variable = variables[inside[k]];
    const double unit = variable.value_per_scaled(scaled(inside[k]));
    columns.col(k) = unit * jacobian.col(inside[k]);
    if (variable.prior) prior(k) = unit / variable.prior->sigma;
  }
  Normalised result{columns.transpose() * columns, Eigen::VectorXd(count), {}};
  result.matrix.diagonal() += prior.cwiseAbs2();
  result.scale = result.matrix.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse =
      result.scale.unaryExpr([](double s) { return s > 0 ? 1 / s : 0.0; });
  result.matrix = inverse.asDiagonal() * result.matrix * inverse.asDiagonal();
  result.priors = prior.cwiseProduct(inverse).cwiseAbs2();
  return result;
}

double sigma_without_data(const Variable& variable, double value_per_scaled) {
  return variable.prior ? variable.prior->sigma : kUniformSigma * value_per_scaled;
}

}  // namespace

// docs/theory (12.5) and (12.7).
Uncertainty uncertainty(const std::vector<Variable>& variables, const Eigen::VectorXd& scaled,
                        const Eigen::MatrixXd& jacobian) {
  Uncertainty result;
  result.sigma.assign(variables.size(), std::numeric_limits<double>::quiet_NaN());
  result.identifiable.assign(variables.size(), true);
  for (std::size_t p = 0; p < variables.size(); ++p) {
    result.at_bound.push_back(scaled(p) < kBoundRim || scaled(p) > 1 - kBoundRim);
    if (!result.at_bound[p]) result.inside.push_back(static_cast<int>(p));
  }
  const Eigen::Index count = static_cast<Eigen::Index>(result.inside.size());
  if (count == 0) return result;
  const Normalised normal = normal_matrix(variables, result.inside, scaled, jacobian);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal.matrix);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double smallest = kSingular * values(count - 1);
  const bool singular = !(values(0) > smallest);
  result.condition_number =
      singular ? std::numeric_limits<double>::infinity() : values(count - 1) / values(0);

  Eigen::VectorXd held = values, open = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const bool is_held = values(k) > smallest && values(k) > 0;
    held(k) = is_held ? 1 / values(k) : 0;
    result.determined += is_held;
    if (!is_held) open += eigen.eigenvectors().col(k).cwiseAbs2();
  }
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * held.asDiagonal() * eigen.eigenvectors().transpose();
  result.determined -= inverse.diagonal().dot(normal.priors);
  Eigen::VectorXd unit(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Variable& variable = variables[result.inside[k]];
    const double value_per_scaled = variable.value_per_scaled(scaled(result.inside[k]));
    unit(k) = normal.scale(k) > 0 ? value_per_scaled / normal.scale(k) : 0;
    const bool is_open = std::sqrt(open(k)) > kTakesPart;
    if (!is_open) result.sigma[result.inside[k]] = unit(k) * std::sqrt(inverse(k, k));
    result.identifiable[result.inside[k]] =
        !is_open && result.sigma[result.inside[k]] <
                        kLargestShareOfPrior * sigma_without_data(variable, value_per_scaled);
  }
  if (singular) return result;
  result.covariance = unit.asDiagonal() * inverse * unit.asDiagonal();
  const Eigen::VectorXd spread = inverse.diagonal().cwiseSqrt().cwiseInverse();
  result.correlation = spread.asDiagonal() * inverse * spread.asDiagonal();
  return result;
}

// docs/theory (12.6).
Uncertainty with_correlated_residuals(const Uncertainty& independent,
                                      const std::vector<Variable>& variables,
                                      const Eigen::VectorXd& scaled, const Eigen::MatrixXd& m) {
  Uncertainty result = independent;
  if (independent.covariance.size() == 0) return result;
  Eigen::MatrixXd middle = m(independent.inside, independent.inside);
  for (std::size_t k = 0; k < independent.inside.size(); ++k) {
    const std::optional<Prior>& prior = variables[independent.inside[k]].prior;
    const auto i = static_cast<Eigen::Index>(k);
    if (prior) middle(i, i) += 1 / (prior->sigma * prior->sigma);
  }
  result.covariance = independent.covariance * middle * independent.covariance;
  const Eigen::VectorXd sigma = result.covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse = sigma.cwiseInverse();
  result.correlation = inverse.asDiagonal() * result.covariance * inverse.asDiagonal();
  for (std::size_t k = 0; k < independent.inside.size(); ++k) {
    const int p = independent.inside[k];
    const double without =
        sigma_without_data(variables[p], variables[p].value_per_scaled(scaled(p)));
    result.sigma[p] = sigma(static_cast<Eigen::Index>(k));
    result.identifiable[p] = result.sigma[p] < kLargestShareOfPrior * without;
  }
  return result;
}

}  // namespace skyfit::fit
