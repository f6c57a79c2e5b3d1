// SPDX-License-Identifier: Apache-2.0
// The fit of luminances with a free scale per scan as a problem of least squares.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/problem/free_parameters.h"
#include "fit/problem/observations.h"
#include "fit/solve/least_squares.h"

namespace skyfit::fit {

struct Problem {
  const SkyModel* model;
  const LuminanceRule* rule;
  const Observations* observations;
  const std::vector<FreeParameter>* parameters;
  double sigma_log = 1;  // the residuals are divided by it; 1 when the observations have sigma
};

struct Solution {
  Atmosphere<double> atmosphere;
  double cost = 0;  // half the sum of squares, priors included
  int iterations = 0, evaluations = 0, derivative_evaluations = 0;
  bool converged = false;
  std::string termination;
};

// Minimises from `start`, which must be within the bounds. Exceptions of the model pass through;
// throws std::runtime_error when Ceres fails.
Solution minimise(const Problem& problem, const Atmosphere<double>& start,
                  const SolverLimits& limits);

}  // namespace skyfit::fit
