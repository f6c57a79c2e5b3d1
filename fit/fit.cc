// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "fit/errors_beside.h"
#include "fit/problem/problem.h"
#include "fit/result/record.h"
#include "fit/solve/multi_start.h"
#include "fit/uncertainty/at_solution.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Below it chi^2 says nothing: data and priors determine as much as there is.
constexpr double kLeastFreedom = 0.5;

// How far the solver goes. Logarithms of a luminance are cheap and their minimum flat; spectra of a
// day cost a hundred times as much, so that their noise is estimated from few wavelengths.
struct Schedule {
  int search_iterations;               // what does not settle by then is compared as it is
  double search_tolerance, tolerance;  // relative change of the cost
  double search_factor;                // on sigma while searching
  int noise_rounds;
  // The first rounds take residuals as independent: those of a poor fit agree more, and a factor
  // from that would let the priors keep it poor.
  int independent_rounds;
  bool rounds_with_all;  // wavelengths
};

Schedule schedule_of(const Likelihood& likelihood) {
  if (likelihood.link == Link::kLinear) return {30, 1e-4, 1e-5, 1, 5, 1, false};
  const double first = likelihood.noise_is_known ? 1 : kFirstSigma / likelihood.noise.relative;
  return {15, 1e-3, 1e-7, first, 4, 0, true};
}

class Fit {
 public:
  Fit(const refs::Reference& reference, const SpectralData& spectra, const SkyModel& model,
      const FitOptions& options)
      : reference_(reference), spectra_(spectra), model_(model), options_(options) {}

  Result run() {
    const auto begin = std::chrono::steady_clock::now();
    const Problem as_stated = make_problem(reference_, spectra_, model_, options_);
    result_.likelihood = as_stated.likelihood;
    schedule_ = schedule_of(as_stated.likelihood);
    const Eigen::VectorXd found = search(as_stated);
    result_.reference = without_sun(as_stated, as_stated.state(found));
    result_.reference.notes.insert(result_.reference.notes.end(), as_stated.assumptions.begin(),
                                   as_stated.assumptions.end());
    const Problem problem =
        make_problem(result_.reference, spectra_, model_, without_sun_exclusion(options_));
    Evaluations evaluations(problem, problem.fitted);
    const Eigen::VectorXd scaled = refine(problem, evaluations, found);
    describe_problem(problem);
    describe_values(problem, scaled);
    describe_uncertainty(problem, evaluations.at(scaled, true), scaled);
    count_work(evaluations);
    result_.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result_.preset = fitted_preset(result_);
    report(1, "done");
    return std::move(result_);
  }

 private:
  void report(double fraction, const std::string& status) const {
    if (options_.progress) options_.progress(fraction, status);
  }

  void count_work(const Evaluations& evaluations) {
    result_.model_evaluations += evaluations.values_computed();
    result_.derivative_evaluations += evaluations.derivatives_computed();
  }

  // The best start after a search with few wavelengths.
  Eigen::VectorXd search(const Problem& problem) {
    const SolverLimits limits{std::min(options_.max_iterations, schedule_.search_iterations),
                              schedule_.search_tolerance};
    const auto solve = [&](std::size_t s) {
      const SkyState from = start_state(problem.starts[s].atmosphere, problem.scans());
      return problem.solve(problem.coarse, scaled_values(problem.unknowns, from),
                           schedule_.search_factor, limits);
    };
    const auto count = static_cast<double>(problem.starts.size());
    const MultiStart searched =
        solve_from(problem.starts.size(), solve, options_.threads, [&](double share) {
          report(0.6 * share, fmt::format("{:.0f} of {:.0f} starts", share * count, count));
        });
    for (std::size_t s = 0; s < searched.minima.size(); ++s) {
      const Minimum& minimum = searched.minima[s];
      result_.iterations += minimum.iterations;
      result_.model_evaluations += minimum.evaluations;
      result_.derivative_evaluations += minimum.derivative_evaluations;
      result_.starts.push_back(
          {problem.starts[s].name, minimum.cost, minimum.iterations, s == searched.best});
    }
    return searched.minima[searched.best].scaled;
  }

