// SPDX-License-Identifier: Apache-2.0
#include "fit/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "fit/problem/measured_problem.h"
#include "fit/problem/observations.h"
#include "fit/result/preset_record.h"
#include "fit/uncertainty/scan_noise.h"
#include "fit/uncertainty/uncertainty.h"

namespace skyfit::fit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kSearchIterations = 30;      // what does not settle by then is compared as it is
constexpr double kSearchTolerance = 1e-4;  // relative change of the cost
constexpr double kTolerance = 1e-5;
constexpr double kFactorAgrees = 0.05;  // relative change of the factor that is not worth a refit
constexpr int kFactorRounds = 5;

void report(const MeasuredOptions& options, double fraction, const std::string& status) {
  if (options.common.progress) options.common.progress(fraction, status);
}

void count_work(MeasuredResult& result, const Minimum& minimum) {
  result.iterations += minimum.iterations;
  result.model_evaluations += minimum.evaluations;
  result.derivative_evaluations += minimum.derivative_evaluations;
}

// The best start after a search with few wavelengths.
Eigen::VectorXd search(const MeasuredProblem& problem, const MeasuredOptions& options,
                       MeasuredResult& result) {
  Eigen::VectorXd best;
  double best_cost = std::numeric_limits<double>::infinity();
  std::size_t best_start = 0;
  std::exception_ptr failure;
  for (std::size_t s = 0; s < problem.starts.size(); ++s) {
    report(options, 0.6 * static_cast<double>(s) / static_cast<double>(problem.starts.size()),
           fmt::format("start {} of {}", s + 1, problem.starts.size()));
    const Eigen::VectorXd from =
        scaled_values(problem.unknowns, start_state(problem.starts[s].atmosphere, problem.scans()));
    StartSummary summary{problem.starts[s].name, std::numeric_limits<double>::infinity(), 0, false};
    try {
      const Minimum minimum = problem.solve(
          problem.coarse, from, 1,
          {std::min(options.common.max_iterations, kSearchIterations), kSearchTolerance});
      count_work(result, minimum);
      summary.cost = minimum.cost;
      summary.iterations = minimum.iterations;
      if (minimum.cost < best_cost) {
        best_cost = minimum.cost;
        best = minimum.scaled;
        best_start = s;
      }
    } catch (const std::exception&) {
      failure = std::current_exception();
    }
    result.starts.push_back(summary);
  }
  if (!std::isfinite(best_cost)) std::rethrow_exception(failure);
  result.starts[best_start].best = true;
  return best;
}

ScanNoise noise_at(const MeasuredProblem& problem, const ScanData& data,
                   const Eigen::VectorXd& scaled, MeasuredResult& result) {
  ++result.model_evaluations;
  return scan_noise(data, problem.residuals(data, scaled, 1),
                    static_cast<int>(problem.unknowns.size()));
}

// The samples that are not fitted because they truly look too close to the sun.
refs::Reference without_sun(const refs::Reference& reference, const MeasuredProblem& problem,
                            const SkyState& state, const MeasuredOptions& options) {
  refs::Reference result = reference;
  for (refs::Sample& sample : result.samples) {
    const auto scan = static_cast<std::size_t>(
        std::ranges::find(problem.all.scans, sample.scan, &ScanInfo::number) -
        problem.all.scans.begin());
    const SkyPoint point =
        pointed(sky_point(sample), problem.all.scans[scan].sun_azimuth + sample.sun_azimuth_since,
                state.instrument[scan]);
    refs::Sample at = sample;
    at.view_zenith = point.view_zenith;
    at.relative_azimuth = point.relative_azimuth;
    if (sample.weight == 0 || refs::scattering_angle(at) >= options.common.exclude_sun) continue;
    sample.weight = 0;
    sample.zero_weight_reason = fmt::format("within {:.4g} deg of the sun",
                                            options.common.exclude_sun * 180 / std::numbers::pi);
  }
  return result;
}

struct Refined {
  Eigen::VectorXd scaled;
  ScanNoise noise;
};

// Few wavelengths, repeated with the factor on sigma that the residuals show until the two agree;
// then all of them.
Refined refine(const MeasuredProblem& problem, const MeasuredOptions& options,
               Eigen::VectorXd scaled, MeasuredResult& result) {
  const auto solve = [&](const ScanData& data, double factor) {
    const Minimum minimum =
        problem.solve(data, scaled, factor, {options.common.max_iterations, kTolerance});
    count_work(result, minimum);
    scaled = minimum.scaled;
    result.converged = minimum.converged;
    result.termination = minimum.termination;
  };
  // First as if the residuals were independent: a poor fit's agree more, and a factor from them
  // would let the priors keep it poor.
  double factor = 1;
  for (int round = 0; round < kFactorRounds && !options.noise_is_stated; ++round) {
    report(options, 0.6 + 0.05 * round, "refining the best start");
    const ScanNoise noise = noise_at(problem, problem.coarse, scaled, result);
    const double before =
        std::exchange(factor, round == 0 ? noise.independent_factor : noise.factor);
    if (round > 1 && std::abs(factor / before - 1) < kFactorAgrees) break;
    solve(problem.coarse, factor);
  }
  report(options, 0.8, "refining with all wavelengths");
  ScanNoise noise;
  noise.effective_samples = static_cast<double>(problem.fitted.rows.size());
  if (!options.noise_is_stated) noise = noise_at(problem, problem.fitted, scaled, result);
  result.sigma_factor = noise.factor;
  result.effective_samples = noise.effective_samples;
  solve(problem.fitted, noise.factor);
  return {scaled, noise};
}

