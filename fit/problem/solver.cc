// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/solver.h"

#include "fit/problem/residuals.h"

namespace skyfit::fit {
namespace {

class LogSky : public ResidualFunction {
 public:
  LogSky(const Problem& problem, const Atmosphere<double>& start)
      : problem_(problem), start_(start) {}

  Atmosphere<double> atmosphere(const Eigen::VectorXd& scaled) const {
    return with_scaled_values(start_, *problem_.parameters, scaled.data());
  }

  Residuals evaluate(const Eigen::VectorXd& scaled, bool with_jacobian) override {
    const std::vector<FreeParameter>& parameters = *problem_.parameters;
    const std::vector<Parameter> wanted =
        with_jacobian ? ids(parameters) : std::vector<Parameter>{};
    LogResiduals log = log_residuals(
        *problem_.observations, model_luminance(*problem_.model, *problem_.rule, atmosphere(scaled),
                                                problem_.observations->points, wanted));
    log.residual /= problem_.sigma_log;
    for (Eigen::Index p = 0; p < log.jacobian.cols(); ++p) {
      log.jacobian.col(p) *= parameters[p].value_per_scaled(scaled(p)) / problem_.sigma_log;
    }
    return {log.residual, log.jacobian};
  }

 private:
  const Problem& problem_;
  const Atmosphere<double>& start_;
};

}  // namespace

Solution minimise(const Problem& problem, const Atmosphere<double>& start,
                  const SolverLimits& limits) {
  LogSky sky(problem, start);
  const std::vector<FreeParameter>& parameters = *problem.parameters;
  const Minimum minimum =
      minimise({&sky, {problem.observations->count()}, {parameters.begin(), parameters.end()}},
               scaled_values(parameters, start), limits);
  return {
      sky.atmosphere(minimum.scaled), minimum.cost,      minimum.iterations, minimum.evaluations,
      minimum.derivative_evaluations, minimum.converged, minimum.termination};
}

}  // namespace skyfit::fit