  // The samples that are not fitted because they truly look too close to the sun.
  refs::Reference without_sun(const Problem& problem, const SkyState& state) const {
    constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone stays in
    refs::Reference result = reference_;
    for (refs::Sample& sample : result.samples) {
      if (sample.irradiance) continue;
      const auto scan = static_cast<std::size_t>(
          std::ranges::find(problem.all.scans, sample.scan, &ScanInfo::number) -
          problem.all.scans.begin());
      const SkyPoint point =
          pointed(sky_point(sample), problem.all.scans[scan].sun_azimuth + sample.sun_azimuth_since,
                  state.instrument[scan]);
      refs::Sample at = sample;
      at.view_zenith = point.view_zenith;
      at.relative_azimuth = point.relative_azimuth;
      if (sample.weight == 0 || refs::scattering_angle(at) >= options_.exclude_sun - kRounding)
        continue;
      sample.weight = 0;
      sample.zero_weight_reason =
          fmt::format("within {:.4g} deg of the sun", options_.exclude_sun * kDegreesPerRadian);
    }
    return result;
  }

  // Of the solution with a factor. The derivatives are asked for next.
  static Noise noise_at(const Problem& problem, Evaluations& at, const Eigen::VectorXd& scaled,
                        double factor) {
    return noise_of(problem, at.data(),
                    at_solution(problem, at.data(), at.at(scaled, true), scaled, factor), factor);
  }

  // `all`: evaluations of all that is fitted.
  Eigen::VectorXd refine(const Problem& problem, Evaluations& all, Eigen::VectorXd scaled) {
    constexpr double kFactorAgrees = 0.05;  // relative change that is not worth a refit
    const auto solve = [&](Evaluations& at, double factor) {
      const Minimum minimum = problem.solve(at, problem.with_ordered_lobes(scaled), factor,
                                            {options_.max_iterations, schedule_.tolerance});
      result_.iterations += minimum.iterations;
      scaled = minimum.scaled;
      result_.converged = minimum.converged;
      result_.termination = minimum.termination;
    };
    noise_.effective_samples = static_cast<double>(only_sky(problem.fitted).samples.size());
    if (problem.likelihood.noise_is_known) {
      report(0.6, "refining the best start");
      solve(all, 1);
      return problem.with_ordered_lobes(scaled);
    }
    Evaluations few(problem, problem.coarse);
    const bool few_are_all = problem.coarse.nodes.size() == problem.fitted.nodes.size();
    Evaluations& of_rounds = schedule_.rounds_with_all || few_are_all ? all : few;
    double factor = schedule_.search_factor;
    bool agrees = false;
    for (int round = 0; round < schedule_.noise_rounds; ++round) {
      report(0.6 + 0.05 * round, "refining the best start");
      noise_ = noise_at(problem, of_rounds, scaled, factor);
      const double before = std::exchange(
          factor, round < schedule_.independent_rounds ? noise_.independent_factor : noise_.factor);
      agrees =
          round > schedule_.independent_rounds && std::abs(factor / before - 1) < kFactorAgrees;
      if (agrees) break;
      solve(of_rounds, factor);
    }
    count_work(few);
    if (!schedule_.rounds_with_all) {
      report(0.85, "refining with all wavelengths");
      noise_ = noise_at(problem, all, scaled, factor);
      solve(all, noise_.factor);
    } else if (!agrees) {
      noise_ = noise_at(problem, all, scaled, factor);
    }
    return problem.with_ordered_lobes(scaled);
  }

  void describe_problem(const Problem& problem) {
    result_.pointing = pointing_of(options_, reference_);
    result_.exclude_sun = options_.exclude_sun;
    result_.model_name = model_.name();
    result_.transfer = model_.transfer();
    result_.start_name = options_.start ? options_.start->name : "defaults";
    result_.version = SKYFIT_VERSION;
    result_.samples_left_out = refs::samples_left_out(result_.reference);
    const Dataset sky = only_sky(problem.fitted);
    result_.samples = static_cast<int>(radiances(sky).size());
    result_.directions = static_cast<int>(sky.lines_of_sight.size());
    result_.sigma_factor = noise_.factor;
    result_.effective_samples = noise_.effective_samples;
    double squares = 0;
    for (const Sample& sample : sky.samples) {
      if (!sample.polarisation) squares += std::pow(sample.sigma / sample.value, 2);
    }
    result_.sigma_percent = 100 * noise_.factor * std::sqrt(squares / result_.samples);
  }

