// SPDX-License-Identifier: Apache-2.0
// What a problem's residuals and derivatives at a point say, weighted as its loss leaves them.
#pragma once

#include "fit/problem/problem.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/noise.h"

namespace skyfit::fit {

struct AtSolution {
  Eigen::VectorXd residual;  // whitened with the factor, per sample
  Eigen::VectorXd weights;   // what the loss leaves, per sample
  Eigen::MatrixXd jacobian;  // whitened, per unit of the unknowns, times the roots of the weights
  Uncertainty independent;   // docs/theory (12.5), of residuals without correlation
};

// `values`: of the model at the point, with derivatives; `factor`: on sigma.
AtSolution at_solution(const Problem& problem, const Dataset& data, const SampleValues& values,
                       const Eigen::VectorXd& scaled, double factor);

// The noise that its residuals show; `factor` as above.
Noise noise_of(const Problem& problem, const Dataset& data, const AtSolution& at, double factor);

}  // namespace skyfit::fit
