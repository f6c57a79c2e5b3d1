// SPDX-License-Identifier: Apache-2.0
// What data and priors say about the variables at the solution, in the variables' units.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/problem/variable.h"

namespace skyfit::fit {

struct Uncertainty {
  std::vector<bool> at_bound;      // per variable
  std::vector<double> sigma;       // NaN: at a bound, or held by nothing
  std::vector<bool> identifiable;  // see below
  std::vector<int> inside;         // the variables not at a bound: rows of the matrices
  Eigen::MatrixXd covariance;      // empty when singular
  Eigen::MatrixXd correlation;     // empty when singular
  // How many of the variables not at a bound the data determine beside the priors: the trace of
  // (J^T J + P)^-1 J^T J, docs/theory (12.1). Of N samples the sum of the squared residuals is N
  // less that, on average.
  double determined = 0;
  double condition_number = 0;  // of the normal matrix with unit diagonal; infinite when singular
};

// The inverse of J^T J + diag(1 / prior sigma^2) over the variables that are not at a bound.
// `jacobian`: whitened residuals per unit of the variables.
//
// A variable is not identifiable when its sigma exceeds 0.7 of its prior's (the data then say less
// than the prior); without a prior, 0.7 of the standard deviation of a uniform distribution over
// its bounds; or when it takes part in a direction that neither data nor priors hold.
Uncertainty uncertainty(const std::vector<Variable>& variables, const Eigen::VectorXd& scaled,
                        const Eigen::MatrixXd& jacobian);
// The same for residuals whose covariance is not the unit matrix: A^-1 (M + P) A^-1 with A = J^T J
// + P, P the priors' inverse variances and M = J^T covariance J over all variables. Nothing changes
// where the matrix of `independent` is singular.
Uncertainty with_correlated_residuals(const Uncertainty& independent,
                                      const std::vector<Variable>& variables,
                                      const Eigen::VectorXd& scaled, const Eigen::MatrixXd& m);

}  // namespace skyfit::fit
