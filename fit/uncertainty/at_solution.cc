// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/at_solution.h"

#include <utility>

namespace skyfit::fit {

AtSolution at_solution(const Problem& problem, const Dataset& data, const SampleValues& values,
                       const Eigen::VectorXd& scaled, double factor) {
  Whitened white = whiten(data, problem.likelihood, values, factor);
  AtSolution at{std::move(white.residual), {}, {}, {}};
  at.weights = problem.loss_weights(data, at.residual);
  at.jacobian = at.weights.cwiseSqrt().asDiagonal() * white.jacobian_per_unit;
  at.independent =
      uncertainty({problem.unknowns.begin(), problem.unknowns.end()}, scaled, at.jacobian);
  return at;
}

Noise noise_of(const Problem& problem, const Dataset& data, const AtSolution& at, double factor) {
  return estimate_noise(data, problem.likelihood, factor * at.residual, at.weights,
                        at.independent.determined + problem.profiled_scales());
}

}  // namespace skyfit::fit
