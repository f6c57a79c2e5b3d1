// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>

#include "fit/problem/problem.h"
#include "fit/uncertainty/at_solution.h"

namespace skyfit::fit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTolerance = 1e-6;

Eigen::VectorXd scaled_solution(const Result& result) {
  Eigen::VectorXd scaled(result.unknowns.size());
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    const UnknownRow& row = result.unknowns[u];
    scaled(static_cast<Eigen::Index>(u)) =
        std::clamp(row.unknown.scaled(row.fitted * row.unknown.unit_value()), 0.0, 1.0);
  }
  return scaled;
}

SolverLimits limits_of(const FitOptions& options) { return {options.max_iterations, kTolerance}; }

// Where the profile crosses `level` between the smallest value and the end in direction `step`.
double crossing(const Profile& profile, double level, int step) {
  const auto smallest =
      static_cast<int>(std::ranges::min_element(profile.chi_square) - profile.chi_square.begin());
  const int count = static_cast<int>(profile.value.size());
  const bool is_bottom = smallest > 0 && smallest + 1 < count;
  for (int i = smallest; i + step >= 0 && i + step < count; i += step) {
    const auto at = static_cast<std::size_t>(i), next = static_cast<std::size_t>(i + step);
    if (profile.chi_square[next] < level) continue;
    double a = profile.chi_square[at], b = profile.chi_square[next], crossed = level;
    // The square root of a parabola is linear; from a bound, which is no bottom, chi^2 itself is.
    if (is_bottom) {
      for (double* const value : {&a, &b, &crossed}) *value = std::sqrt(*value);
    }
    return std::lerp(profile.value[at], profile.value[next], (crossed - a) / (b - a));
  }
  return kNan;
}

// How much the variance of an unknown under the residuals' correlation (12.6) exceeds that of
// independent ones (12.5), which the profile is of. 1 where it has no sigma.
double variance_ratio(const Problem& problem, const Result& result, const Eigen::VectorXd& solution,
                      std::size_t index) {
  if (problem.likelihood.link == Link::kLog || problem.likelihood.noise_is_known) return 1;
  const SampleValues values =
      sky_values(*problem.model, problem.fitted, problem.state(solution), problem.unknowns);
  const Uncertainty independent =
      at_solution(problem, problem.fitted, values, solution, result.sigma_factor).independent;
  const double ratio = std::pow(result.unknowns[index].sigma *
                                    problem.unknowns[index].unit_value() / independent.sigma[index],
                                2);
  return std::isfinite(ratio) ? ratio : 1;
}

// Three sigmas on both sides in eight steps; without a sigma, 15 % of the range of its bounds.
std::vector<double> scaled_grid(const UnknownRow& row, double scaled) {
  constexpr int kSteps = 4;
  constexpr double kSigmas = 3;
  const double sigma = std::isfinite(row.sigma) ? row.sigma * row.unknown.unit_value() /
                                                      row.unknown.value_per_scaled(scaled)
                                                : 0.05;
  std::vector<double> grid;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double value = std::clamp(scaled + k * kSigmas / kSteps * sigma, 0.0, 1.0);
    if (grid.empty() || value > grid.back()) grid.push_back(value);
  }
  return grid;
}

// The directions of every scan, drawn with replacement: rows of directions drawn w times weigh so,
// those of the others are left out. Irradiances beside the sky stay.
Dataset resampled(const Dataset& data, std::mt19937_64& generator) {
  const std::size_t directions = only_sky(data).lines_of_sight.size();
  std::vector<int> drawn(data.lines_of_sight.size(), 1);
  std::fill_n(drawn.begin(), directions, 0);
  for (std::size_t first = 0; first < directions;) {
    std::size_t last = first;
    while (last < directions && data.lines_of_sight[last].scan == data.lines_of_sight[first].scan)
      ++last;
    std::uniform_int_distribution<std::size_t> any(first, last - 1);
    for (std::size_t k = first; k < last; ++k) ++drawn[any(generator)];
    first = last;
  }
  Dataset result = data;
  result.samples.clear();
  for (Sample sample : data.samples) {
    const int times = drawn[static_cast<std::size_t>(sample.line_of_sight)];
    if (times == 0) continue;
    sample.sigma /= std::sqrt(times);
    result.samples.push_back(sample);
  }
  return result;
}

// Samples with the mark are not fitted.
using Marks = std::vector<bool>;

