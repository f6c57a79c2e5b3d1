// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fit/problem/free_parameters.h"
#include "fit/result/preset_record.h"
#include "fit/result/rms.h"
#include "fit/solve/multi_start.h"
#include "fit/uncertainty/noise.h"
#include "fit/uncertainty/uncertainty.h"

namespace skyfit::fit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kCoarseIterations = 15;      // what does not settle by then is compared as it is
constexpr double kCoarseTolerance = 1e-3;  // relative change of the cost
constexpr double kTolerance = 1e-7;
constexpr double kNoiseAgrees = 0.05;  // relative change of sigma_log that is not worth a refit
constexpr int kNoiseRounds = 4;

struct Task {
  const refs::Reference& reference;
  const SkyModel& model;
  const FitOptions& options;
  LuminanceRule rule, coarse_rule;  // the latter while searching among the starts
  Observations observations;
  Atmosphere<double> start;  // as given
  std::vector<FreeParameter> parameters;
  std::vector<Start> starts;

  Problem problem(const LuminanceRule& with_rule, double sigma_log) const {
    return {&model, &with_rule, &observations, &parameters, sigma_log};
  }
  Luminance all_samples(const Atmosphere<double>& atmosphere,
                        const std::vector<Parameter>& derivatives) const {
    std::vector<SkyPoint> points;
    for (const refs::Sample& sample : reference.samples) points.push_back(sky_point(sample));
    return model_luminance(model, rule, atmosphere, points, derivatives);
  }
  void report(double fraction, const std::string& status) const {
    if (options.progress) options.progress(fraction, status);
  }
};

void check_counts(const Task& task) {
  const int count = task.observations.count();
  const auto exclude_deg = task.options.exclude_sun * 180 / std::numbers::pi;
  if (count == 0) {
    throw std::invalid_argument(
        fmt::format("{}: no sample with weight is farther than {:.6g} deg from the sun, expected "
                    "at least one",
                    task.reference.name, exclude_deg));
  }
  const int unknowns = static_cast<int>(task.parameters.size()) + task.observations.scans;
  if (count < unknowns) {
    throw std::invalid_argument(fmt::format(
        "{}: {} samples for {} free parameters and {} luminance scales: must be at "
        "least {}",
        task.reference.name, count, task.parameters.size(), task.observations.scans, unknowns));
  }
}

Task make_task(const refs::Reference& reference, const SpectralData& spectra, const SkyModel& model,
               const FitOptions& options) {
  validate(options);
  check_lobes(options, model);
  Task task{reference,
            model,
            options,
            rule_of(reference, spectra),
            rule_of(reference, spectra, true),
            observe(reference, options.exclude_sun),
            start_atmosphere(options),
            {},
            {}};
  const Atmosphere<double> base = with_fixed_values(with_lobes(task.start, options.lobes), options);
  task.parameters = choose_free_parameters(options, model, base);
  task.starts = choose_starts(base, task.parameters, options.starts, options.start.has_value());
  if (!options.start) task.start = task.starts.front().atmosphere;
  for (const auto& [id, value] : options.fix) {
    if (has_parameter(task.start, id)) set_parameter(task.start, id, value);
  }
  check_counts(task);
  return task;
}

// What `solution` leaves, per sample, without weights.
Noise noise_at(const Task& task, const Solution& solution, FitResult& result) {
  ++result.model_evaluations;
  const Luminance luminance =
      model_luminance(task.model, task.rule, solution.atmosphere, task.observations.points, {});
  const Eigen::VectorXd residual =
      log_residuals(task.observations, luminance)
          .residual.cwiseQuotient(task.observations.weight.cwiseSqrt());
  return estimate_noise(task.observations, residual, static_cast<int>(task.parameters.size()));
}

void count_work(FitResult& result, int iterations, int evaluations, int derivative_evaluations) {
  result.iterations += iterations;
  result.model_evaluations += evaluations;
  result.derivative_evaluations += derivative_evaluations;
}

Solution search(const Task& task, FitResult& result) {
  const double sigma_log = task.observations.has_sigma ? 1 : kFirstSigmaLog;
  MultiStart searched = solve_from(
      task.starts, task.problem(task.coarse_rule, sigma_log),
      {std::min(task.options.max_iterations, kCoarseIterations), kCoarseTolerance},
      task.options.threads, [&](double share) {
        task.report(0.7 * share, fmt::format("{:.0f} of {} starts",
                                             share * static_cast<double>(task.starts.size()),
                                             task.starts.size()));
      });
  count_work(result, searched.iterations, searched.evaluations, searched.derivative_evaluations);
  result.starts = searched.summaries;
  return searched.best;
}