  void describe_values(const Problem& problem, const Eigen::VectorXd& scaled) {
    const SkyState start = problem.with_profiled_scales(problem.given, problem.fitted),
                   fitted = problem.with_profiled_scales(problem.state(scaled), problem.fitted);
    const std::size_t count = reference_.samples.size();
    result_.start_model = reference_values(problem, start, count);
    result_.model = reference_values(problem, fitted, count);
    result_.model_evaluations += problem.likelihood.scale == Scale::kProfiled ? 4 : 2;
    const refs::Reference& counted = result_.reference;
    result_.start_errors = errors_of(counted, result_.start_model, spectra_);
    result_.errors = errors_of(counted, result_.model, spectra_);
    const Dataset readings = only_samples(problem.fitted, polarisations(problem.fitted));
    if (!readings.samples.empty()) {
      result_.polarisation =
          polarisation_errors(readings, *problem.model, start, fitted, noise_.factor);
      result_.model_evaluations += 2;
    }
    result_.irradiances = irradiance_errors(problem.fitted, result_.start_model, result_.model);
    result_.start_rms = rms_summary(reference_, result_.start_model, options_.exclude_sun);
    result_.rms = rms_summary(reference_, result_.model, options_.exclude_sun);
    const Dataset sky = only_sky(problem.fitted);
    for (std::size_t s = 0; s < sky.scans.size(); ++s) {
      const ScanInfo& info = sky.scans[s];
      ScanOutcome outcome{info,
                          fitted.atmosphere[s],
                          fitted.instrument[s],
                          errors_of(counted, result_.start_model, spectra_, info.number),
                          errors_of(counted, result_.model, spectra_, info.number),
                          0,
                          0};
      const int scan = static_cast<int>(s);
      outcome.directions =
          static_cast<int>(std::ranges::count(sky.lines_of_sight, scan, &LineOfSight::scan));
      outcome.samples =
          static_cast<int>(std::ranges::count_if(sky.samples, [&](const Sample& sample) {
            return !sample.polarisation && sky.scan_of(sample) == scan;
          }));
      result_.scans.push_back(outcome);
    }
  }

  // The fit weighs with sigma * factor; under the linear link the residuals vary as the noise says.
  Uncertainty uncertainty_at(const Problem& problem, const Eigen::VectorXd& scaled,
                             const AtSolution& at) const {
    const bool correlated = noise_.length != 0 || noise_.wavelength_correlation != 0;
    if (problem.likelihood.link == Link::kLog || !correlated) return at.independent;
    const double variance = std::pow(noise_.independent_factor / noise_.factor, 2);
    const Dataset sky = only_sky(problem.fitted);
    const auto of_sky = static_cast<Eigen::Index>(sky.samples.size());
    Eigen::MatrixXd spread = at.jacobian;  // irradiances beside the sky vary by themselves
    spread.topRows(of_sky) = variance * times_correlation(sky, noise_, at.jacobian.topRows(of_sky));
    return with_correlated_residuals(at.independent,
                                     {problem.unknowns.begin(), problem.unknowns.end()}, scaled,
                                     at.jacobian.transpose() * spread);
  }

  void describe_uncertainty(const Problem& problem, const SampleValues& values,
                            const Eigen::VectorXd& scaled) {
    const SkyState fitted = problem.state(scaled);
    const AtSolution at = at_solution(problem, problem.fitted, values, scaled, noise_.factor);
    const Eigen::VectorXd& weights = at.weights;
    const Uncertainty uncertain = uncertainty_at(problem, scaled, at);
    describe_unknowns(problem, fitted, uncertain);
    Eigen::VectorXd assumed = at.residual;  // in the sigmas that were stated or assumed
    for (std::size_t i = 0; i < problem.fitted.samples.size(); ++i) {
      if (!problem.fitted.samples[i].beside_sky)
        assumed(static_cast<Eigen::Index>(i)) *= noise_.factor;
    }
    const double freedom = weights.sum() - uncertain.determined - problem.profiled_scales();
    result_.chi_square_per_dof =
        freedom > kLeastFreedom ? weights.dot(assumed.cwiseAbs2()) / freedom : kNan;
    result_.loss_weight.assign(result_.model.size(), kNan);
    result_.sigma.assign(result_.model.size(), kNan);
    for (std::size_t i = 0; i < problem.fitted.samples.size(); ++i) {
      const Sample& sample = problem.fitted.samples[i];
      if (sample.polarisation) continue;
      result_.loss_weight[sample.index] = weights(static_cast<Eigen::Index>(i));
      result_.sigma[sample.index] =
          sample.sigma * (sample.beside_sky ? 1 : noise_.independent_factor);
    }
    if (problem.likelihood.loss == Loss::kNone) note_outliers(problem, at.residual);
    result_.downweighted = static_cast<int>(
        std::ranges::count_if(result_.loss_weight, [](double w) { return w < 0.5; }));
  }