refs::Reference without(const refs::Reference& reference, const Marks& marked, bool invert) {
  refs::Reference result = reference;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] == invert || result.samples[i].weight == 0) continue;
    result.samples[i].weight = 0;
    result.samples[i].zero_weight_reason = "held out";
  }
  return result;
}

// Gives a scan that was left out the mean instrument of the others that have one.
void share_instrument(SkyState& state, const Dataset& fitted,
                      const std::vector<bool>& scan_left_out) {
  const std::vector<LineOfSight> of_sky = only_sky(fitted).lines_of_sight;
  InstrumentState mean{};
  double count = 0;
  for (std::size_t s = 0; s < state.instrument.size(); ++s) {
    if (std::ranges::count(of_sky, static_cast<int>(s), &LineOfSight::scan) == 0) continue;
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += state.instrument[s][k];
    ++count;
  }
  for (std::size_t s = 0; s < state.instrument.size(); ++s) {
    if (!scan_left_out[s]) continue;
    for (std::size_t k = 0; k < mean.size(); ++k) state.instrument[s][k] = mean[k] / count;
  }
}

Errors errors_at(const Problem& problem, const refs::Reference& held, const SpectralData& spectra,
                 const SkyState& state) {
  return errors_of(held, reference_values(problem, state, held.samples.size()), spectra);
}

Dataset held_dataset(const Problem& problem, const refs::Reference& held,
                     const SpectralData& spectra) {
  const bool spectral = held.quantity == refs::Quantity::kSpectralRadiance;
  return dataset(held, spectra,
                 {false, 0, problem.likelihood.noise, spectral ? kMediumChannels : 0});
}

// Where the scale is profiled: of a scan that was fitted that of the fit, of one left out its own.
SkyState with_scales(const Problem& problem, const refs::Reference& held,
                     const SpectralData& spectra, const SkyState& state,
                     const std::vector<bool>& scan_left_out) {
  constexpr auto kScale = static_cast<std::size_t>(Instrument::kScale);
  SkyState result = problem.with_profiled_scales(state, problem.fitted);
  if (problem.likelihood.scale != Scale::kProfiled) return result;
  const SkyState own = problem.with_profiled_scales(state, held_dataset(problem, held, spectra));
  for (std::size_t s = 0; s < scan_left_out.size(); ++s) {
    if (scan_left_out[s]) result.instrument[s][kScale] = own.instrument[s][kScale];
  }
  return result;
}

// The pointing of the scans that were left out, fitted to them; everything else stays.
SkyState with_own_pointing(Problem problem, const refs::Reference& held,
                           const SpectralData& spectra, const FitOptions& options,
                           const SkyState& state, double factor,
                           const std::vector<bool>& scan_left_out) {
  std::erase_if(problem.unknowns, [&](const Unknown& unknown) {
    const Instrument* id = std::get_if<Instrument>(&unknown.what);
    return id == nullptr || *id == Instrument::kScale || unknown.scan == kAllScans ||
           !scan_left_out[static_cast<std::size_t>(unknown.scan)];
  });
  if (problem.unknowns.empty()) return state;
  problem.start = state;
  const Dataset data = held_dataset(problem, held, spectra);
  const Minimum minimum =
      problem.solve(data, scaled_values(problem.unknowns, state), factor, limits_of(options));
  return problem.state(minimum.scaled);
}

// What the factor on sigma is times for the medium wavelengths, so that they weigh as all do.
double medium_share(const Problem& problem) {
  return std::sqrt(static_cast<double>(problem.medium.samples.size()) /
                   static_cast<double>(problem.fitted.samples.size()));
}

// The factor that the residuals of the medium wavelengths show at a point.
double medium_noise(const Problem& problem, const Eigen::VectorXd& scaled, double factor) {
  const SampleValues values =
      sky_values(*problem.model, problem.medium, problem.state(scaled), problem.unknowns);
  return noise_of(problem, problem.medium,
                  at_solution(problem, problem.medium, values, scaled, factor), factor)
      .factor;
}

// Of all samples, where the share of the priors follows it: not of known noise or without priors.
std::optional<double> medium_noise_of_all(const SpectralData& spectra, const SkyModel& model,
                                          const FitOptions& options, const Result& result) {
  const Problem whole = make_problem(result.reference, spectra, model, options);
  const bool has_priors = std::ranges::any_of(
      whole.unknowns, [](const Unknown& unknown) { return unknown.prior.has_value(); });
  if (whole.likelihood.noise_is_known || !has_priors) return {};
  return medium_noise(whole, scaled_solution(result), medium_share(whole) * result.sigma_factor);
}