// The fit weighs with sigma * factor; the residuals vary as the noise says.
Uncertainty uncertainty_at(const MeasuredProblem& problem, const Eigen::VectorXd& scaled,
                           const Whitened& white, const ScanNoise& noise) {
  const std::vector<Variable> variables(problem.unknowns.begin(), problem.unknowns.end());
  const Eigen::MatrixXd& jacobian = white.jacobian_per_unit;
  const Uncertainty independent = uncertainty(variables, scaled, jacobian);
  if (noise.length == 0 && noise.wavelength_correlation == 0) return independent;
  const double variance = std::pow(noise.independent_factor / noise.factor, 2);
  return with_correlated_residuals(
      independent, variables, scaled,
      variance * jacobian.transpose() * times_correlation(problem.fitted, noise, jacobian));
}

void describe_uncertainty(const MeasuredProblem& problem, const Eigen::VectorXd& scaled,
                          const ScanNoise& noise, MeasuredResult& result) {
  const SkyState& start = problem.start;
  const SkyState fitted = with_unknowns(start, problem.unknowns, scaled);
  const RowValues values = row_values(*problem.model, problem.fitted, fitted, problem.unknowns);
  ++result.derivative_evaluations;
  const Whitened white = problem.whitened(problem.fitted, values, result.sigma_factor);
  const Uncertainty uncertain = uncertainty_at(problem, scaled, white, noise);
  Eigen::VectorXd units(static_cast<Eigen::Index>(uncertain.inside.size()));
  for (std::size_t u = 0; u < problem.unknowns.size(); ++u) {
    const Unknown& unknown = problem.unknowns[u];
    const double unit = unknown.unit_value();
    result.unknowns.push_back({unknown, get_unknown(start, unknown) / unit,
                               get_unknown(fitted, unknown) / unit, uncertain.sigma[u] / unit,
                               uncertain.at_bound[u], uncertain.identifiable[u]});
  }
  for (std::size_t k = 0; k < uncertain.inside.size(); ++k) {
    result.covariance_unknowns.push_back(uncertain.inside[k]);
    units(static_cast<Eigen::Index>(k)) =
        1 / problem.unknowns[static_cast<std::size_t>(uncertain.inside[k])].unit_value();
  }
  result.correlation = uncertain.correlation;
  if (uncertain.covariance.size() > 0)
    result.covariance = units.asDiagonal() * uncertain.covariance * units.asDiagonal();
  result.condition_number = uncertain.condition_number;
  const double freedom = static_cast<double>(problem.fitted.rows.size()) -
                         static_cast<double>(problem.unknowns.size());
  result.chi_square_per_dof =
      freedom > 0 ? white.residual.squaredNorm() * std::pow(result.sigma_factor, 2) / freedom
                  : kNan;
  const std::vector<double> weights = problem.loss_weights(white.residual);
  result.loss_weight.assign(result.model.size(), kNan);
  result.sigma.assign(result.model.size(), kNan);
  for (const ScanRow& row : problem.fitted.rows) {
    result.loss_weight[row.sample] = weights[static_cast<std::size_t>(row.look)];
    result.sigma[row.sample] = row.sigma * noise.independent_factor;
  }
}

void describe_values(const MeasuredProblem& problem, const refs::Reference& reference,
                     const SpectralData& spectra, const Eigen::VectorXd& scaled,
                     MeasuredResult& result) {
  const SkyState& start = problem.start;
  const SkyState fitted = with_unknowns(start, problem.unknowns, scaled);
  result.start_model = sample_values(problem, start, reference.samples.size());
  result.model = sample_values(problem, fitted, reference.samples.size());
  result.model_evaluations += 2;
  const auto errors = [&](const std::vector<double>& model, int scan) {
    return measured_errors(reference, model, spectra, scan);
  };
  result.start_errors = errors(result.start_model, kAllScans);
  result.errors = errors(result.model, kAllScans);
  for (std::size_t s = 0; s < problem.fitted.scans.size(); ++s) {
    ScanOutcome outcome{problem.fitted.scans[s],
                        fitted.atmosphere[s],
                        fitted.instrument[s],
                        errors(result.model, problem.fitted.scans[s].number),
                        0,
                        0};
    for (const Look& look : problem.fitted.looks)
      outcome.directions += look.scan == static_cast<int>(s);
    for (const ScanRow& row : problem.fitted.rows)
      outcome.samples +=
          problem.fitted.looks[static_cast<std::size_t>(row.look)].scan == static_cast<int>(s);
    result.scans.push_back(outcome);
  }
  result.samples = static_cast<int>(problem.fitted.rows.size());
  result.directions = static_cast<int>(problem.fitted.looks.size());
}

}  // namespace

MeasuredResult fit_measured(const refs::Reference& reference, const SpectralData& spectra,
                            const SkyModel& model, const MeasuredOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  validate(options);
  MeasuredResult result;
  const MeasuredProblem as_stated = measured_problem(reference, spectra, model, options);
  const Eigen::VectorXd found = search(as_stated, options, result);
  result.reference = without_sun(reference, as_stated, as_stated.state(found), options);
  const MeasuredProblem problem =
      measured_problem(result.reference, spectra, model, as_pointed(options));
  const auto [scaled, noise] = refine(problem, options, found, result);
  describe_values(problem, result.reference, spectra, scaled, result);
  describe_uncertainty(problem, scaled, noise, result);
  result.preset = measured_preset(reference, model, options, result);
  report(options, 1, "done");
  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace skyfit::fit