  // Samples that no noise explains, as of an obstruction, and that take part in the fit in full.
  void note_outliers(const Problem& problem, const Eigen::VectorXd& residual) {
    constexpr double kFar = 8;           // of what samples scatter by
    constexpr double kMostShare = 0.05;  // of the samples: more are a misfit
    constexpr double kRounding = 0.02;   // of sigma: less is not noise
    const Dataset sky = only_sky(problem.fitted);
    Eigen::ArrayXd far = residual.head(static_cast<Eigen::Index>(sky.samples.size())).array().abs();
    std::vector<double> sorted(far.begin(), far.end());
    const auto median = sorted.begin() + std::ssize(sorted) / 2;
    std::ranges::nth_element(sorted, median);
    far /= std::max(1.4826 * *median, kRounding);  // of a normal distribution: its deviation
    const auto count = (far > kFar).count();
    if (count == 0 ||
        static_cast<double>(count) > std::max(1.0, kMostShare * static_cast<double>(far.size())))
      return;
    Eigen::Index worst = 0;
    const double largest = far.maxCoeff(&worst);
    const refs::Sample& sample =
        result_.reference.samples[sky.samples[static_cast<std::size_t>(worst)].index];
    result_.reference.notes.push_back(fmt::format(
        "{} more than {:g} times as far off as samples scatter, most of all {:.2g} times at view "
        "zenith {:.4g} deg, azimuth {:.4g} deg from the sun: an obstruction, or a misfit there; "
        "--loss takes weight from such samples",
        count == 1 ? "1 sample is" : fmt::format("{} samples are", count), kFar, largest,
        sample.view_zenith * kDegreesPerRadian, sample.relative_azimuth * kDegreesPerRadian));
  }

  void describe_unknowns(const Problem& problem, const SkyState& fitted,
                         const Uncertainty& uncertain) {
    Eigen::VectorXd units(static_cast<Eigen::Index>(uncertain.inside.size()));
    const auto start_of = [&](const Parameter& id, int scan) {
      const Atmosphere<double>& given =
          problem.given.atmosphere[scan == kAllScans ? 0 : static_cast<std::size_t>(scan)];
      return has_parameter(given, id) ? get_parameter(given, id) : kNan;
    };
    for (std::size_t u = 0; u < problem.unknowns.size(); ++u) {
      const Unknown& unknown = problem.unknowns[u];
      const double unit = unknown.unit_value();
      const Parameter* parameter = std::get_if<Parameter>(&unknown.what);
      const double start = parameter != nullptr ? start_of(*parameter, unknown.scan)
                                                : get_unknown(problem.given, unknown);
      result_.unknowns.push_back({unknown, start / unit, get_unknown(fitted, unknown) / unit,
                                  uncertain.sigma[u] / unit, uncertain.at_bound[u],
                                  uncertain.identifiable[u]});
    }
    for (std::size_t k = 0; k < uncertain.inside.size(); ++k) {
      result_.covariance_unknowns.push_back(uncertain.inside[k]);
      units(static_cast<Eigen::Index>(k)) =
          1 / problem.unknowns[static_cast<std::size_t>(uncertain.inside[k])].unit_value();
    }
    result_.correlation = uncertain.correlation;
    if (uncertain.covariance.size() > 0)
      result_.covariance = units.asDiagonal() * uncertain.covariance * units.asDiagonal();
    result_.condition_number = uncertain.condition_number;
    for (const Parameter& id : parameters_of(fitted.atmosphere.front())) {
      const bool free = std::ranges::any_of(problem.unknowns, [&](const Unknown& unknown) {
        return unknown.what == std::variant<Parameter, Instrument>(id);
      });
      if (!free)
        result_.fixed.push_back(
            {id, start_of(id, kAllScans), get_parameter(fitted.atmosphere.front(), id)});
    }
  }

  const refs::Reference& reference_;
  const SpectralData& spectra_;
  const SkyModel& model_;
  const FitOptions& options_;
  Schedule schedule_{};
  Noise noise_;
  Result result_;
};

}  // namespace

const UnknownRow& Result::unknown(std::string_view name) const {
  std::vector<std::string> known;
  for (const UnknownRow& row : unknowns) {
    known.push_back(row.unknown.name());
    if (known.back() == name) return row;
  }
  throw std::invalid_argument(fmt::format("fit: {}: not an unknown of this fit, expected one of {}",
                                          name, fmt::join(known, ", ")));
}

Result fit_atmosphere(const refs::Reference& reference, const SpectralData& spectra,
                      const SkyModel& model, const FitOptions& options) {
  validate(options);
  const FitOptions used =
      refs::is_irradiance(reference.quantity) ? without_sun_exclusion(options) : options;
  return Fit(reference, spectra, model, used).run();
}

}  // namespace skyfit::fit