struct Refitted {
  double factor;
  Eigen::VectorXd scaled;
};

// What is kept, fitted from the solution of all: its medium wavelengths, unless the noise is known.
// Where priors hold something their share follows the noise of what is kept alone.
Refitted fitted_to_kept(const Problem& kept, std::optional<double> noise_of_all,
                        const Result& result, const FitOptions& options) {
  const bool known = kept.likelihood.noise_is_known;
  const Dataset& data = known ? kept.fitted : kept.medium;
  Refitted refitted{(known ? 1 : medium_share(kept)) * result.sigma_factor,
                    scaled_solution(result)};
  const auto solve = [&] {
    refitted.scaled =
        kept.solve(data, Eigen::VectorXd(refitted.scaled), refitted.factor, limits_of(options))
            .scaled;
  };
  solve();
  if (!noise_of_all) return refitted;
  refitted.factor *= medium_noise(kept, refitted.scaled, refitted.factor) / *noise_of_all;
  solve();
  return refitted;
}

HoldOut held_out(const SpectralData& spectra, const SkyModel& model, const FitOptions& options,
                 const Result& result, std::optional<double> noise_of_all, const Marks& marked,
                 const std::string& name) {
  const refs::Reference kept = without(result.reference, marked, false);
  const refs::Reference held = without(result.reference, marked, true);
  const Problem problem = make_problem(kept, spectra, model, options);
  const auto [factor, scaled] = fitted_to_kept(problem, noise_of_all, result, options);
  SkyState state = problem.state(scaled);
  std::vector<bool> left_out(state.instrument.size(), true);
  for (const LineOfSight& line : problem.fitted.lines_of_sight)
    left_out[static_cast<std::size_t>(line.scan)] = false;
  share_instrument(state, problem.fitted, left_out);
  const auto errors = [&](const SkyState& at) {
    return errors_at(problem, held, spectra, with_scales(problem, held, spectra, at, left_out));
  };
  return {name, errors(state),
          errors(with_own_pointing(problem, held, spectra, options, state, factor, left_out))};
}

}  // namespace

// docs/theory (12.8).
Profile profile_likelihood(const SpectralData& spectra, const SkyModel& model,
                           const FitOptions& options, const Result& result, std::string_view name) {
  const auto index = static_cast<std::size_t>(&result.unknown(name) - result.unknowns.data());
  const Eigen::VectorXd solution = scaled_solution(result);
  const Problem whole =
      make_problem(result.reference, spectra, model, without_sun_exclusion(options));
  const Unknown unknown = whole.unknowns[index];
  const auto at = static_cast<Eigen::Index>(index);
  Problem others = whole;
  others.unknowns.erase(others.unknowns.begin() + static_cast<std::ptrdiff_t>(index));
  Profile profile{std::string(name), std::string(unknown.unit()), {}, {}, {}, {}};
  for (const double scaled : scaled_grid(result.unknowns[index], solution(at))) {
    others.start =
        with_unknowns(whole.state(solution), {unknown}, Eigen::VectorXd::Constant(1, scaled));
    const double value = unknown.value(scaled);
    const double pull = unknown.prior ? (value - unknown.prior->mean) / unknown.prior->sigma : 0.0;
    const Minimum minimum =
        others.solve(others.fitted, scaled_values(others.unknowns, others.start),
                     result.sigma_factor, limits_of(options));
    profile.value.push_back(value / unknown.unit_value());
    profile.chi_square.push_back(2 * minimum.cost + pull * pull);
  }
  const double smallest = *std::ranges::min_element(profile.chi_square);
  const double ratio = variance_ratio(whole, result, solution, index);
  for (double& value : profile.chi_square) value = (value - smallest) / ratio;
  profile.percent68 = {crossing(profile, 1, -1), crossing(profile, 1, 1)};
  profile.percent95 = {crossing(profile, 3.841, -1), crossing(profile, 3.841, 1)};
  return profile;
}

