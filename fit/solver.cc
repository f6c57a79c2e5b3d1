// SPDX-License-Identifier: Apache-2.0
#include "fit/solver.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <stdexcept>

#include "fit/residuals.h"

namespace skyfit::fit {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Evaluates the model once per point of the solver; the cost function below only reads it.
class PreparedSky : public ceres::EvaluationCallback {
 public:
  PreparedSky(const Problem& problem, const Atmosphere<double>& start)
      : problem_(problem), atmosphere_(start), scaled_(scaled_values(*problem.parameters, start)) {}

  double* scaled() { return scaled_.data(); }
  Atmosphere<double> atmosphere() const {
    return with_scaled_values(atmosphere_, *problem_.parameters, scaled_.data());
  }

  void PrepareForEvaluation(bool evaluate_jacobians, bool) override {
    const bool same_point = prepared_at_.size() > 0 && prepared_at_ == scaled_;
    if (same_point && (has_jacobian_ || !evaluate_jacobians || failed_)) return;
    prepared_at_ = scaled_;
    has_jacobian_ = evaluate_jacobians;
    failed_ = false;
    try {
      prepare(evaluate_jacobians);
    } catch (const std::domain_error&) {  // a dark sky: Ceres takes a shorter step
      fail();
    } catch (...) {
      fail();
      if (!fatal_) fatal_ = std::current_exception();
    }
  }

  bool failed() const { return failed_ || fatal_; }
  const Eigen::VectorXd& residual() const { return residuals_.residual; }
  const Eigen::MatrixXd& jacobian() const { return residuals_.jacobian; }  // per scaled unit
  int evaluations() const { return evaluations_; }
  int derivative_evaluations() const { return derivative_evaluations_; }
  void rethrow() const {
    if (fatal_) std::rethrow_exception(fatal_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void prepare(bool evaluate_jacobians) {
    const std::vector<FreeParameter>& parameters = *problem_.parameters;
    const std::vector<Parameter> wanted =
        evaluate_jacobians ? ids(parameters) : std::vector<Parameter>{};
    ++(evaluate_jacobians ? derivative_evaluations_ : evaluations_);
    residuals_ = log_residuals(*problem_.observations,
                               model_luminance(*problem_.model, *problem_.rule, atmosphere(),
                                               problem_.observations->points, wanted));
    residuals_.residual /= problem_.sigma_log;
    for (Eigen::Index p = 0; p < residuals_.jacobian.cols(); ++p) {
      residuals_.jacobian.col(p) *= parameters[p].value_per_scaled(scaled_(p)) / problem_.sigma_log;
    }
  }

  void fail() {
    failed_ = true;
    failure_ = std::current_exception();
  }

  const Problem& problem_;
  Atmosphere<double> atmosphere_;
  Eigen::VectorXd scaled_, prepared_at_;
  LogResiduals residuals_;
  bool has_jacobian_ = false, failed_ = false;
  std::exception_ptr failure_, fatal_;
  int evaluations_ = 0, derivative_evaluations_ = 0;
};

class SampleCost : public ceres::CostFunction {
 public:
  static SampleCost* Create(const PreparedSky* sky, int samples, int parameters) {
    return new SampleCost(sky, samples, parameters);
  }
  bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
    if (sky_->failed()) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = sky_->residual();
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Rows>(jacobians[0], num_residuals(), parameter_block_sizes()[0]) =
          sky_->jacobian();
    }
    return true;
  }

 private:
  SampleCost(const PreparedSky* sky, int samples, int parameters) : sky_(sky) {
    set_num_residuals(samples);
    mutable_parameter_block_sizes()->push_back(parameters);
  }
  const PreparedSky* sky_;
};

class PriorCost : public ceres::CostFunction {
 public:
  // Null when no parameter has a prior.
  static PriorCost* Create(const std::vector<FreeParameter>& parameters) {
    std::vector<int> held;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (parameters[p].prior) held.push_back(static_cast<int>(p));
    }
    return held.empty() ? nullptr : new PriorCost(parameters, held);
  }
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Index count = num_residuals();
    Rows derivative = Rows::Zero(count, parameter_block_sizes()[0]);
    for (Eigen::Index k = 0; k < count; ++k) {
      const FreeParameter& parameter = parameters_[held_[k]];
      const double scaled = blocks[0][held_[k]];
      residuals[k] = (parameter.value(scaled) - parameter.prior->mean) / parameter.prior->sigma;
      derivative(k, held_[k]) = parameter.value_per_scaled(scaled) / parameter.prior->sigma;
    }
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Rows>(jacobians[0], derivative.rows(), derivative.cols()) = derivative;
    }
    return true;
  }

 private:
  PriorCost(const std::vector<FreeParameter>& parameters, const std::vector<int>& held)
      : parameters_(parameters), held_(held) {
    set_num_residuals(static_cast<int>(held.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
  }
  const std::vector<FreeParameter>& parameters_;
  std::vector<int> held_;
};

ceres::Solver::Options solver_options(const SolverLimits& limits) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = limits.max_iterations;
  options.function_tolerance = limits.function_tolerance;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // the time is in the model, which has its own
  return options;
}

}  // namespace

Solution minimise(const Problem& problem, const Atmosphere<double>& start,
                  const SolverLimits& limits) {
  PreparedSky sky(problem, start);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &sky;
  ceres::Problem ceres_problem(problem_options);
  const std::vector<FreeParameter>& parameters = *problem.parameters;
  const int count = static_cast<int>(parameters.size());
  ceres_problem.AddResidualBlock(SampleCost::Create(&sky, problem.observations->count(), count),
                                 nullptr, sky.scaled());
  if (PriorCost* priors = PriorCost::Create(parameters)) {
    ceres_problem.AddResidualBlock(priors, nullptr, sky.scaled());
  }
  for (int p = 0; p < count; ++p) {
    ceres_problem.SetParameterLowerBound(sky.scaled(), p, 0);
    ceres_problem.SetParameterUpperBound(sky.scaled(), p, 1);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(limits), &ceres_problem, &summary);
  if (!summary.IsSolutionUsable()) {
    sky.rethrow();
    throw std::runtime_error(fmt::format("fit: the solver failed: {}", summary.message));
  }
  Solution result;
  result.atmosphere = sky.atmosphere();
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  result.evaluations = sky.evaluations();
  result.derivative_evaluations = sky.derivative_evaluations();
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.termination = ceres::TerminationTypeToString(summary.termination_type);
  return result;
}

}  // namespace skyfit::fit