// Refines the best start with the full rule and, where the reference has no sigma, repeats with the
// sigma that the residuals show until the two agree.
Solution refine(const Task& task, Solution solution, FitResult& result) {
  const bool lobes_may_swap = lobes_interchangeable(task.parameters);
  Noise noise{1, static_cast<double>(task.observations.count())};
  if (!task.observations.has_sigma) noise = noise_at(task, solution, result);
  for (int round = 0; round < kNoiseRounds; ++round) {
    task.report(0.7 + 0.07 * round, "refining the best start");
    if (lobes_may_swap) order_lobes(solution.atmosphere);
    solution = minimise(task.problem(task.rule, noise.sigma_log), solution.atmosphere,
                        {task.options.max_iterations, kTolerance});
    count_work(result, solution.iterations, solution.evaluations, solution.derivative_evaluations);
    if (task.observations.has_sigma) break;
    const double before = noise.sigma_log;
    noise = noise_at(task, solution, result);
    if (std::abs(noise.sigma_log / before - 1) < kNoiseAgrees) break;
  }
  if (lobes_may_swap) order_lobes(solution.atmosphere);
  result.sigma_from_residuals = !task.observations.has_sigma;
  result.effective_samples = noise.effective_samples;
  result.sigma_log_percent =
      100 * (result.sigma_from_residuals
                 ? noise.sigma_log
                 : task.observations.sigma_log.norm() / std::sqrt(task.observations.count()));
  return solution;
}

std::vector<FittedParameter> parameter_rows(const Task& task, const Atmosphere<double>& fitted,
                                            const Uncertainty& uncertain) {
  std::vector<FittedParameter> rows;
  for (const Parameter& id : parameters_of(fitted)) {
    FittedParameter row(id);
    row.start = has_parameter(task.start, id) ? get_parameter(task.start, id) : kNan;
    row.fitted = get_parameter(fitted, id);
    for (std::size_t p = 0; p < task.parameters.size(); ++p) {
      if (task.parameters[p].id != id) continue;
      row.free = true;
      row.sigma = uncertain.sigma[p];
      row.at_bound = uncertain.at_bound[p];
      row.identifiable = uncertain.identifiable[p];
      row.prior = task.parameters[p].prior;
    }
    rows.push_back(row);
  }
  return rows;
}

// exp of the profiled log scales, per sample of the reference.
std::vector<double> sample_scales(const Task& task, const Eigen::VectorXd& log_scale) {
  std::map<int, double> of_scan;
  for (int s = 0; s < task.observations.scans; ++s) {
    of_scan[task.observations.scan_name[s]] = std::exp(log_scale(s));
  }
  std::vector<double> result;
  for (const refs::Sample& sample : task.reference.samples) {
    const auto found = of_scan.find(sample.scan);
    result.push_back(found == of_scan.end() ? kNan : found->second);
  }
  return result;
}

void describe_start(const Task& task, FitResult& result) {
  const Luminance luminance = task.all_samples(task.start, {});
  ++result.model_evaluations;
  result.start_model.assign(luminance.value.begin(), luminance.value.end());
  result.start_rms = rms_summary(task.reference, luminance, task.options.exclude_sun);
  result.start_per_sun = rms_per_sun(task.reference, luminance, task.options.exclude_sun);
  result.start_scale = sample_scales(
      task, log_residuals(task.observations, select(luminance, task.observations)).log_scale);
}

void describe_fit(const Task& task, const Solution& solution, FitResult& result) {
  const Luminance luminance = task.all_samples(solution.atmosphere, ids(task.parameters));
  ++result.derivative_evaluations;
  const LogResiduals residuals =
      log_residuals(task.observations, select(luminance, task.observations));
  const double sigma_log = result.sigma_from_residuals ? result.sigma_log_percent / 100 : 1;
  const Uncertainty uncertain =
      uncertainty(task.parameters, solution.atmosphere, residuals.jacobian / sigma_log);
  result.parameters = parameter_rows(task, solution.atmosphere, uncertain);
  for (const int p : uncertain.inside) {
    result.covariance_parameters.push_back(task.parameters[p].id);
  }
  result.covariance = uncertain.covariance;
  result.correlation = uncertain.correlation;
  result.condition_number = uncertain.condition_number;
  result.fitted_model.assign(luminance.value.begin(), luminance.value.end());
  result.fitted_rms = rms_summary(task.reference, luminance, task.options.exclude_sun);
  result.rms_log_percent = result.fitted_rms.all;
  result.per_sun = rms_per_sun(task.reference, luminance, task.options.exclude_sun);
  result.scale = sample_scales(task, residuals.log_scale);
  result.samples = task.observations.count();
  result.scans = task.observations.scans;
  const double freedom =
      result.samples - result.scans - static_cast<double>(ids(task.parameters).size());
  result.chi_square_per_dof =
      freedom > 0 ? residuals.residual.squaredNorm() / (sigma_log * sigma_log) / freedom : kNan;
}

}  // namespace

FitResult fit_atmosphere(const refs::Reference& reference, const SpectralData& spectra,
                         const SkyModel& model, const FitOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Task task = make_task(reference, spectra, model, options);
  FitResult result;
  describe_start(task, result);
  const Solution solution = refine(task, search(task, result), result);
  result.converged = solution.converged;
  result.termination = solution.termination;
  describe_fit(task, solution, result);
  result.preset = fitted_preset(solution.atmosphere, reference, model, options, result);
  task.report(1, brief_report(result));
  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace skyfit::fit
