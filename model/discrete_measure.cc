// SPDX-License-Identifier: Apache-2.0
#include "model/discrete_measure.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

namespace skyfit {
namespace {

// Monic orthogonal polynomials p_{k+1} = (x - alpha_k) p_k - beta_k p_{k-1}, k = 0 .. n-1, in the
// variable x = (point - centre) / half_width, which keeps them of order one; beta_0 is the sum of
// the weights.
struct Recurrence {
  double centre, half_width;
  Eigen::VectorXd alpha, beta;
};

Eigen::ArrayXd scaled(const Recurrence& recurrence, const std::vector<double>& points) {
  const Eigen::Map<const Eigen::ArrayXd> x(points.data(), static_cast<Eigen::Index>(points.size()));
  return (x - recurrence.centre) / recurrence.half_width;
}

Recurrence stieltjes(const DiscreteMeasure& measure, int n) {
  const auto [low, high] = std::minmax_element(measure.point.begin(), measure.point.end());
  Recurrence result{0.5 * (*low + *high), std::max(0.5 * (*high - *low), 1e-300),
                    Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const Eigen::ArrayXd x = scaled(result, measure.point);
  const Eigen::Map<const Eigen::ArrayXd> w(measure.weight.data(), x.size());
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(x.size());
  Eigen::ArrayXd current = Eigen::ArrayXd::Ones(x.size());
  double norm_before = 1.0;
  for (int k = 0; k < n; ++k) {
    const double norm = (w * current.square()).sum();
    result.alpha[k] = (w * x * current.square()).sum() / norm;
    result.beta[k] = norm / norm_before;
    const Eigen::ArrayXd next =
        (x - result.alpha[k]) * current - (k > 0 ? result.beta[k] : 0.0) * before;
    before = current;
    current = next;
    norm_before = norm;
  }
  return result;
}

}  // namespace

GaussRule gauss_rule(const DiscreteMeasure& measure, int n) {
  const Recurrence recurrence = stieltjes(measure, n);
  // The nodes are the eigenvalues of the Jacobi matrix, the weights follow from its eigenvectors'
  // first components.
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  const Eigen::VectorXd off_diagonal = recurrence.beta.tail(n - 1).cwiseSqrt();
  solver.computeFromTridiagonal(recurrence.alpha, off_diagonal);
  GaussRule rule;
  for (int k = 0; k < n; ++k) {
    const double first = solver.eigenvectors()(0, k);
    rule.node.push_back(recurrence.centre + recurrence.half_width * solver.eigenvalues()[k]);
    rule.weight.push_back(recurrence.beta[0] * first * first);
  }
  return rule;
}

std::vector<double> least_squares_polynomial(const DiscreteMeasure& measure,
                                             const std::vector<double>& values, int degree,
                                             const std::vector<double>& where) {
  const Recurrence recurrence = stieltjes(measure, degree + 1);
  const Eigen::ArrayXd x = scaled(recurrence, measure.point), at = scaled(recurrence, where);
  const Eigen::Map<const Eigen::ArrayXd> w(measure.weight.data(), x.size());
  const Eigen::Map<const Eigen::ArrayXd> f(values.data(), x.size());
  Eigen::ArrayXd p = Eigen::ArrayXd::Ones(x.size()), p_before = Eigen::ArrayXd::Zero(x.size());
  Eigen::ArrayXd q = Eigen::ArrayXd::Ones(at.size()), q_before = Eigen::ArrayXd::Zero(at.size());
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(at.size());
  for (int k = 0; k <= degree; ++k) {
    sum += (w * f * p).sum() / (w * p.square()).sum() * q;
    const double beta = k > 0 ? recurrence.beta[k] : 0.0;
    const Eigen::ArrayXd p_next = (x - recurrence.alpha[k]) * p - beta * p_before;
    const Eigen::ArrayXd q_next = (at - recurrence.alpha[k]) * q - beta * q_before;
    p_before = p, p = p_next;
    q_before = q, q = q_next;
  }
  return {sum.begin(), sum.end()};
}

}  // namespace skyfit