Bootstrap bootstrap(const SpectralData& spectra, const SkyModel& model, const FitOptions& options,
                    const Result& result, int repetitions, std::uint64_t seed) {
  const Problem problem =
      make_problem(result.reference, spectra, model, without_sun_exclusion(options));
  const Eigen::VectorXd solution = scaled_solution(result);
  const std::size_t count = problem.unknowns.size();
  std::mt19937_64 generator(seed);
  Bootstrap outcome{repetitions, 0, std::vector(count, 0.0), std::vector(count, 0.0)};
  std::vector<Eigen::VectorXd> values;
  for (int k = 0; k < repetitions; ++k) {
    const Dataset drawn = resampled(problem.fitted, generator);
    try {
      const Minimum minimum =
          problem.solve(drawn, solution, result.sigma_factor, limits_of(options));
      Eigen::VectorXd value(static_cast<Eigen::Index>(count));
      for (std::size_t u = 0; u < count; ++u) {
        const auto i = static_cast<Eigen::Index>(u);
        value(i) = problem.unknowns[u].value(minimum.scaled(i)) / problem.unknowns[u].unit_value();
      }
      values.push_back(value);
    } catch (const std::runtime_error&) {
      ++outcome.failed;
    }
  }
  const auto n = static_cast<double>(values.size());
  for (std::size_t u = 0; u < count; ++u) {
    const auto i = static_cast<Eigen::Index>(u);
    double sum = 0, squares = 0;
    for (const Eigen::VectorXd& value : values) sum += value(i);
    for (const Eigen::VectorXd& value : values) squares += std::pow(value(i) - sum / n, 2);
    outcome.mean[u] = n > 0 ? sum / n : kNan;
    outcome.sigma[u] = n > 1 ? std::sqrt(squares / (n - 1)) : kNan;
  }
  return outcome;
}

std::vector<HoldOut> leave_one_scan_out(const SpectralData& spectra, const SkyModel& model,
                                        const FitOptions& options, const Result& result) {
  if (result.scans.size() < 2) {
    throw std::invalid_argument(fmt::format(
        "fit.hold_out: {} scan: must be at least 2 to leave one out", result.scans.size()));
  }
  const std::optional<double> noise_of_all =
      medium_noise_of_all(spectra, model, without_sun_exclusion(options), result);
  std::vector<HoldOut> outcomes;
  for (const ScanOutcome& scan : result.scans) {
    if (scan.directions == 0 && result.reference.irradiance_quantity) continue;
    Marks marked;
    for (const refs::Sample& sample : result.reference.samples)
      marked.push_back(sample.scan == scan.info.number);
    outcomes.push_back(held_out(spectra, model, without_sun_exclusion(options), result,
                                noise_of_all, marked, scan.info.name));
  }
  return outcomes;
}

std::vector<HoldOut> hold_out_directions(const SpectralData& spectra, const SkyModel& model,
                                         const FitOptions& options, const Result& result, int parts,
                                         std::uint64_t seed) {
  std::map<refs::DirectionFromSun, int> part_of;
  for (const refs::Sample& s : result.reference.samples) {
    if (!refs::is_beside_sky(result.reference, s)) part_of[refs::direction_from_sun(s)] = 0;
  }
  std::vector<int> dealt;
  for (std::size_t k = 0; k < part_of.size(); ++k) dealt.push_back(static_cast<int>(k) % parts);
  std::ranges::shuffle(dealt, std::mt19937_64(seed));
  auto next = dealt.begin();
  for (auto& [direction, part] : part_of) part = *next++;
  const std::optional<double> noise_of_all =
      medium_noise_of_all(spectra, model, without_sun_exclusion(options), result);
  std::vector<HoldOut> outcomes;
  for (int part = 0; part < parts; ++part) {
    Marks marked;
    for (const refs::Sample& s : result.reference.samples) {
      const auto of = part_of.find(refs::direction_from_sun(s));
      marked.push_back(of != part_of.end() && of->second == part);
    }
    outcomes.push_back(held_out(spectra, model, without_sun_exclusion(options), result,
                                noise_of_all, marked,
                                fmt::format("directions, part {} of {}", part + 1, parts)));
  }
  return outcomes;
}

Checks run_checks(const SpectralData& spectra, const SkyModel& model, const FitOptions& options,
                  const Result& result, const CheckOptions& wanted) {
  Checks checks;
  for (const std::string& name : wanted.profiles)
    checks.profiles.push_back(profile_likelihood(spectra, model, options, result, name));
  if (wanted.bootstrap > 0) {
    checks.bootstrap = bootstrap(spectra, model, options, result, wanted.bootstrap, wanted.seed);
  }
  if (!wanted.hold_out) return checks;
  checks.hold_outs = *wanted.hold_out == 0 ? leave_one_scan_out(spectra, model, options, result)
                                           : hold_out_directions(spectra, model, options, result,
                                                                 *wanted.hold_out, wanted.seed);
  return checks;
}

}  // namespace skyfit::fit
