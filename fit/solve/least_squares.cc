// SPDX-License-Identifier: Apache-2.0
#include "fit/solve/least_squares.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <exception>
#include <memory>
#include <stdexcept>

namespace skyfit::fit {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Evaluates the function once per point of the solver; the cost functions below only read it.
class Prepared : public ceres::EvaluationCallback {
 public:
  Prepared(const LeastSquares& problem, const Eigen::VectorXd& start)
      : problem_(problem), scaled_(start) {}

  Eigen::VectorXd& scaled() { return scaled_; }

  // Ceres asks for the value at a trial point and, where it takes the step, for the Jacobian there,
  // which costs less together. It takes most steps; after one that it did not, it asks first.
  void PrepareForEvaluation(bool evaluate_jacobians, bool) override {
    const bool same_point = prepared_at_.size() > 0 && prepared_at_ == scaled_;
    const bool last_step_taken = jacobian_was_wanted_;
    jacobian_was_wanted_ = evaluate_jacobians || (same_point && jacobian_was_wanted_);
    if (same_point && (has_jacobian_ || !evaluate_jacobians || failed_)) return;
    prepared_at_ = scaled_;
    has_jacobian_ = evaluate_jacobians || last_step_taken;
    failed_ = false;
    try {
      ++(has_jacobian_ ? derivative_evaluations_ : evaluations_);
      residuals_ = problem_.function->evaluate(scaled_, has_jacobian_);
    } catch (const std::domain_error&) {  // a dark sky: Ceres takes a shorter step
      fail();
    } catch (...) {
      fail();
      if (!fatal_) fatal_ = std::current_exception();
    }
  }

  bool failed() const { return failed_ || fatal_; }
  const Residuals& residuals() const { return residuals_; }
  int evaluations() const { return evaluations_; }
  int derivative_evaluations() const { return derivative_evaluations_; }
  void rethrow() const {
    if (fatal_) std::rethrow_exception(fatal_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void fail() {
    failed_ = true;
    failure_ = std::current_exception();
  }

  const LeastSquares& problem_;
  Eigen::VectorXd scaled_, prepared_at_;
  Residuals residuals_;
  bool has_jacobian_ = false, jacobian_was_wanted_ = false, failed_ = false;
  std::exception_ptr failure_, fatal_;
  int evaluations_ = 0, derivative_evaluations_ = 0;
};

class BlockCost : public ceres::CostFunction {
 public:
  static BlockCost* Create(const Prepared* prepared, int first, int count, int variables) {
    return new BlockCost(prepared, first, count, variables);
  }
  bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
    if (prepared_->failed()) return false;
    const Residuals& all = prepared_->residuals();
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) =
        all.value.segment(first_, num_residuals());
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Rows>(jacobians[0], num_residuals(), parameter_block_sizes()[0]) =
          all.jacobian.middleRows(first_, num_residuals());
    }
    return true;
  }

 private:
  BlockCost(const Prepared* prepared, int first, int count, int variables)
      : prepared_(prepared), first_(first) {
    set_num_residuals(count);
    mutable_parameter_block_sizes()->push_back(variables);
  }
  const Prepared* prepared_;
  int first_;
};

class PriorCost : public ceres::CostFunction {
 public:
  // Null when no variable has a prior.
  static PriorCost* Create(const std::vector<Variable>& variables) {
    std::vector<int> held;
    for (std::size_t p = 0; p < variables.size(); ++p) {
      if (variables[p].prior) held.push_back(static_cast<int>(p));
    }
    return held.empty() ? nullptr : new PriorCost(variables, held);
  }
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Index count = num_residuals();
    Rows derivative = Rows::Zero(count, parameter_block_sizes()[0]);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Variable& variable = variables_[held_[k]];
      const double scaled = blocks[0][held_[k]];
      residuals[k] = (variable.value(scaled) - variable.prior->mean) / variable.prior->sigma;
      derivative(k, held_[k]) = variable.value_per_scaled(scaled) / variable.prior->sigma;
    }
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Rows>(jacobians[0], derivative.rows(), derivative.cols()) = derivative;
    }
    return true;
  }

 private:
  PriorCost(const std::vector<Variable>& variables, const std::vector<int>& held)
      : variables_(variables), held_(held) {
    set_num_residuals(static_cast<int>(held.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(variables.size()));
  }
  const std::vector<Variable>& variables_;
  std::vector<int> held_;
};

// docs/theory (11.5) and (11.6).
// Null: plain squares. Of a block of n residuals with squares s: n rho(s / n).
std::unique_ptr<ceres::LossFunction> block_loss(const LeastSquares& problem, int count) {
  const double width = problem.loss_width * std::sqrt(count);
  switch (problem.loss) {
    case Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(width);
    case Loss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(width);
    case Loss::kNone:
      break;
  }
  return nullptr;
}

ceres::Solver::Options solver_options(const SolverLimits& limits) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = limits.max_iterations;
  options.function_tolerance = limits.function_tolerance;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres logs failures even so; we throw them
  options.num_threads = 1;                 // the time is in the model, which has its own
  return options;
}

void add_blocks(const LeastSquares& problem, Prepared& prepared, ceres::Problem& ceres_problem) {
  const int variables = static_cast<int>(problem.variables.size());
  double* const scaled = prepared.scaled().data();
  int first = 0;
  for (const int count : problem.blocks) {
    if (count == 0) continue;
    ceres_problem.AddResidualBlock(BlockCost::Create(&prepared, first, count, variables),
                                   block_loss(problem, count).release(), scaled);
    first += count;
  }
  if (PriorCost* priors = PriorCost::Create(problem.variables)) {
    ceres_problem.AddResidualBlock(priors, nullptr, scaled);
  }
  for (int p = 0; p < variables; ++p) {
    ceres_problem.SetParameterLowerBound(scaled, p, 0);
    ceres_problem.SetParameterUpperBound(scaled, p, 1);
  }
}

}  // namespace

std::string_view loss_name(Loss loss) {
  switch (loss) {
    case Loss::kHuber:
      return "huber";
    case Loss::kCauchy:
      return "cauchy";
    case Loss::kNone:
      break;
  }
  return "none";
}

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start,
                 const SolverLimits& limits) {
  Prepared prepared(problem, start);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &prepared;
  ceres::Problem ceres_problem(problem_options);
  add_blocks(problem, prepared, ceres_problem);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(limits), &ceres_problem, &summary);
  if (!summary.IsSolutionUsable()) {
    prepared.rethrow();
    throw std::runtime_error(fmt::format("fit: the solver failed: {}", summary.message));
  }
  Minimum result;
  result.scaled = prepared.scaled();
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  result.evaluations = prepared.evaluations();
  result.derivative_evaluations = prepared.derivative_evaluations();
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.termination = ceres::TerminationTypeToString(summary.termination_type);
  return result;
}

std::vector<double> loss_weights(const LeastSquares& problem, const Eigen::VectorXd& residuals) {
  std::vector<double> weights;
  Eigen::Index first = 0;
  for (const int count : problem.blocks) {
    double rho[3] = {0, 1, 0};
    if (const auto loss = block_loss(problem, count)) {
      loss->Evaluate(residuals.segment(first, count).squaredNorm(), rho);
    }
    weights.push_back(rho[1]);
    first += count;
  }
  return weights;
}

}  // namespace skyfit::fit
