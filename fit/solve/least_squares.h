// SPDX-License-Identifier: Apache-2.0
// Bounded nonlinear least squares with Ceres: one parameter block with all variables (scaled to
// 0..1), the residuals in blocks that share one evaluation, one residual (value - mean) / sigma per
// prior.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "fit/problem/variable.h"

namespace skyfit::fit {

// Whitened residuals and their derivatives by the scaled variables.
struct Residuals {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;  // [residual][variable]; empty unless asked for
};

class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  // Called once per point. Throws std::domain_error where there is no value: the solver takes a
  // shorter step; other exceptions pass through minimise().
  virtual Residuals evaluate(const Eigen::VectorXd& scaled, bool with_jacobian) = 0;
};

// rho(s) of the mean square s of a block's residuals; blocks then weigh as many residuals as they
// have.
enum class Loss { kNone, kHuber, kCauchy };
std::string_view loss_name(Loss loss);  // "none", "huber", "cauchy"

struct LeastSquares {
  ResidualFunction* function;
  std::vector<int>
      blocks;  // sizes of consecutive blocks of residuals, their sum is all of them; may be 0
  std::vector<Variable> variables;
  Loss loss = Loss::kNone;
  double loss_width = 3;  // in sigmas
};

struct SolverLimits {
  int max_iterations = 100;
  double function_tolerance = 1e-8;
};

struct Minimum {
  Eigen::VectorXd scaled;
  double cost = 0;  // half the sum of squares, priors included
  int iterations = 0, evaluations = 0, derivative_evaluations = 0;
  bool converged = false;
  std::string termination;
};

// Minimises from `start`, every entry in 0..1. Exceptions of the function pass through; throws
// std::runtime_error when Ceres fails.
Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start,
                 const SolverLimits& limits);

// rho'(mean square) of each block, 0 .. 1: what the loss leaves of its weight.
std::vector<double> loss_weights(const LeastSquares& problem, const Eigen::VectorXd& residuals);

}  // namespace skyfit::fit
